// Rays of one kind each, for measuring searches: what a render sends, and what it never does.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace whittle {

/// Rays as a struct of arrays; world space, metres.
struct RaySet {
  std::string kind;               ///< eye, shadow, mirror1, mirror2, refraction, cosine or uniform
  std::vector<float> o[3], d[3];  ///< origins; unit directions
  std::vector<float> length;      ///< how far a hit may lie; infinity but for shadow rays

  std::size_t size() const { return length.size(); }
  glm::vec3 origin(std::size_t i) const { return {o[0][i], o[1][i], o[2][i]}; }
  glm::vec3 direction(std::size_t i) const { return {d[0][i], d[1][i], d[2][i]}; }
  void add(const glm::vec3& from, const glm::vec3& along, float far);
};

/// Where a ray of a set met its triangle; triangle: index into Scene::triangles, -1: nothing.
struct QueryHit {
  float t, b1, b2;
  std::int64_t triangle;
};

/// Eye rays of a 16:9 picture of about `count` pixels through the scene's first camera,
/// in the renderer's pixel order.
RaySet eyeRays(const Scene& scene, std::size_t count);

/// From each hit of `from`, moved off the surface as the renderer does: to a point light (the scene's
/// first, else a point above it), along the mirror direction, refracted into glass of index 1.5
/// (reflected where that is total), or cosine-distributed about the normal. Geometric normals. Rays
/// that hit nothing leave none.
RaySet shadowRays(const Scene& scene, const RaySet& from, const std::vector<QueryHit>& hits);
RaySet mirrorRays(const Scene& scene, const RaySet& from, const std::vector<QueryHit>& hits,
                  const std::string& kind);
RaySet refractedRays(const Scene& scene, const RaySet& from, const std::vector<QueryHit>& hits);
RaySet cosineRays(const Scene& scene, const RaySet& from, const std::vector<QueryHit>& hits);

/// Origins anywhere in the box of the triangles, directions anywhere on the sphere. A flat
/// box is made thicker: rays that start in a triangle hit it at distance 0, which is no hit
/// to a renderer and one to Embree.
RaySet uniformRays(const Scene& scene, std::size_t count);

}  // namespace whittle
