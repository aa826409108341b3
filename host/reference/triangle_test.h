// One ray against one triangle in double precision, without gaps between neighbours:
// Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2013.
#pragma once

#include <array>
#include <optional>

#include "reference/vec.h"

namespace whittle::reference {

struct Ray {
  Vec3 origin;
  Vec3 direction;  ///< unit
};

/// The part of the test that depends on the ray alone: the axis along which the ray is longest becomes z, and
/// a shear makes the ray that axis.
struct ShearedRay {
  explicit ShearedRay(const Ray& ray);

  Vec3 origin;
  int kx, ky, kz;
  Vec3 shear;
};

struct TriangleHit {
  double t;          ///< metres along the unit direction, > 0
  Vec3 barycentric;  ///< weights of the three corners, sum 1
};

/// Of the triangles that meet in an edge or corner, all are hit there. Whether the hit belongs to this one:
/// to whichever a ray a tiny way beside would meet, so that light that passes several is dimmed once.
bool ownsHit(const ShearedRay& ray, const std::array<Vec3, 3>& corners);

/// Both sides are hit; edges and corners belong to every triangle that has them. Zero area: no hit.
std::optional<TriangleHit> intersect(const ShearedRay& ray, const std::array<Vec3, 3>& corners);

}  // namespace whittle::reference
