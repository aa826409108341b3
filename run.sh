#!/usr/bin/env bash
# ./run.sh [ARGS…]: installs what is missing, builds, then runs `whittle ARGS…` in the caller's folder.
# Without ARGS it renders scenes/cornell_box.glb to cornell_box.png.
set -euo pipefail
root=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
. "$root/cmake/setup.sh"

setUp whittle
(($# == 0)) || exec "$buildDir/whittle" "$@"
"$buildDir/whittle" render "$root/scenes/cornell_box.glb" -o cornell_box.png --quiet
echo 'Rendered scenes/cornell_box.glb to cornell_box.png'
