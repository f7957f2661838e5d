#!/usr/bin/env bash
# Builds the library, the program and the tests, and runs the tests.
#   ./test.sh              all tests but those at full resolution
#   ./test.sh --full       everything
#   ./test.sh -R NAME ...  other arguments go to ctest
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

select=(-LE full)
if [ "${1:-}" = --full ]; then
  select=()
  shift
fi
cmake/install_packages.sh build test
cmake/build.sh release -DCRAMPON_TESTS=ON all
# Two at a time; waiting threads sleep, so that tests beside each other do not slow each other down.
export OMP_WAIT_POLICY=${OMP_WAIT_POLICY:-passive}
times=build/release/test_times.xml
passed=0
ctest --test-dir build/release --output-on-failure --parallel 2 --output-junit "$PWD/$times" "${select[@]}" "$@" || passed=$?
[ ! -f "$times" ] || python3 tests/test_times.py "$times"
exit "$passed"
