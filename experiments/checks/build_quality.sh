#!/bin/sh
# Rays through the builder's tree beside rays through a full-sweep SAH tree, for a height field, a scene of tiny and huge
# triangles and the scenes given (a detailed mesh is worth giving). Prints a table.
# usage: experiments/run build_quality [-- [--null] [SCENE.glb ...]]   --quick: a small height field, few rays
# Needs a Release build of make_scenes and build_quality in build/release, or BUILD set to another one.
set -eu
root=$(dirname -- "$(readlink -f -- "$0")")/../..
build=${BUILD:-$root/build/release}
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
if [ "${1-}" = --quick ]; then
  "$build/make_scenes" - --heightfield 64 "$work/height_field_64.glb" >&2
  "$build/build_quality" --runs 1 --rays 65536 "$work/height_field_64.glb"
  exit
fi
"$build/make_scenes" - --heightfield 400 "$work/height_field_400.glb" --mixed "$work/mixed.glb" >&2
"$build/build_quality" "$@" "$work/height_field_400.glb" "$work/mixed.glb"
