// The default's length along the ray itself.
#include "lib/surfels.cl"

/// Distance that origins keep from the hit, m.
INLINE Real bumpAt(const RenderConstants* constants, const Surfel* s) {
#if HAS(FIXED_BUMP)
  if (!(constants->bump < 0.0f)) return (Real)(constants->bump);
#endif
  const Real scaled = largestOf(s->extent.x, s->extent.y, s->extent.z) * 9.5367431640625e-7f;  // 2^-20
  return scaled > 1e-30f ? scaled : (Real)(1e-30f);
}

/// Origin of the rays that leave along w_i.
INLINE Real3 bumpedOrigin(const RenderConstants* constants, const Surfel* s, Real3 w_i) {
  return add3(s->position, scale3(bumpAt(constants, s), w_i));
}

/// How far a shadow ray goes to a light at that distance from the hit: short of a surface that the light lies on.
INLINE Real shadowLength(const RenderConstants* constants, const Surfel* s, Real distance) {
  const Real free = distance - 2.0f * bumpAt(constants, s);
  const Real length = distance < INFINITY ? free : (Real)(MAXFLOAT);
  return length > 0.0f ? length : (Real)(0.0f);
}
