#!/usr/bin/env bash
# ./run.sh [ARGS…]: installs what is missing, builds, then runs `whittle ARGS…` in the caller's folder.
# Without ARGS it renders scenes/cornell_box.glb to cornell_box.png.
set -euo pipefail
root=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
. "$root/cmake/setup.sh"

# General kernels for this machine, once for each build; without them scenes wait for their own.
keepGeneral() { "$buildDir/whittle" cache --warm || echo 'not kept: scenes compile their own'; }
warm() {
  local record=$buildDir/warmed.txt
  [[ ! $record -nt $buildDir/whittle ]] || return 0
  step 'compiling general kernels, once' "$root/build/warm.log" keepGeneral
  : >"$record"
}

setUp whittle
warm
(($# == 0)) || exec "$buildDir/whittle" "$@"
"$buildDir/whittle" render "$root/scenes/cornell_box.glb" -o cornell_box.png --quiet
echo 'Rendered scenes/cornell_box.glb to cornell_box.png'
