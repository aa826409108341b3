// Finishes of metal: brushed, pearled, striped. Colour stays nearly even; what shows is how the slope of each
// finish turns the light.
#include <cmath>

#include "hash.h"
#include "textures/noise.h"
#include "textures/surfaces.h"

namespace generator {
namespace {

enum MetalSeries : std::uint32_t {
  kScratch = 5000,
  kLongScratch = 5010,
  kTarnish = 5020,
  kPearl = 5030,
  kRidge = 5040
};

glm::dvec3 tarnished(glm::dvec3 color, glm::dvec2 uv) {
  return color * (0.9 + 0.14 * fractalNoise(uv, {4, 4}, kTarnish, 5));
}

}  // namespace

SurfaceFunction brushedMetalSurface(glm::dvec3 color, double roughness, double depth) {
  return [=](glm::dvec2 uv) {
    const double scratch = 0.6 * noise(uv, {9, 330}, kScratch) + 0.4 * noise(uv, {3, 150}, kLongScratch);
    return SurfacePoint{tarnished(color, uv) * (0.9 + 0.2 * scratch), depth * scratch,
                        roughness * (0.85 + 0.3 * scratch)};
  };
}

SurfaceFunction pearledMetalSurface(int perSide, glm::dvec3 color, double roughness) {
  return [=](glm::dvec2 uv) {
    // Discs overlap as they were set, row after row: the last one that covers a point shows.
    constexpr double kRadius = 0.72, kGroove = 1.2e-5;  // in spacings; metres
    const glm::dvec2 at = uv * static_cast<double>(perSide);
    double height = 0, shade = 1;
    std::int64_t last = -1;
    const glm::ivec2 cell(glm::floor(at));
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const glm::ivec2 disc = cell + glm::ivec2(dx, dy);
        const double r = glm::length(at - glm::dvec2(disc) - 0.5) / kRadius;
        const std::int64_t order = (dy + 1) * 3 + dx + 1;
        if (r > 1 || order < last) continue;
        last = order;
        const glm::ivec2 wrapped = (disc + perSide) % perSide;
        const auto id = static_cast<std::uint32_t>(wrapped.y * perSide + wrapped.x);
        const double groove = noise({r * 0.999, 0.5}, {14, 1}, kPearl + id % 7);
        height = kGroove * (2 * groove + 6 * r * r);
        shade = 0.88 + 0.16 * groove;
      }
    }
    return SurfacePoint{tarnished(color, uv) * shade, height, roughness};
  };
}

SurfaceFunction stripedMetalSurface(int stripes, glm::dvec3 color, double roughness) {
  return [=](glm::dvec2 uv) {
    const double at = uv.x * stripes, in = at - std::floor(at);
    // Each ridge rises slowly and falls at once, and is scratched along.
    const double scratch = noise(uv, {stripes * 40, 6}, kRidge);
    const double rise = smoothStep(0, 0.94, in) * smoothStep(1, 0.97, in);
    return SurfacePoint{tarnished(color, uv) * (0.92 + 0.12 * scratch), 5e-5 * rise + 2e-6 * scratch,
                        roughness * (0.9 + 0.2 * scratch)};
  };
}

}  // namespace generator
