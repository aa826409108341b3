// Spheres of triangles in a scene, with the normals of the true sphere or without.
#pragma once

#include "scene/scene.h"
#include "support/random_scenes.h"

namespace whittle::test {

/// See closedSphere. `smooth`: with vertex normals, which the rest of the scene then goes without.
inline void addSphere(Scene& scene, std::uint32_t material, const glm::vec3& centre, float radius,
                      std::uint32_t rings, std::uint32_t sectors, bool smooth = false) {
  const TriangleMesh mesh = closedSphere(centre, radius, rings, sectors);
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  scene.positions.insert(scene.positions.end(), mesh.positions.begin(), mesh.positions.end());
  for (const auto& t : mesh.triangles)
    scene.triangles.push_back({first + t.x, first + t.y, first + t.z, material});
  if (!smooth) return;
  scene.normals.resize(first, glm::vec3(0));
  for (const glm::vec3& p : mesh.positions) scene.normals.push_back(glm::normalize(p - centre));
}

}  // namespace whittle::test
