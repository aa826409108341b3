// See focus.h.
#include "analysis/focus.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/ray_triangle.h"
#include "scene/camera.h"

namespace whittle {

namespace {

struct EyeRay {
  glm::dvec3 origin, direction;
};

EyeRay eyeRay(const Camera& camera, double aspect, double x, double y) {
  const double half = halfHeight(camera, aspect);
  const glm::dvec3 across =
      glm::dvec3(camera.right) * ((2 * x - 1) * half * aspect) + glm::dvec3(camera.up) * ((1 - 2 * y) * half);
  glm::dvec3 origin(camera.position), direction(camera.forward);
  if (camera.orthographic)
    origin += across;
  else
    direction = glm::normalize(direction + across);
  return {origin, direction};
}

}  // namespace

std::optional<glm::dvec3> pointUnder(const Scene& scene, const Camera& camera, double aspect, double x,
                                     double y) {
  const EyeRay ray = eyeRay(camera, aspect, x, y);
  constexpr double inf = std::numeric_limits<double>::infinity();
  const auto nearest = [&](const tbb::blocked_range<std::size_t>& range, double least) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      least = std::min(least, distanceTo(scene, scene.triangles[i], ray.origin, ray.direction));
    return least;
  };
  const double hit = tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, scene.triangles.size(), 4096),
                                          inf, nearest, [](double a, double b) { return std::min(a, b); });
  if (!std::isfinite(hit)) return std::nullopt;
  return ray.origin + ray.direction * hit;
}

glm::dvec3 pointUnder(const Scene& scene, const Camera& camera, double aspect, double x, double y,
                      const glm::dvec3& otherwise) {
  if (const auto seen = pointUnder(scene, camera, aspect, x, y)) return *seen;
  const EyeRay ray = eyeRay(camera, aspect, x, y);
  return ray.origin + ray.direction * std::max(1e-6, glm::dot(otherwise - ray.origin, ray.direction));
}

float focusOn(const Scene& scene, const Camera& camera, double aspect, double x, double y) {
  const Bounds box = boundsOf(scene);
  const glm::dvec3 seen = pointUnder(scene, camera, aspect, x, y, (box.lo + box.hi) / 2.0);
  const double distance = glm::dot(seen - glm::dvec3(camera.position), glm::dvec3(camera.forward));
  return distance > 1e-6 && std::isfinite(distance) ? static_cast<float>(distance) : 1.0F;
}

}  // namespace whittle
