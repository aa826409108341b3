// WebP pictures with alpha: by libwebp, since OpenImageIO's reader multiplies colours by alpha, whatever it
// is told. A library of its own, loaded with the first such picture, and optional when Whittle is built.
#pragma once

#include "image/image_io.h"

namespace whittle {

/// Bytes that tell a WebP file from others.
inline constexpr std::size_t kWebpStart = 12;
bool isWebp(std::span<const std::byte> bytes);

/// 8-bit RGBA. Throws InputError naming `name`, also where the library is missing.
Image decodeWebp(std::span<const std::byte> bytes, const std::string& name);

class WebpCodec {
 public:
  virtual ~WebpCodec() = default;
  /// Fills all but the name; returns what is wrong, empty: nothing. Any thread.
  virtual std::string decode(std::span<const std::byte> bytes, Image& image) const = 0;
};

}  // namespace whittle

/// What the library exports.
extern "C" [[gnu::visibility("default")]] const whittle::WebpCodec* whittleWebpCodec();
