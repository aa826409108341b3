// Tiles: each glazed a little differently, cushioned towards its joints.
#include <algorithm>
#include <cmath>

#include "hash.h"
#include "textures/noise.h"
#include "textures/surfaces.h"

namespace generator {

SurfaceFunction tileSurface(int perSide, glm::dvec3 glaze) {
  return [perSide, glaze](glm::dvec2 uv) {
    constexpr std::uint32_t kShade = 4000, kWave = 4010, kMortar = 4020;
    const glm::dvec2 at = uv * static_cast<double>(perSide), corner = glm::floor(at), in = at - corner;
    const auto tile = static_cast<std::uint32_t>(corner.y * perSide + corner.x);
    const double edge = std::min({in.x, in.y, 1 - in.x, 1 - in.y});
    const double mortar = smoothStep(0.026, 0.018, edge);
    const double shade = 0.8 + 0.3 * unitValue(kShade, tile);
    const double wave = fractalNoise(uv, {3 * perSide, 3 * perSide}, kWave, 3);
    const double sand = fractalNoise(uv, {64 * perSide, 64 * perSide}, kMortar, 2);
    const glm::dvec3 color = glm::mix(glaze * shade * (0.9 + 0.2 * wave),
                                      glm::dvec3(0.42, 0.4, 0.37) * (0.8 + 0.4 * sand), mortar);
    const double cushion = smoothStep(0.018, 0.09, edge);
    return SurfacePoint{color, 1.5e-3 * cushion + 1e-4 * wave + 1e-4 * mortar * sand, 0.08 + 0.8 * mortar};
  };
}

}  // namespace generator
