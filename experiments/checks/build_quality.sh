#!/bin/sh
# Rays through the builder's tree beside rays through a full-sweep SAH tree, for a height field, a scene of tiny and huge
# triangles and the scenes given (a detailed mesh is worth giving). Writes build_quality.tsv beside this file.
# usage: experiments/build_quality.sh [SCENE.glb ...]     BUILD: a Release build, default build/release
set -eu
root=$(dirname -- "$(readlink -f -- "$0")")/..
build=${BUILD:-$root/build/release}
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cmake --build "$build" --target make_scenes --target build_quality >&2
"$build/make_scenes" - --heightfield 400 "$work/height_field_400.glb" --mixed "$work/mixed.glb" >&2
"$build/build_quality" "$work/height_field_400.glb" "$work/mixed.glb" "$@" | tee "$root/experiments/build_quality.tsv"
