#!/usr/bin/env bash
# Runs an input file, building the program first where needed:
#   ./run.sh INPUT.toml [options of `crampon run`]
# Any other arguments go to the program as they are:
#   ./run.sh draw dcb.results       ./run.sh init crack       ./run.sh --help
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

"$top/cmake/install_packages.sh" build
"$top/cmake/build.sh" release crampon_program

program=$top/build/release/bin/crampon
export CRAMPON_COMMAND=${CRAMPON_COMMAND:-$0}  # how the program's advice names itself
case ${1:-} in
  *.toml) exec "$program" run "$@" ;;
  "") exec "$program" --help ;;
  *) exec "$program" "$@" ;;
esac
