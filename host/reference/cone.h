// A cone about a ray says what part of a surface the ray stands for, and so how textures are filtered there
// (Akenine-Möller et al., "Improved Shader and Texture Level of Detail Using Ray Cones", JCGT 2021).
#pragma once

#include "reference/bsdf.h"
#include "reference/texture.h"

namespace whittle::reference {

struct Cone {
  double width = 0;   ///< metres, where the ray starts
  double spread = 0;  ///< how much wider it is with each metre; negative: it narrows
};

/// Of the eye ray of a pixel's sample with that index.
Cone eyeCone(const Camera& camera, const Settings& settings, const Ray& ray, std::uint32_t sample);

/// Its width in metres after `t` of them.
double widthAt(const Cone& cone, double t);

/// What becomes of it at a surfel that it meets with that width along `direction`, where the impulse leaves.
Cone afterImpulse(const Cone& cone, double width, const Surfel& surfel, const Vec3& direction,
                  const Impulse& impulse);

/// Half the divergence, 1/m, of the vertex normals over a triangle; 0 where a corner has none.
double bendOf(const Scene& scene, std::uint32_t triangle);

/// What a ray with a cone of that width sees of a triangle, in coordinates of one of its UV sets.
Footprint footprintOf(const Scene& scene, const Ray& ray, std::uint32_t triangle, int uvSet, double width);

}  // namespace whittle::reference
