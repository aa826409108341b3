#!/bin/sh
# Rates of every search beside Embree's: height fields of 0.5 and 8 million triangles, terrain with mirror balls, tiny and
# huge triangles together, a Cornell box, and the scenes given; text to standard output.
# usage: experiments/run searches [-- SCENE.glb ...]   --quick: the Cornell box alone, few rays
# Needs a Release build with make_scenes in build/release, or BUILD set to another one.
set -eu
root=$(dirname -- "$(readlink -f -- "$0")")/../..
build=${BUILD:-$root/build/release}
bench() { # SCENE [OPTIONS]
  printf '## %s\n\n' "$(basename -- "$1" .glb)"
  "$build/whittle" bench "$@" --all-kernels --quiet
  printf '\n'
}
if [ "${1-}" = --quick ]; then
  bench "$root/scenes/cornell_box.glb" --rays 65536 --runs 3
  exit
fi
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
"$build/make_scenes" - --heightfield 512 "$work/hills_0.5M.glb" >&2
"$build/make_scenes" - --heightfield 2048 "$work/hills_8M.glb" >&2
"$build/make_scenes" - --frame "$work/frame.glb" >&2
"$build/make_scenes" - --mixed "$work/mixed.glb" >&2
for scene in "$work/hills_0.5M.glb" "$work/hills_8M.glb" "$work/frame.glb" "$work/mixed.glb" \
  "$root/scenes/cornell_box.glb" "$@"; do
  bench "$scene"
done
