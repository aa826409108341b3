#!/bin/sh
# Rates of every search beside Embree's, for a mixed scene, a height field and the scenes given; text to standard output.
# usage: experiments/searches.sh [SCENE.glb ...]     needs a Release build in build/release, with make_scenes
set -eu
root=$(dirname -- "$(readlink -f -- "$0")")/..
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
"$root/build/release/make_scenes" - --frame "$work/frame.glb" >&2
for scene in "$work/frame.glb" "$root/scenes/cornell_box.glb" "$@"; do
  printf '## %s\n\n' "$(basename -- "$scene" .glb)"
  "$root/build/release/whittle" bench "$scene" --all-kernels --quiet
  printf '\n'
done
