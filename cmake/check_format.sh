#!/usr/bin/env bash
# Is every source file as clang-format 14 writes it? --fix rewrites those that are not.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mode=(--dry-run --Werror)
[ "${1:-}" = --fix ] && mode=(-i)
find src apps tests bench -name '*.cpp' -o -name '*.hpp' | sort | xargs -r clang-format-14 "${mode[@]}"
