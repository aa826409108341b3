// Pixels and regions of the picture as words: --crop X,Y,W,H, --pixel X,Y.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <string>

#include "scene/region.h"

namespace whittle::cli {

/// A region of a picture whose size may not be known yet: x, y, width and height.
struct Crop {
  std::array<double, 4> numbers{};
  bool areShares = false;  ///< of the picture's width and height; else pixels
};

/// Four numbers with commas between them: whole ones are pixels, those with a decimal point or % are shares,
/// and all are of one kind. Throws InputError that names `option`.
Crop parseCrop(const std::string& option, const std::string& word);

/// "X,Y": two whole numbers. Throws InputError that names `option`.
glm::ivec2 parsePixel(const std::string& option, const std::string& word);

/// In pixels; edges that are shares are rounded to the nearest, so that regions side by side neither overlap
/// nor leave a gap. Throws InputError where it has no pixel or lies outside the picture.
Region regionOf(const Crop& crop, int width, int height);

}  // namespace whittle::cli
