#!/usr/bin/env bash
# Are the documents that the program generates the ones in the repository? --fix writes them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=build/release/bin/crampon
page=docs/reference/input.md
schema=docs/reference/input.schema.json
if [ "${1:-}" = --fix ]; then
  mkdir -p docs/reference
  "$program" reference >"$page"
  "$program" schema >"$schema"
  exit 0
fi
stale=0
diff -u "$page" <("$program" reference) || stale=1
diff -u "$schema" <("$program" schema) || stale=1
if [ $stale = 1 ]; then
  echo "docs/reference is stale; mend it with: cmake/check_generated.sh --fix" >&2
  exit 1
fi
