// Which images hold the same picture.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace whittle {

/// For each image that is wanted the first wanted one with the same size and texels (itself, mostly); itself
/// for the others. Reads only texels of images that share their size with another.
std::vector<std::uint32_t> firstAlike(const std::vector<Image>& images,
                                      const std::vector<std::uint8_t>& wanted);

/// The least alpha of an image, 0 to 255; 255 without texels.
std::uint8_t leastAlpha(const Image& image);

}  // namespace whittle
