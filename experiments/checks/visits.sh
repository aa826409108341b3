#!/bin/sh
# Nodes, leaves and triangles that a ray visits, in our tree and in one that Embree's builder makes, for hills, tiny and huge
# triangles together, and the scenes given. Prints a table.
# usage: experiments/run visits [-- SCENE.glb ...]   --quick: a small height field, few rays
# Needs a Release build of make_scenes and visits (with Embree) in build/release, or BUILD set to another one.
set -eu
root=$(dirname -- "$(readlink -f -- "$0")")/../..
build=${BUILD:-$root/build/release}
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
if [ "${1-}" = --quick ]; then
  "$build/make_scenes" - --heightfield 64 "$work/hills.glb" >&2
  "$build/visits" --rays 4096 "$work/hills.glb"
  exit
fi
"$build/make_scenes" - --heightfield 512 "$work/hills_0.5M.glb" >&2
"$build/make_scenes" - --mixed "$work/mixed.glb" >&2
"$build/visits" "$work/hills_0.5M.glb" "$work/mixed.glb" "$@"
