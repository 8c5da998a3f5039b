#!/usr/bin/env bash
# Ballast's tests, from a bare Debian 12 on: installs what is missing (as root or with sudo), builds
# everything, runs the tests. Exit status of ctest. May be repeated.
#
#   ./test.sh          labels unit and verify
#   ./test.sh --all    also validate and hard
#   further arguments go to ctest, for example: ./test.sh -R sedov
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/scripts/setup.sh"

chosen=(-L '^(unit|verify)$' -LE '^(validate|hard)$')
case ${1:-} in
--all)
  chosen=()
  shift
  ;;
-h | --help)
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  exit 0
  ;;
esac

install_missing
build all

say "testing"
status=0
nice -n 10 ctest --test-dir "$ballast_build" --parallel "$(nproc)" --output-on-failure \
  --no-tests=error "${chosen[@]}" "$@" || status=$?
exit "$status"
