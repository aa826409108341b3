// Leather: pebbles of cells, creases between them, pores, and a shine where hands have rubbed.
#include "hash.h"
#include "textures/noise.h"
#include "textures/surfaces.h"

namespace generator {

SurfaceFunction leatherSurface(int pebbles, glm::dvec3 color) {
  return [pebbles, color](glm::dvec2 uv) {
    constexpr std::uint32_t kBend = 7000, kPebble = 7010, kGrain = 7020, kRubbed = 7030, kTone = 7040;
    const glm::dvec2 bend(fractalNoise(uv, {pebbles / 3, pebbles / 3}, kBend, 3),
                          fractalNoise(uv, {pebbles / 3, pebbles / 3}, kBend + 3, 3));
    const CellHit cell = cellNoise(uv + 0.7 / pebbles * (bend - 0.5), {pebbles, pebbles}, kPebble);
    const double crease = smoothStep(0.0, 0.28, cell.second - cell.nearest);
    const double grain = fractalNoise(uv, {4 * pebbles, 4 * pebbles}, kGrain, 2);
    const double rubbed = fractalNoise(uv, {3, 3}, kRubbed, 4);
    const double tone = 0.92 + 0.16 * unitValue(kTone, cell.id % 4096);
    return SurfacePoint{color * tone * (0.55 + 0.45 * crease) * (0.85 + 0.3 * rubbed),
                        1.6e-4 * crease + 3e-5 * grain, 0.62 - 0.22 * crease * rubbed};
  };
}

}  // namespace generator
