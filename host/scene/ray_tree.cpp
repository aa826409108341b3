// See ray_tree.h.
#include "scene/ray_tree.h"

#include <glm/geometric.hpp>

namespace whittle {

Passage passageOf(const RayRecord& ray, const RayRecord& parent) {
  if (ray.goesStraight || !parent.hit) return Passage::Straight;
  return glm::dot(ray.direction, parent.hit->normal) > 0 ? Passage::Reflected : Passage::Refracted;
}

glm::dvec3 shareOf(const RayRecord& ray) { return ray.throughput * ray.radiance; }

glm::dvec3 sumOf(const RayTree& tree) {
  glm::dvec3 sum(0);
  for (const auto& ray : tree.rays) sum += shareOf(ray);
  return sum;
}

}  // namespace whittle
