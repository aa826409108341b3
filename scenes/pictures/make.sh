#!/usr/bin/env bash
# Makes the pictures of this folder from the scenes in the folder above.
# Usage: scenes/pictures/make.sh [WHITTLE [STATISTICS [NAMES]]], default build/release/whittle, none and all.
# Into the folder STATISTICS goes a .json for each picture (facts.py makes a table of them); NAMES is a pattern such as
# 'mirror*', and only pictures whose names it matches are made.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
whittle=${1:-$here/../../build/release/whittle}
statistics=${2-}
names=${3:-*}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
[[ -z $statistics ]] || mkdir -p "$statistics"

wanted() { # PICTURE
  # shellcheck disable=SC2053  # a pattern
  [[ $1 == $names ]]
}
trace() { # PICTURE SCENE.glb FILE [OPTIONS…]
  local picture=$1 scene=$2 file=$3
  shift 3
  [[ -z $statistics ]] || set -- --stats "$statistics/$picture.json" "$@"
  "$whittle" render "$scene" -o "$file" --quiet "$@"
  echo "$picture"
}
render() { # PICTURE SCENE [OPTIONS…]
  local picture=$1 scene=$2
  shift 2
  wanted "$picture" || return 0
  trace "$picture" "$here/../$scene.glb" "$here/$picture.png" --rays-per-pixel 16 --sampler stratified "$@"
}
composition() { # PICTURE RAYS [OPTIONS…]: its scene is made for the picture
  local picture=$1 rays=$2
  shift 2
  wanted "$picture" || return 0
  "$(dirname "$whittle")/make_scenes" - "--$picture" "$work/$picture.glb"
  trace "$picture" "$work/$picture.glb" "$work/$picture.png" --width 1920 --height 1080 --rays-per-pixel "$rays" \
    --sampler sobol --cutoff 1e-2 --tone-map filmic --exposure 0 "$@"
  /usr/bin/python3 "$here/smaller.py" "$work/$picture.png" "$here/$picture.jpg"
  rm "$work/$picture.glb"
}

render cornell_box cornell_box --width 960 --height 540 --rays-per-pixel 64
for bounces in 1 2 7 32; do render "mirror_box_$bounces" mirror_box --bounces "$bounces"; done
for scene in spot_cone emission shadow mirror refraction textured nested_glass; do render "$scene" "$scene"; done
render anti_aliasing_1 anti_aliasing --rays-per-pixel 1
render anti_aliasing_64 anti_aliasing --rays-per-pixel 64
composition breakfast 20 --bounces 10 --aperture 0.005 --focus-pixel 1110,660 --light-radius 0.12 --ambient 0.06 --bloom 0.04
composition diner 16 --bounces 8
composition watchmaker 16 --bounces 10 --aperture 0.002 --focus-pixel 760,500 --light-radius 0.012 --bloom 0.05
composition valley 64 --sky 14,70 --sun-angle 0.53 --bloom 0.05 --width 960 --height 540 --cutoff 0 --exposure auto
if wanted film; then # of the camera past the breakfast; img2webp is of Debian's package webp
  "$(dirname "$whittle")/make_scenes" - --breakfast "$work/breakfast.glb"
  "$whittle" render "$work/breakfast.glb" -o "$work/film_##.png" --frames 0:31 --fps 8 --width 480 --height 270 \
    --rays-per-pixel 8 --sampler sobol --bounces 8 --cutoff 1e-2 --light-radius 0.12 --ambient 0.06 \
    --tone-map filmic --exposure 0 --quiet
  img2webp -loop 0 -d 125 -lossy -q 70 "$work"/film_*.png -o "$here/film.webp" >/dev/null
  echo film
fi
if wanted contact_sheet; then "$here/contact_sheet.py" "$whittle"; fi
# The window, on an X server without a screen.
wanted window || exit 0
exec {ready}< <(exec Xvfb -displayfd 1 -screen 0 1280x720x24 -nolisten tcp 2>/dev/null)
server=$!
read -r -u "$ready" display
DISPLAY=:$display "$whittle" view "$here/../textured.glb" --script <(
  printf '%s\n' 'wait refined' 'wait 0.2' "screenshot $here/window.png" quit)
kill "$server"
echo window
