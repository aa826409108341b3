#!/usr/bin/env bash
# tinygltf writes zfar 0 into every perspective camera that has none: what was valid and endless is invalid afterwards.
#
# One would guess: reading a valid glTF file and writing it again gives a valid file. A camera without zfar has an infinite
# projection (glTF 2.0, 3.10.3), and zfar must be greater than 0 where it stands.
# What happens: the reader keeps no word of whether zfar was there, and the writer writes "zfar": 0.0. The Khronos validator
# calls that an error; readers that believe it show nothing, since nothing lies between znear and 0.
# Version: libtinygltf-dev 2.7.0+dfsg-2 (Debian 12). Seen: 2026-11-30.
# Why it matters: converters and scene generators are built on it, and the files look right wherever zfar is ignored.
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

makeRoot bookworm libtinygltf-dev=2.7.0+dfsg-2 g++-12

cat > "$root/tmp/endless.gltf" <<'END'
{"asset": {"version": "2.0"},
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
 "nodes": [{"camera": 0}], "scenes": [{"nodes": [0]}], "scene": 0}
END
cat > "$root/tmp/probe.cpp" <<'END'
// Reads, writes, and prints what the written camera has.
#include <tiny_gltf.h>
#include <fstream>
#include <iostream>
#include <iterator>
int main() {
  tinygltf::TinyGLTF io;
  tinygltf::Model model;
  std::string error, warning;
  if (!io.LoadASCIIFromFile(&model, &error, &warning, "/tmp/endless.gltf")) return 2;
  if (!io.WriteGltfSceneToFile(&model, "/tmp/written.gltf", false, true, true, false)) return 2;
  std::ifstream file("/tmp/written.gltf");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  const std::size_t at = text.find("\"zfar\"");
  std::cout << "read without zfar, written with: " << (at == text.npos ? "none" : text.substr(at, 11)) << std::endl;
  return at != text.npos && text.substr(at, 11) == "\"zfar\": 0.0" ? 0 : 1;
}
END
inRoot g++-12 -O1 -B/usr/bin /tmp/probe.cpp -o /tmp/probe -ltinygltf
if inRoot /tmp/probe; then
  echo "as described: zfar 0 where there was none"
else
  echo "NOT as described"
  exit 1
fi
