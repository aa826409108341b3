// The smaller levels of a texture: each a mean of the one before it, until there is a single texel (Williams,
// "Pyramidal Parametrics", 1983). Colours are averaged as light, not as codes; sizes that are odd by weights
// that give every texel its share (host/reference/README.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "scene/scene.h"

namespace whittle {

/// What is averaged, if anything.
enum class Averaging : std::uint8_t {
  None,           ///< the texture has one level
  Linear,         ///< the codes
  Colors,         ///< the light that sRGB codes stand for, and alpha's codes
  ColorsByAlpha,  ///< the same, each texel's colour counted by its alpha, so that what is clear lends none
};

/// 1 for a single texel: halved, rounded down, until both sides are 1.
int levelCount(int width, int height);
/// Of all levels together.
std::size_t texelsOfLevels(int width, int height);

/// Calls write(bytes) for each level but the first, from large to small: RGBA as the image has it, of 16 bits
/// for each channel if `isDeep` (which only linear values are). Takes a third of the image's memory
/// meanwhile.
void eachSmallerLevel(const Image& image, Averaging averaging, bool isDeep,
                      const std::function<void(std::span<const std::byte>)>& write);

}  // namespace whittle
