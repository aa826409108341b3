// What each kind of light delivers at a point, in double precision.
#include "reference/lights.h"

#include <algorithm>
#include <limits>

namespace whittle::reference {
namespace {

/// The extension's smooth end at `range`.
double rangeWindow(double distance, double range) {
  return std::clamp(1 - square(square(distance / range)), 0.0, 1.0);
}

/// 1 inside the inner cone, 0 outside the outer. In terms of 1 − cos, which does not cancel for narrow cones.
double coneWindow(const Light& light, const Vec3& w_i) {
  const double v = 0.5 * glm::dot(w_i + glm::normalize(Vec3(light.direction)),
                                  w_i + glm::normalize(Vec3(light.direction)));
  const double outer = 2 * square(std::sin(0.5 * static_cast<double>(light.outerConeAngle)));
  const double inner = 2 * square(std::sin(0.5 * static_cast<double>(light.innerConeAngle)));
  if (v >= outer) return 0;
  return square(std::clamp((outer - v) / (outer - inner), 0.0, 1.0));
}

}  // namespace

LightSample sampleLight(const Light& light, const Vec3& point) {
  const Vec3 intensity(light.intensity);
  if (light.kind == LightKind::Directional) {
    return {-glm::normalize(Vec3(light.direction)), std::numeric_limits<double>::infinity(), intensity};
  }
  const Vec3 towards = Vec3(light.position) - point;
  const double distance = glm::length(towards);
  if (distance == 0) return {Vec3(0), 0, Vec3(0)};
  const Vec3 w_i = towards / distance;
  double window = rangeWindow(distance, light.range);
  if (light.kind == LightKind::Spot) window *= coneWindow(light, w_i);
  return {w_i, distance, window > 0 ? intensity / square(distance) * window : Vec3(0)};
}

}  // namespace whittle::reference
