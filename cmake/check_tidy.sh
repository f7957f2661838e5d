#!/usr/bin/env bash
# clang-tidy 14 on the sources that changed: against the merge base with the main branch, else the last commit, else
# (a shallow clone of one commit) on all. --all takes all sources. A changed header brings the sources that include it directly.
# Without --all no further file is begun after CRAMPON_TIDY_MINUTES (1), and what was left out is said: a change of everything
# would take longer than all tests together.
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
    for header in $(grep '\.hpp$' <<<"$changed" | sed 's|^src/||; s|^tests/||'); do
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
# clang would stop at options of g++ that it does not know, and at precompiled headers of g++ or of another clang.
commands=$(mktemp -d)
trap 'rm -r "$commands"' EXIT
sed -E 's/ -fno-tree-loop-distribute-patterns//g; s/ -Winvalid-pch( -Xclang -include-pch -Xclang [^ ]*)?( -Xclang)? -include( -Xclang)? [^ ]*//g' "$folder/compile_commands.json" >"$commands/compile_commands.json"
deadline=$(($(date +%s) + 60 * ${CRAMPON_TIDY_MINUTES:-1}))
[ "${1:-}" = --all ] && deadline=$(($(date +%s) + 86400))
check_one='
  if [ "$(date +%s)" -ge "$0" ]; then echo "left out (time is up): $2"; exit 0; fi
  exec clang-tidy-14 --quiet -p "$1" --extra-arg=-Wno-unknown-warning-option "$2"'  # nor warnings of g++
xargs -P "$(nproc)" -n 1 bash -c "$check_one" "$deadline" "$commands" <<<"$files" 2> >(grep -v 'warnings generated' >&2)
