#!/usr/bin/env bash
# ./test.sh [CTEST ARGS…]: installs what is missing, builds, then runs the whole test suite; with -L quick the part for
# an inner loop.
set -euo pipefail
root=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
. "$root/cmake/setup.sh"

setUp
exec ctest --test-dir "$buildDir" --output-on-failure --no-tests=error --no-label-summary --parallel "$(nproc)" "$@"
