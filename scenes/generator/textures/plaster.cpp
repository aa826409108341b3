// Plaster: broad strokes of the trowel over grains of sand.
#include "textures/noise.h"
#include "textures/surfaces.h"

namespace generator {

SurfaceFunction plasterSurface(glm::dvec3 color) {
  return [color](glm::dvec2 uv) {
    constexpr std::uint32_t kStroke = 3000, kGrain = 3010, kStain = 3020;
    const double stroke = fractalNoise(uv, {6, 5}, kStroke, 4), grain = fractalNoise(uv, {90, 90}, kGrain, 2);
    const double stain = fractalNoise(uv, {2, 3}, kStain, 6);
    return SurfacePoint{color * (0.78 + 0.3 * stain + 0.08 * (grain - 0.5)), 1.2e-3 * stroke + 1.2e-4 * grain,
                        0.85};
  };
}

}  // namespace generator
