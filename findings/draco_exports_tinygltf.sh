#!/usr/bin/env bash
# libdraco exports a tinygltf of its own: a program that links both may get Draco's, whatever header it was compiled with.
#
# One would guess: a library for compressed meshes exports what its own headers declare. Linked beside libtinygltf, in any
# order, it takes no call that was meant for that.
# What happens: its transcoder is built with a copy of tinygltf, and all its functions are exported under their own names.
# Where -ldraco comes before -ltinygltf, reading a glTF file goes through Draco's copy, into structures that the program
# has from libtinygltf's header. Ours tore its memory with every texture that has a sampler.
# Version: libdraco-dev 1.5.5+dfsg-2, libtinygltf-dev 2.7.0+dfsg-2 (Debian 12). Seen: 2026-12-01.
# Why it matters: glTF loaders are what links both. Name tinygltf first, or load Draco with RTLD_LOCAL.
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

makeRoot bookworm libdraco-dev=1.5.5+dfsg-2 libtinygltf-dev=2.7.0+dfsg-2 nlohmann-json3-dev libstb-dev g++-12

cat > "$root/tmp/probe.cpp" <<'END'
// Reads nothing: asks which library a call to tinygltf's reader would go to. Argument: a part of its name.
#include <dlfcn.h>
#include <draco/mesh/mesh.h>
#include <tiny_gltf.h>

#include <cstdio>
#include <cstring>

int main(int, char** arguments) {
  draco::Mesh mesh;          // both libraries are needed
  tinygltf::TinyGLTF reader;
  constexpr const char* kName =
      "_ZN8tinygltf8TinyGLTF19LoadASCIIFromStringEPNS_5ModelEPNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEES9_"
      "PKcjRKS8_j";
  void* const call = dlsym(RTLD_DEFAULT, kName);
  Dl_info from{};
  if (!call || !dladdr(call, &from)) return 1;
  std::printf("%s\n", from.dli_fname);
  return std::strstr(from.dli_fname, arguments[1]) && mesh.num_faces() == 0 ? 0 : 1;
}
END
inRoot g++-12 -O1 /tmp/probe.cpp -o /tmp/draco_first -Wl,--no-as-needed -ldraco -ltinygltf
inRoot g++-12 -O1 /tmp/probe.cpp -o /tmp/tinygltf_first -Wl,--no-as-needed -ltinygltf -ldraco
if inRoot /tmp/draco_first libdraco && inRoot /tmp/tinygltf_first libtinygltf; then
  echo "as described: the library that is named first takes tinygltf's calls"
else
  echo "NOT as described"
  exit 1
fi
