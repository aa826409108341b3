#include "image/image_header.h"

#include <cstring>
#include <fstream>
#include <string_view>
#include <vector>

#include "image/byte_order.h"
#include "image/image_io.h"
#include "scene/input_error.h"

namespace whittle {
namespace {

using Bytes = std::span<const std::byte>;

bool startsWith(Bytes bytes, std::size_t at, std::string_view magic) {
  return bytes.size() >= at + magic.size() && std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
}

// `count` bytes at `at`, which must be there.
std::uint32_t big(Bytes bytes, std::size_t at, std::size_t count) {
  return bigEndian(bytes.subspan(at, count));
}
std::uint32_t little(Bytes bytes, std::size_t at, std::size_t count) {
  return littleEndian(bytes.subspan(at, count));
}

std::optional<ImageHeader> pngHeader(Bytes bytes) {
  if (bytes.size() < 29) return std::nullopt;
  return ImageHeader{big(bytes, 16, 4), big(bytes, 20, 4), big(bytes, 24, 1) == 16, big(bytes, 28, 1) != 0};
}

/// The first frame header among the segments.
std::optional<ImageHeader> jpegHeader(Bytes bytes) {
  for (std::size_t at = 2; at + 9 < bytes.size();) {
    if (big(bytes, at, 1) != 0xff) return std::nullopt;
    const std::uint32_t marker = big(bytes, at + 1, 1);
    const bool isFiller = marker == 0xff, isBare = marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8);
    const bool isFrame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (isFrame) return ImageHeader{big(bytes, at + 7, 2), big(bytes, at + 5, 2), false, marker != 0xc0};
    at += isFiller ? 1 : isBare ? 2 : 2 + big(bytes, at + 2, 2);
  }
  return std::nullopt;
}

std::optional<ImageHeader> bmpHeader(Bytes bytes) {
  if (bytes.size() < 26) return std::nullopt;
  const auto side = [&](std::size_t at) {
    return std::abs(std::int64_t{static_cast<std::int32_t>(little(bytes, at, 4))});
  };
  return ImageHeader{side(18), side(22)};
}

/// What is lossless is held whole while it is decoded, as is the alpha of what is not.
std::optional<ImageHeader> webpHeader(Bytes bytes) {
  if (bytes.size() < 30) return std::nullopt;
  if (startsWith(bytes, 12, "VP8X"))
    return ImageHeader{little(bytes, 24, 3) + 1, little(bytes, 27, 3) + 1, false, true};
  if (startsWith(bytes, 12, "VP8L")) {
    const std::uint32_t bits = little(bytes, 21, 4);
    return ImageHeader{(bits & 0x3fffU) + 1, (bits >> 14U & 0x3fffU) + 1, false, true};
  }
  return ImageHeader{little(bytes, 26, 2) & 0x3fffU, little(bytes, 28, 2) & 0x3fffU};
}

}  // namespace

std::optional<ImageHeader> headerOf(Bytes bytes) {
  if (startsWith(bytes, 0, "\x89PNG\r\n\x1a\n")) return pngHeader(bytes);
  if (startsWith(bytes, 0, "\xff\xd8\xff")) return jpegHeader(bytes);
  if (startsWith(bytes, 0, "BM")) return bmpHeader(bytes);
  if (startsWith(bytes, 0, "RIFF") && startsWith(bytes, 8, "WEBP")) return webpHeader(bytes);
  return std::nullopt;
}

std::optional<ImageHeader> headerOf(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  // Before its frame a JPEG may have profiles and pictures of its own, some of them long.
  constexpr std::size_t kStart = 1 << 20;
  std::vector<std::byte> start(kStart);
  file.read(reinterpret_cast<char*>(start.data()), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  if (const auto header = headerOf(start)) return header;
  try {
    return readImageHeader(path);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace whittle
