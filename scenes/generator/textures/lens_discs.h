// What a lens that is focused on something near makes of far points of light: discs with a rim.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace generator {

/// Middle and radius in heights of the picture.
struct LensDisc {
  glm::dvec2 middle;
  double radius = 0.01;
  glm::dvec3 light{1.0};
  double weight = 1;  ///< how much of it shows
};

/// `color` of the picture at a place, in its heights, with those discs over it.
glm::dvec3 withDiscs(glm::dvec3 color, glm::dvec2 at, const std::vector<LensDisc>& discs);

}  // namespace generator
