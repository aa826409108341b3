// The size of a picture from the first bytes of its file, before anything is decoded: PNG (third edition,
// 11.2.1), JPEG (ITU T.81, B.2.2), BMP, WebP (RFC 9649).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

namespace whittle {

/// Larger textures are taken for corrupt headers: the decoded texels alone would pass 1 GiB.
inline constexpr int kMaxTextureSide = 16384;

struct ImageHeader {
  std::int64_t width = 0, height = 0;  ///< as the file claims
  bool isDeep = false;                 ///< 16 bits a channel
  bool isProgressive = false;          ///< the decoder holds all of it, too: JPEG, interlaced PNG, WebP

  std::uint64_t pixels() const { return static_cast<std::uint64_t>(width * height); }
  /// Once it is an Image: 8-bit RGBA, and 16-bit RGBA beside it where it is deep.
  std::uint64_t decodedBytes() const { return pixels() * (isDeep ? 12 : 4); }
  /// What the decoder holds besides: two bytes for each of three coefficients.
  std::uint64_t decoderBytes() const { return isProgressive ? pixels() * 6 : 0; }
};

/// Nothing where it is another format, or does not get that far.
std::optional<ImageHeader> headerOf(std::span<const std::byte> bytes);
/// The same of a file; formats that only the codec knows are asked of it. Nothing where it cannot be read:
/// whoever decodes it says why.
std::optional<ImageHeader> headerOf(const std::filesystem::path& path);

}  // namespace whittle
