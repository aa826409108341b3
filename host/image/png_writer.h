// Pictures of 8-bit codes as PNG (third edition), without a library that would have to be loaded for it.
#pragma once

#include <cstddef>
#include <vector>

#include "image/image_io.h"

namespace whittle {

/// The file's bytes: sRGB codes of 3 or 4 channels (alpha does not multiply the colours), `metadata` as text
/// chunks. The same picture gives the same bytes, whatever the number of threads.
std::vector<std::byte> encodePng(const CodeImage& image, const ImageMetadata& metadata);

}  // namespace whittle
