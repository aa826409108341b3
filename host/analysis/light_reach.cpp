// Conservative, in double: a kernel computes in float, from points that lie off their triangle by rounding.
// A light is left out only where it is dark by far more than that. Formulas: kernels/lib/surface/light.cl.
#include "analysis/light_reach.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

constexpr double kRelative = 1e-5;  ///< of distances and coordinates: some eighty roundings
constexpr double kTiny = 1e-18;     ///< metres; the squares of shorter distances underflow
constexpr double kVersine = 1e-4;   ///< of 1 - cos of an angle

/// Negative or zero in every channel; what is not finite is left to the kernel.
bool isBlack(const glm::vec3& c) {
  for (int k = 0; k < 3; ++k)
    if (!std::isfinite(c[k]) || c[k] > 0.0F) return false;
  return true;
}

/// What a point of the box may be off, metres.
double slack(const LitBounds& b) {
  double largest = 0.0;
  for (int k = 0; k < 3; ++k)
    largest =
        std::max({largest, std::abs(static_cast<double>(b.lo[k])), std::abs(static_cast<double>(b.hi[k]))});
  return kRelative * largest + kTiny;
}

bool outOfRange(const Light& light, const LitBounds& b) {
  const glm::dvec3 p(light.position);
  const glm::dvec3 beside = glm::max(glm::max(glm::dvec3(b.lo) - p, p - glm::dvec3(b.hi)), glm::dvec3(0.0));
  const double nearest = glm::length(beside) * (1.0 - kRelative) - slack(b);
  return light.range < std::numeric_limits<float>::infinity() && nearest > static_cast<double>(light.range);
}

/// The cone about the light's axis and the one around the ball about the box do not meet.
bool shinesPast(const Light& light, const LitBounds& b) {
  const glm::dvec3 lo(b.lo), hi(b.hi), axis(light.direction);
  if (!(std::abs(glm::dot(axis, axis) - 1.0) < kRelative)) return false;
  const glm::dvec3 to = 0.5 * (lo + hi) - glm::dvec3(light.position);
  const double distance = glm::length(to);
  const double radius = 0.5 * glm::length(hi - lo) * (1.0 + kRelative) + slack(b);
  if (!(radius < distance)) return false;
  const double along = std::clamp(glm::dot(to, axis) / distance, -1.0, 1.0);
  const double nearest = std::acos(along) - std::asin(radius / distance);
  return nearest > 0.0 &&
         1.0 - std::cos(nearest) > 1.0 - std::cos(static_cast<double>(light.outerConeAngle)) + kVersine;
}

}  // namespace

LitBounds litBounds(const Scene& scene, const std::vector<std::uint8_t>& lit) {
  using Range = tbb::blocked_range<std::size_t>;
  return tbb::parallel_reduce(
      Range(0, scene.triangles.size(), 1 << 14), LitBounds{},
      [&](const Range& range, LitBounds bounds) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const Triangle& t = scene.triangles[i];
          if (!lit[t.material]) continue;
          for (const std::uint32_t v : {t.v0, t.v1, t.v2}) bounds.add(scene.positions[v]);
        }
        return bounds;
      },
      [](LitBounds a, const LitBounds& b) {
        a.add(b);
        return a;
      });
}

std::string whyDark(const Light& light, const LitBounds& bounds) {
  if (isBlack(light.intensity)) return "gives no light";
  if (!(bounds.lo.x <= bounds.hi.x)) return "no surface answers to light";
  if (!typeOf(light.kind).isPlaced) return "";
  if (outOfRange(light, bounds)) return "out of range of every triangle";
  if (typeOf(light.kind).hasCone && shinesPast(light, bounds)) return "shines past every triangle";
  return "";
}

}  // namespace whittle
