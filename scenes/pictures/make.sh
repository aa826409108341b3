#!/usr/bin/env bash
# Makes every picture of this folder from the scenes in the folder above.
# Usage: scenes/pictures/make.sh [WHITTLE], default build/release/whittle.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
whittle=${1:-$here/../../build/release/whittle}
render() { # PICTURE SCENE [OPTIONS…]
  local picture=$1 scene=$2
  shift 2
  "$whittle" render "$here/../$scene.glb" -o "$here/$picture.png" --rays-per-pixel 16 --sampler stratified --quiet "$@"
  echo "$picture.png"
}
render cornell_box cornell_box --width 960 --height 540 --rays-per-pixel 64
for bounces in 1 2 7 32; do render "mirror_box_$bounces" mirror_box --bounces "$bounces"; done
for scene in spot_cone emission shadow mirror refraction textured nested_glass; do render "$scene" "$scene"; done
render anti_aliasing_1 anti_aliasing --rays-per-pixel 1
render anti_aliasing_64 anti_aliasing --rays-per-pixel 64
# The large composition; its scene is made for the picture.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$(dirname "$whittle")/make_scenes" - --watchmaker "$work/watchmaker.glb"
"$whittle" render "$work/watchmaker.glb" -o "$here/watchmaker.jpg" --width 1920 --height 1080 --rays-per-pixel 12 \
  --sampler sobol --bounces 10 --cutoff 1e-2 --tone-map filmic --exposure 0 --quiet
echo watchmaker.jpg
# The window, on an X server without a screen.
exec {ready}< <(exec Xvfb -displayfd 1 -screen 0 1280x720x24 -nolisten tcp 2>/dev/null)
server=$!
read -r -u "$ready" display
DISPLAY=:$display "$whittle" view "$here/../textured.glb" --script <(
  printf '%s\n' 'wait refined' 'wait 0.2' "screenshot $here/window.png" quit)
kill "$server"
echo window.png
