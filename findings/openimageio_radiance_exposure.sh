#!/usr/bin/env bash
# OpenImageIO keeps the last of several EXPOSURE lines of a Radiance .hdr and drops COLORCORR: the radiance is lost.
#
# One would guess: whoever divides the values by the attribute hdr:exposure has the radiance. Radiance's own tools add a
# line EXPOSURE for each step that scales the picture (pfilt, ximage, pcomb); its file format says that the lines
# multiply, and that COLORCORR multiplies by channel.
# What happens: the attribute holds the last line alone, the values are as stored, and COLORCORR is no attribute at all.
# A file of EXPOSURE=2 and EXPOSURE=4 is read four times too bright after that division, eight times without it.
# Version: openimageio-tools 2.4.7.1+dfsg-2 (Debian 12). Seen: 2026-11-30.
# Why it matters: skies of lighting work are such files; a picture lit by one is wrong by a factor that nobody sees.
# Exit status: 0 as described, 1 behaviour changed, 2 cannot be had here.
# shellcheck disable=SC2016
set -euo pipefail
((EUID == 0)) || { echo "needs root, for chroot" >&2; exit 2; }
tmp=$(mktemp -d)
trap 'rm -rf --one-file-system "$tmp"' EXIT
root=$tmp/root

# makeRoot SUITE PACKAGES…: unpacks them, and what they depend on, into $root. Nothing is installed; no maintainer script runs.
makeRoot() {
  local suite=$1 site deb
  shift
  site=$(apt-get indextargets --format '$(SITE)|$(CODENAME)' 'Created-By: Packages' | sed -n 's/|bookworm$//p' | head -n 1)
  mkdir -p "$tmp"/{none,lists/partial,archives/partial} "$root"/{usr/{bin,sbin,lib,lib64},dev,proc,sys,tmp,root}
  for dir in bin sbin lib lib64; do ln -s usr/$dir "$root/$dir"; done
  printf 'deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] %s %s main\n' "$site" "$suite" > "$tmp/sources.list"
  : > "$tmp/status"
  # what the machine has apt do after an update (to its own caches) is none of this root's business
  { cat /etc/apt/apt.conf || true; printf '#clear APT::Update::Post-Invoke%s;\n' "" -Success; } > "$tmp/main.conf" 2> /dev/null
  echo "Dir::Etc::Main \"$tmp/main.conf\";" > "$tmp/apt.conf"
  local apt=(env APT_CONFIG="$tmp/apt.conf" apt-get -qq -o Dir::Etc::SourceList="$tmp/sources.list" -o Dir::Etc::SourceParts="$tmp/none"
    -o Dir::Etc::Preferences="$tmp/none/p" -o Dir::Etc::PreferencesParts="$tmp/none" -o Dir::State::Lists="$tmp/lists"
    -o Dir::State::Status="$tmp/status" -o Dir::State::extended_states="$tmp/extended" -o Dir::Cache="$tmp"
    -o Dir::Cache::Archives="$tmp/archives" -o APT::Sandbox::User=root)
  "${apt[@]}" update
  "${apt[@]}" install --download-only --no-install-recommends -y "$@" > /dev/null
  for deb in "$tmp"/archives/*.deb; do dpkg-deb --fsys-tarfile "$deb" | tar -x -C "$root" --keep-directory-symlink; done
  rm -f "$tmp"/archives/*.deb
  mknod -m 666 "$root/dev/null" c 1 3
  mknod -m 666 "$root/dev/zero" c 1 5
  mknod -m 666 "$root/dev/urandom" c 1 9
}

# inRoot COMMAND…: runs it there, with a /proc and a /sys that go away with it.
inRoot() {
  unshare --mount --propagation private sh -c 'mount -t proc proc "$0/proc" && mount --rbind /sys "$0/sys" && exec chroot "$0" "$@"' "$root" "$@"
}

makeRoot bookworm openimageio-tools=2.4.7.1+dfsg-2

# radianceFile NAME LINES…: 2 by 1 pixels of stored value (1, 0.5, 0.25), flat RGBE.
radianceFile() {
  local file=$root/tmp/$1
  shift
  { printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n'; printf '%s\n' "$@"; printf '\n-Y 1 +X 2\n'; } > "$file"
  printf '\x80\x40\x20\x81\x80\x40\x20\x81' >> "$file"
}
# facts NAME: the lines of oiiotool that speak of exposure, colour correction and the first pixel.
# The library links of lapack and blas are made by maintainer scripts, which do not run here.
facts() {
  LD_LIBRARY_PATH=/usr/lib/x86_64-linux-gnu/lapack:/usr/lib/x86_64-linux-gnu/blas \
    inRoot oiiotool --info -v --dumpdata "/tmp/$1" |
    grep -iE 'exposure|colorcorr|Pixel \(0' | sed 's/^ *//'
}

radianceFile one.hdr EXPOSURE=2
radianceFile two.hdr EXPOSURE=2 EXPOSURE=4
radianceFile colours.hdr 'COLORCORR=2 1 1'
pixel='Pixel (0, 0): 1.000000000 0.500000000 0.250000000'
status=0
# expect NAME EXPECTED: prints both and compares.
expect() {
  local seen
  seen=$(facts "$1")
  printf '%s:\n%s\n' "$1" "$seen"
  [[ $seen == "$2" ]] || status=1
}
expect one.hdr "hdr:exposure: 2"$'\n'"$pixel"
expect two.hdr "hdr:exposure: 4"$'\n'"$pixel" # the product is 8
expect colours.hdr "$pixel"
if ((status == 0)); then echo "as described: the last EXPOSURE alone, no COLORCORR"; else echo "NOT as described"; fi
exit $status
