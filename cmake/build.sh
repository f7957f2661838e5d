#!/usr/bin/env bash
# Builds targets of a preset into build/<preset>; says nothing when all is up to date. Everything it prints goes to stderr.
#   cmake/build.sh PRESET [-DNAME=VALUE ...] TARGET ...
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=$1
shift
folder=build/$preset
options=()
while [[ ${1:-} == -D* ]]; do
  options+=("$1")
  shift
done

log=$(mktemp)
trap 'rm -f "$log"' EXIT

configured=yes
[ -f "$folder/build.ninja" ] || configured=no
for option in "${options[@]}"; do  # an option already in the cache needs no new configuration
  name=${option#-D}
  grep -q "^${name%%=*}:[A-Z]*=${name#*=}\$" "$folder/CMakeCache.txt" 2>/dev/null || configured=no
done
if [ $configured = no ]; then
  # An unusable cache folder must not stop the build. With precompiled headers the cache needs to be told what it may overlook (ccache(1)).
  if ccache "${CXX:-c++}" -x c++ -c /dev/null -o "$log" >/dev/null 2>&1; then
    options+=("-DCMAKE_CXX_COMPILER_LAUNCHER=env;CCACHE_SLOPPINESS=pch_defines,time_macros;ccache")
  fi
  if ! cmake --preset "$preset" "${options[@]}" >"$log" 2>&1; then
    cat "$log" >&2
    exit 4
  fi
fi

jobs=${CRAMPON_BUILD_JOBS:-$(nproc)}
if ! ninja -C "$folder" -n "$@" 2>/dev/null | grep -q 'no work to do'; then
  echo "Building Crampon in $folder (the first time takes a few minutes) ..." >&2
  if [ -t 2 ]; then
    ninja -C "$folder" -j "$jobs" "$@" >&2 || exit 4
  elif ! ninja -C "$folder" -j "$jobs" "$@" >"$log" 2>&1; then
    cat "$log" >&2
    echo "Building failed (see above)." >&2
    exit 4
  elif grep -q 'warning:' "$log"; then
    cat "$log" >&2
  fi
fi
