// See focus.h.
#include "analysis/focus.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/camera.h"

namespace whittle {

glm::dvec3 pointUnder(const Scene& scene, const Camera& camera, double aspect, double x, double y,
                      const glm::dvec3& otherwise) {
  const double half = halfHeight(camera, aspect);
  const glm::dvec3 across =
      glm::dvec3(camera.right) * ((2 * x - 1) * half * aspect) + glm::dvec3(camera.up) * ((1 - 2 * y) * half);
  glm::dvec3 origin(camera.position), direction(camera.forward);
  if (camera.orthographic)
    origin += across;
  else
    direction = glm::normalize(direction + across);
  constexpr double inf = std::numeric_limits<double>::infinity();
  // Möller and Trumbore 1997, in double.
  const auto nearest = [&](const tbb::blocked_range<std::size_t>& range, double least) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Triangle& t = scene.triangles[i];
      const glm::dvec3 a(scene.positions[t.v0]), e1 = glm::dvec3(scene.positions[t.v1]) - a,
                                                 e2 = glm::dvec3(scene.positions[t.v2]) - a,
                                                 p = glm::cross(direction, e2);
      const double det = glm::dot(e1, p);
      if (det == 0.0) continue;
      const glm::dvec3 s = origin - a, q = glm::cross(s, e1);
      const double u = glm::dot(s, p) / det, v = glm::dot(direction, q) / det, d = glm::dot(e2, q) / det;
      if (u >= 0 && v >= 0 && u + v <= 1 && d > 0 && d < least) least = d;
    }
    return least;
  };
  const double hit = tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, scene.triangles.size(), 4096),
                                          inf, nearest, [](double a, double b) { return std::min(a, b); });
  if (std::isfinite(hit)) return origin + direction * hit;
  return origin + direction * std::max(1e-6, glm::dot(otherwise - origin, direction));
}

float focusOn(const Scene& scene, const Camera& camera, double aspect, double x, double y) {
  const Bounds box = boundsOf(scene);
  const glm::dvec3 seen = pointUnder(scene, camera, aspect, x, y, (box.lo + box.hi) / 2.0);
  const double distance = glm::dot(seen - glm::dvec3(camera.position), glm::dvec3(camera.forward));
  return distance > 1e-6 && std::isfinite(distance) ? static_cast<float>(distance) : 1.0F;
}

}  // namespace whittle
