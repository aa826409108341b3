// See blockers.h.
#include "reference/blockers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

#include "reference/surfel.h"
#include "reference/triangle_index.h"

namespace whittle {
namespace {

/// Triangles times rays: two seconds of two cores.
constexpr double kMostTests = 1e8;

double largest(const glm::dvec3& c) { return std::max({c.x, c.y, c.z}); }

std::optional<Blocker> blockerOf(const Scene& scene, const ShadowRecord& shadow) {
  const reference::Ray ray{shadow.origin, shadow.direction};
  const reference::ShearedRay sheared(ray);
  const auto corners = reference::TriangleIndex::ofCorners(scene);
  std::optional<Blocker> nearest;
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const auto met = intersect(sheared, corners.corners(i));
    if (!met || met->t >= (nearest ? nearest->distance : shadow.length)) continue;
    const auto kept = shadowTransmittance(scene, corners, ray, {i, met->t, met->barycentric});
    if (largest(kept) <= 0.0) nearest = Blocker{i, met->t};
  }
  return nearest;
}

}  // namespace

void findBlockers(const Scene& scene, RayTree& tree) {
  std::vector<ShadowRecord*> blocked;
  for (RayRecord& ray : tree.rays)
    for (ShadowRecord& shadow : ray.shadows)
      if (shadow.arrived == glm::dvec3(0)) blocked.push_back(&shadow);
  std::stable_sort(blocked.begin(), blocked.end(), [](const ShadowRecord* a, const ShadowRecord* b) {
    return largest(a->contribution) > largest(b->contribution);
  });
  const double most = kMostTests / static_cast<double>(std::max<std::size_t>(1, scene.triangles.size()));
  blocked.resize(std::min(blocked.size(), static_cast<std::size_t>(std::max(1.0, most))));
  tbb::parallel_for(std::size_t{0}, blocked.size(),
                    [&](std::size_t i) { blocked[i]->blocker = blockerOf(scene, *blocked[i]); });
}

}  // namespace whittle
