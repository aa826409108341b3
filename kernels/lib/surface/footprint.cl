// What part of a surface a ray stands for: a cone about the ray, whose cut with the surface is the footprint over which
// textures are filtered (Akenine-Möller et al., "Improved Shader and Texture Level of Detail Using Ray Cones", 2021).
// Included before texture.cl by programs that shade; searches do not include it, so that they read textures as they
// are, and cut-outs keep their shape.
#include "lib/lanes.cl"

#if HAS(TEXTURE_LEVELS)
#define TEXTURE_FOOTPRINTS
#endif

/// Width of a ray's cone where it starts, m, and how much wider it is with each metre; see CONE_WIDTH.
typedef struct {
  Real width, spread;
} Cone;

/// What the footprint is made of: the cone's width at the hit, m, and the most lookups along it.
typedef struct {
  Real width;
  uint probes;
} Footprint;

INLINE Footprint noFootprint(void) {
  const Footprint none = {(Real)(0.0f), 1u};
  return none;
}

#ifdef TEXTURE_FOOTPRINTS
// Where a cone grazes a surface its cut has no end. Below this cosine it stays as it is there.
#define GRAZING 0.0625f
// A cone that is as wide as it is long sees the smallest level of anything.
#define LARGEST_SPREAD 1.0f

INLINE Real atLeastGrazing(Real cosine) { return cosine > GRAZING ? cosine : (Real)(GRAZING); }

/// The cone after reflection or refraction (w_i) at a surface of curvature `bend` (half the divergence of its normals
/// n, 1/m) where it is as wide as `width`. eta: index beyond over index here. The mean of what happens in the plane of
/// incidence and across it; host/reference/README.md.
INLINE Cone bentCone(Real width, Real spread, Real bend, Real cosineO, Real3 n, Real3 w_i, Real eta) {
  const Real along = dot3(n, w_i), cosine = atLeastGrazing(cosineO), beyond = atLeastGrazing(fabs(along));
  const Real inverse = 1.0f / eta;
  const Real mirrored = spread + width * bend * (cosine + 1.0f / cosine);
  const Real turned = (beyond - inverse * cosine) * (1.0f + 1.0f / (cosine * beyond));
  const Real refracted = 0.5f * (spread * inverse * (1.0f + cosine / beyond) - width * bend * turned);
  const Mask reflects = along > 0.0f;
  Cone cone;
  cone.width = reflects ? width : 0.5f * width * (1.0f + beyond / cosine);
  const Real free = reflects ? mirrored : refracted;
  const Real atLeast = free > -LARGEST_SPREAD ? free : (Real)(-LARGEST_SPREAD);
  cone.spread = atLeast < LARGEST_SPREAD ? atLeast : (Real)(LARGEST_SPREAD);
  return cone;
}
#endif
