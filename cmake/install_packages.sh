#!/usr/bin/env bash
# Installs the Debian packages that are missing for a purpose, and only those. Says nothing and touches no network when none is.
#   cmake/install_packages.sh build [test] [lint] [tsan] [count] [bench]
set -euo pipefail

build=(g++ cmake ninja-build ccache pkg-config libtomlplusplus-dev libfmt-dev libcli11-dev libmuparser-dev libudunits2-dev
       libdeflate-dev libcairo2-dev nlohmann-json3-dev libeigen3-dev)
test=(libgtest-dev librapidcheck-dev libboost-dev libpng-dev python3 python3-numpy)
lint=(clang-format-14 clang-tidy-14 git)
tsan=(clang-14 libomp-14-dev)
count=(valgrind python3)
bench=(libbenchmark-dev python3)

wanted=()
for purpose in "$@"; do
  case $purpose in
    build) wanted+=("${build[@]}") ;;
    test) wanted+=("${test[@]}") ;;
    lint) wanted+=("${lint[@]}") ;;
    tsan) wanted+=("${tsan[@]}") ;;
    count) wanted+=("${count[@]}") ;;
    bench) wanted+=("${bench[@]}") ;;
    *) echo "install_packages.sh: unknown purpose '$purpose'; known: build test lint tsan count bench" >&2; exit 2 ;;
  esac
done

# Elsewhere than on Debian the packages have other names: CMake then says what it does not find.
command -v dpkg-query >/dev/null || exit 0

# dpkg-query fails when it knows nothing of a package; what it does know still stands in its answer.
present=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null || true)
missing=()
for package in "${wanted[@]}"; do
  grep -qxF "installed $package" <<<"$present" || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "These packages are missing and only root can install them (there is no sudo here):" >&2
    echo "  apt-get install ${missing[*]}" >&2
    exit 4
  fi
  as_root=(sudo)
fi
echo "Installing missing packages: ${missing[*]}" >&2
log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y "$@" >>"$log" 2>&1; }
if ! { apt update && apt install --no-install-recommends "${missing[@]}"; }; then
  tail -n 20 "$log" >&2
  echo "Installing failed (see above). By hand: apt-get update && apt-get install ${missing[*]}" >&2
  exit 4
fi
