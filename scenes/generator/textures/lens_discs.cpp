#include "textures/lens_discs.h"

#include "textures/noise.h"

namespace generator {

glm::dvec3 withDiscs(glm::dvec3 color, glm::dvec2 at, const std::vector<LensDisc>& discs) {
  constexpr double kReach = 1.06;  // in radii
  for (const LensDisc& disc : discs) {
    const double far = glm::distance(at, disc.middle) / disc.radius;
    if (far > kReach) continue;
    const double inside = smoothStep(kReach, 0.92, far) * (0.75 + 0.25 * smoothStep(0.4, 0.95, far));
    color = glm::mix(color, disc.light, disc.weight * inside);
  }
  return color;
}

}  // namespace generator
