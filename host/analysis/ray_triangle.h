// A ray and a triangle in double precision, for the few rays that are asked before anything is built (Möller
// and Trumbore 1997).
#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "scene/scene.h"

namespace whittle {

/// How far along the ray the triangle is met, in lengths of `direction`; infinite where it is not, or lies
/// behind the origin.
inline double distanceTo(const Scene& scene, const Triangle& t, const glm::dvec3& origin,
                         const glm::dvec3& direction) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const glm::dvec3 a(scene.positions[t.v0]), e1 = glm::dvec3(scene.positions[t.v1]) - a,
                                             e2 = glm::dvec3(scene.positions[t.v2]) - a,
                                             p = glm::cross(direction, e2);
  const double det = glm::dot(e1, p);
  if (det == 0.0) return inf;
  const glm::dvec3 s = origin - a, q = glm::cross(s, e1);
  const double u = glm::dot(s, p) / det, v = glm::dot(direction, q) / det, d = glm::dot(e2, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && d > 0 ? d : inf;
}

}  // namespace whittle
