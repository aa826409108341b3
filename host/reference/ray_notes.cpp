// See ray_notes.h.
#include "reference/ray_notes.h"

#include <utility>

namespace whittle::reference {

void RayNotes::begin(const Ray& ray, const Step& step, const Vec3& throughput) {
  index_ = static_cast<int>(tree_->rays.size());
  RayRecord record;
  record.parent = step.parent;
  record.round = static_cast<std::uint32_t>(step.bounce + step.passed);
  record.goesStraight = step.after.has_value();
  record.origin = ray.origin, record.direction = ray.direction, record.throughput = throughput;
  tree_->rays.push_back(std::move(record));
}

void RayNotes::meet(const World& world, const Ray& ray, const Hit& hit, const Surfel& surfel,
                    const Vec3& kept) {
  kept_ = kept;
  const auto [p0, p1, p2] = world.triangles.corners(hit.triangle);
  const Vec3 normal = glm::normalize(glm::cross(p1 - p0, p2 - p0));
  record().hit = HitRecord{hit.triangle,      world.scene.triangles[hit.triangle].material,
                           hit.barycentric.y, hit.barycentric.z,
                           surfel.position,   glm::dot(normal, ray.direction) > 0 ? -normal : normal};
}

void RayNotes::add(const Vec3& radiance) {
  record().local += kept_ * radiance;
  record().radiance += kept_ * radiance;
}

void RayNotes::add(ShadowRecord shadow) {
  shadow.contribution *= kept_;
  shadow.arrived *= kept_;
  record().radiance += shadow.arrived;
  record().shadows.push_back(shadow);
}

}  // namespace whittle::reference
