// One ring of vertices for each point of the profile.
#include "shapes/lathe.h"

#include "shapes/skin.h"

namespace generator {

Mesh makeLathe(const Outline& profile, int segments, glm::dvec2 repeat) {
  const std::size_t count = profile.points.size();
  const std::size_t rings = count + (profile.isClosed ? 1 : 0);
  Mesh mesh;
  double length = 0;
  std::vector<double> lengths;
  for (std::size_t k = 0; k < rings; ++k) {
    if (k > 0) length += glm::distance(profile.points[k % count].position, profile.points[k - 1].position);
    lengths.push_back(length);
  }
  for (std::size_t k = 0; k < rings; ++k) {
    const OutlinePoint& point = profile.points[k % count];
    for (int i = 0; i <= segments; ++i) {
      const glm::dvec2 c = onCircle(i, segments);
      const glm::dvec3 outward(c.x, 0, -c.y);
      addVertex(mesh,
                {.position = point.position.x * outward + glm::dvec3(0, point.position.y, 0),
                 .normal = point.normal.x * outward + glm::dvec3(0, point.normal.y, 0),
                 .tangent = {-c.y, 0, -c.x},
                 .uv = repeat * glm::dvec2(static_cast<double>(i) / segments, 1 - lengths[k] / length)});
    }
  }
  sewRings(mesh, 0, static_cast<std::uint32_t>(rings), static_cast<std::uint32_t>(segments) + 1);
  return mesh;
}

}  // namespace generator
