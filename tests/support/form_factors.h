// Irradiance of a small horizontal surface, looking up, where all around that is seen has radiance 1.
#pragma once

#include <cmath>
#include <numbers>

namespace whittle::test {

/// Of a parallel rectangle above its middle: four times the corner's (Howell, catalogue of view factors,
/// B-3).
inline double rectangleIrradiance(double width, double depth, double height) {
  const double x = width / 2 / height, y = depth / 2 / height;
  const double sx = std::sqrt(1 + x * x), sy = std::sqrt(1 + y * y);
  return 2 * (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy));
}

/// Under the whole sky, beside an endless wall of that height at that distance: the wall takes its part of
/// the circle that Nusselt's analog projects the hemisphere on.
inline double irradianceBesideWall(double distance, double height) {
  return std::numbers::pi / 2 * (1 + distance / std::hypot(distance, height));
}

}  // namespace whittle::test
