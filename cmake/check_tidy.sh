#!/usr/bin/env bash
# clang-tidy 14 on the sources that changed: against the merge base with the main branch, else the last commit, else
# (a shallow clone of one commit) on all. --all takes all sources. A changed header brings the sources that include it directly.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=build/release

base=
if [ "${1:-}" != --all ]; then
  head=$(git rev-parse -q --verify HEAD 2>/dev/null || true)
  for branch in origin/HEAD origin/main main; do
    base=$(git merge-base HEAD "$branch" 2>/dev/null || true)
    [ -n "$base" ] && [ "$base" != "$head" ] && break
    base=
  done
  [ -n "$base" ] || base=$(git rev-parse -q --verify HEAD~1 2>/dev/null || true)
fi

sources() { find src apps tests bench -name '*.cpp' | sort; }
if [ -n "$base" ]; then
  # Compared with the working tree: what is not committed yet counts too.
  changed=$({ git diff --name-only --diff-filter=d "$base" -- '*.cpp' '*.hpp'; git ls-files -o --exclude-standard -- '*.cpp' '*.hpp'; } | sort -u)
  files=$({
    grep '\.cpp$' <<<"$changed" || true
    grep '\.hpp$' <<<"$changed" | sed 's|^src/||; s|^tests/||' | while read -r header; do
      sources | xargs grep -lF "#include \"$header\"" || true
    done
  } | sort -u)
else
  files=$(sources)
fi

# Only what this build compiles: an optional part that is switched off has no compile command.
files=$(for file in $files; do
  if grep -qF "\"file\": \"$PWD/$file\"" "$folder/compile_commands.json"; then echo "$file"; fi
done)
[ -n "$files" ] || { echo "no changed source"; exit 0; }
echo "$(wc -w <<<"$files") files"
# g++ flags that clang does not know are none of its business.
xargs -P "$(nproc)" -n 1 clang-tidy-14 --quiet -p "$folder" --extra-arg=-Wno-unknown-warning-option <<<"$files" 2> >(grep -v 'warnings generated' >&2)
