// Plain weave: each thread goes over one and under the next; its strands are twisted.
#include <cmath>

#include "hash.h"
#include "textures/noise.h"
#include "textures/surfaces.h"

namespace generator {
namespace {

enum FabricSeries : std::uint32_t { kFuzz = 6000, kThread = 6010, kDye = 6020 };
constexpr double kThreadHeight = 2.2e-4;  // metres

/// A half ellipse over the width of a thread.
double roundThread(double in) { return std::sqrt(std::max(0.0, 1 - 4 * (in - 0.5) * (in - 0.5) * 1.12)); }

/// A smooth wave of period 2 without a sine: 1 at odd halves, where the thread is on top.
double overUnder(double along) {
  const double t = along / 2 - std::floor(along / 2), s = t < 0.5 ? 4 * t - 1 : 3 - 4 * t;
  return 0.75 * s * (1 - s * s / 3) + 0.5;
}

}  // namespace

SurfaceFunction fabricSurface(int threads, glm::dvec3 color) {
  return [threads, color](glm::dvec2 uv) {
    const glm::dvec2 at = uv * static_cast<double>(threads), corner = glm::floor(at), in = at - corner;
    const double warp = roundThread(in.x) * overUnder(at.y + corner.x - 0.25);
    const double weft = roundThread(in.y) * overUnder(at.x + corner.y + 0.75);
    const bool isWarp = warp > weft;
    const double top = isWarp ? warp : weft;
    const auto thread = static_cast<std::uint32_t>(isWarp ? corner.x : corner.y + threads);
    const double fuzz = fractalNoise(uv, {6 * threads, 6 * threads}, kFuzz, 2);
    const double dye = fractalNoise(uv, {4, 4}, kDye, 5);
    const double shade = (0.45 + 0.6 * top) * (0.88 + 0.24 * unitValue(kThread, thread)) * (0.85 + 0.3 * dye);
    return SurfacePoint{color * shade * (0.9 + 0.2 * fuzz), kThreadHeight * (top + 0.12 * fuzz), 0.9};
  };
}

}  // namespace generator
