// Marble: veins are where a warped noise crosses its middle.
#include <cmath>

#include "textures/noise.h"
#include "textures/surfaces.h"

namespace generator {
namespace {

enum MarbleSeries : std::uint32_t { kBend = 2000, kVein = 2010, kHair = 2020, kCloud = 2030 };

/// 1 on the line where `v` is ½, falling to 0 at the distance `width`.
double veinAt(double v, double width) { return smoothStep(width, 0, std::abs(v - 0.5)); }

}  // namespace

SurfaceFunction marbleSurface() {
  return [](glm::dvec2 uv) {
    const glm::dvec2 bend(fractalNoise(uv, {3, 3}, kBend, 5), fractalNoise(uv, {3, 3}, kBend + 5, 5));
    const glm::dvec2 at = uv + 0.22 * (bend - 0.5);
    const double vein = veinAt(fractalNoise(at, {3, 4}, kVein, 5, 0.45), 0.035);
    const double hair = veinAt(fractalNoise(at, {7, 6}, kHair, 5), 0.018);
    const double cloud = fractalNoise(at, {2, 2}, kCloud, 6);
    glm::dvec3 color = glm::mix(glm::dvec3(0.83, 0.81, 0.77), glm::dvec3(0.62, 0.62, 0.63), 0.6 * cloud);
    color = glm::mix(color, glm::dvec3(0.2, 0.21, 0.24), 0.75 * vein + 0.3 * hair);
    return SurfacePoint{color, 0, 0.08 + 0.1 * vein};
  };
}

}  // namespace generator
