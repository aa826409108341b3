// Wood: boards cut from trunks whose rings show as long cathedral lines, and pores that run along the grain.
#include <cmath>

#include "hash.h"
#include "textures/noise.h"
#include "textures/surfaces.h"

namespace generator {
namespace {

enum WoodSeries : std::uint32_t {
  kWarp = 1000,
  kRing = 1010,
  kPore = 1020,
  kFibre = 1030,
  kWear = 1040,
  kBoard = 1050
};

constexpr double kPoreDepth = 60e-6, kJointDepth = 250e-6;  // metres

/// 0 between two rings, 1 at the dark end of a year.
double growthRing(double years) {
  const double t = years - std::floor(years);
  return t * t * smoothStep(1, 0.93, t);
}

}  // namespace

SurfaceFunction woodSurface(int boards) {
  return [boards](glm::dvec2 uv) {
    const double across = uv.y * boards, inBoard = across - std::floor(across);
    const auto board = static_cast<std::uint32_t>(across);
    // Each board comes from another place of the trunk.
    const double shift = unitValue(kBoard, board);
    const glm::dvec2 at(uv.x + shift, uv.y);
    const double warp = fractalNoise(at, {3, 3 * boards}, kWarp + 31 * board, 4);
    const double centre = inBoard - 0.2 - 0.6 * unitValue(kBoard, board + 64);
    const double years = 7 * centre * centre * (1 + 0.6 * warp) + 9 * warp + 3 * shift;
    const double ring = growthRing(years);
    const double fibre = fractalNoise(at, {6, 220 * boards}, kFibre, 3);
    const double pores = noise(at, {40, 260 * boards}, kPore);
    const double pore = smoothStep(0.78, 0.93, pores) * (0.35 + 0.65 * (1 - ring));
    const double wear = fractalNoise(uv, {5, 4}, kWear, 5);
    const double edge = std::min(inBoard, 1 - inBoard);
    const double joint = boards > 1 ? smoothStep(0.006, 0.001, edge) : 0;

    const glm::dvec3 light(0.30, 0.145, 0.062), dark(0.105, 0.043, 0.018);
    glm::dvec3 color = glm::mix(light, dark, 0.75 * ring + 0.35 * (fibre - 0.5));
    color *= (0.82 + 0.36 * unitValue(kBoard, board + 128)) * (1 - 0.5 * pore) * (1 - 0.85 * joint);
    color *= 0.85 + 0.3 * wear;
    return SurfacePoint{glm::clamp(color, 0.0, 1.0), -kPoreDepth * pore - kJointDepth * joint + 8e-6 * fibre,
                        0.34 + 0.18 * wear + 0.2 * pore};
  };
}

}  // namespace generator
