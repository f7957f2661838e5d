#!/usr/bin/env bash
# Are the documents that the program generates the ones in the repository? --fix writes them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=build/release/bin/crampon
folder=docs/reference
pages=("reference input.md" "schema input.schema.json" "quantities output.md")
stale=0
for page in "${pages[@]}"; do
  read -r subcommand file <<<"$page"
  if [ "${1:-}" = --fix ]; then
    mkdir -p "$folder"
    "$program" "$subcommand" >"$folder/$file"
  else
    diff -u "$folder/$file" <("$program" "$subcommand") || stale=1
  fi
done
if [ $stale = 1 ]; then
  echo "docs/reference is stale; mend it with: cmake/check_generated.sh --fix" >&2
  exit 1
fi
