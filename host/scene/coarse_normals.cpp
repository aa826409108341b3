// See coarse_normals.h.
#include "scene/coarse_normals.h"

#include <algorithm>

namespace whittle {
namespace {

constexpr double kCosineRounding = 1e-5;  ///< of a cosine in single precision, and more

bool isCoarse(const Scene& scene, const Triangle& t) {
  const glm::dvec3 p0(scene.positions[t.v0]), p1(scene.positions[t.v1]), p2(scene.positions[t.v2]);
  const glm::dvec3 n_g = glm::normalize(glm::cross(p1 - p0, p2 - p0));
  double least = 1.0;
  for (const std::uint32_t v : {t.v0, t.v1, t.v2}) {
    if (scene.normals[v] == glm::vec3(0.0F)) return false;
    least = std::min(least, glm::dot(glm::dvec3(scene.normals[v]), n_g));
  }
  return least < COARSE_COSINE + kCosineRounding && least > EDGE_COSINE - kCosineRounding;
}

}  // namespace

bool hasCoarseNormals(const Scene& scene) {
  return !scene.normals.empty() && std::any_of(scene.triangles.begin(), scene.triangles.end(),
                                               [&](const Triangle& t) { return isCoarse(scene, t); });
}

}  // namespace whittle
