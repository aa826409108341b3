// Which images hold the same picture, and what is remembered of their texels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace whittle {

/// What was found out about the texels of a scene's images. They stay while its numbers are edited, so an
/// analysis that gets what the last one found reads no image again.
struct TexelFacts {
  std::vector<std::optional<std::uint64_t>> hashes;                  ///< by image
  std::vector<std::optional<std::uint8_t>> leastAlphas;              ///< the same
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> areAlike;  ///< of two with the same hash
  std::size_t reads = 0;  ///< how often the texels of an image were gone through, in all
};

/// For each image that is wanted the first wanted one with the same size and texels (itself, mostly); itself
/// for the others. Reads only texels of images that share their size with another.
std::vector<std::uint32_t> firstAlike(const std::vector<Image>& images,
                                      const std::vector<std::uint8_t>& wanted, TexelFacts& facts);

/// The least alpha of an image, 0 to 255; 255 without texels.
std::uint8_t leastAlpha(const std::vector<Image>& images, std::size_t index, TexelFacts& facts);

}  // namespace whittle
