// Light from the triangles that glow by one point of one of them, in double precision.
#pragma once

#include <vector>

#include "reference/lights.h"
#include "reference/surfel.h"
#include "scene/emitters.h"

namespace whittle::reference {

/// `offset`, in [0, 1): of the few emitters that are drawn; `at`, of the unit square: which of them, and
/// where in it. The distance ends where no rounding takes a shadow ray through the triangle's plane.
LightSample sampleEmitter(const Scene& scene, const Settings& settings, const TriangleIndex& triangles,
                          const std::vector<Emitter>& emitters, const Surfel& lit, double offset,
                          const Vec2& at);

/// A unit direction into the spherical triangle of three unit vectors, all of them as likely (Arvo,
/// "Stratified Sampling of Spherical Triangles", 1995). solidAngle: the triangle's, sr.
Vec3 directionInto(const std::array<Vec3, 3>& corners, double solidAngle, const Vec2& u);

}  // namespace whittle::reference
