#!/bin/sh
# Rays from inside random closed meshes, through every form of the search: which of them meet nothing. Prints a table;
# takes minutes for each form. usage: experiments/run leaks [-- RAYS]   (of each form; default 1e8)
# Needs a Release build in build/release, or BUILD set to another one.
set -eu
root=$(dirname -- "$(readlink -f -- "$0")")/../..
tests=${BUILD:-$root/build/release}/tests/test_kernels
log=$(mktemp)
trap 'rm -f -- "$log"' EXIT
status=0
WHITTLE_LEAK_RAYS=${1:-1e8} "$tests" --gtest_filter=Leaks.NoRayLeavesAClosedMesh >"$log" || status=$?
if ! grep -q '^leaks	' "$log"; then
  cat "$log" >&2
  exit 1
fi
printf 'form\trays\tleaks\tseconds\n'
sed -n 's/^leaks	//p' "$log"
[ "$status" -eq 0 ] || grep -v '^leaks	' "$log" >&2
exit "$status"
