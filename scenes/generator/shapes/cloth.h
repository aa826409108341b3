// Cloth that falls onto things and comes to rest.
#pragma once

#include <functional>

#include "shapes/subdivision.h"

namespace generator {

/// A square cloth of `cells` × `cells` quads, which starts level.
struct ClothSpec {
  glm::dvec3 center{0};  ///< where it starts, metres
  double size = 0.3;     ///< of its side, metres
  double turn = 0;       ///< radians about +Y
  int cells = 40;
  int steps = 400;  ///< of 1/120 s
  /// Signed distance to what it lies on, metres, below 0 inside; also the thickness of the cloth away.
  std::function<double(glm::dvec3)> distance;
};

/// The cloth at rest, front up, without thickness.
Cage drapeCloth(const ClothSpec& spec);

/// Distance to an axis-aligned box with rounded edges, below 0 inside.
double distanceToBox(glm::dvec3 p, glm::dvec3 low, glm::dvec3 high, double radius);

}  // namespace generator
