// How far rays start off the surface that they leave, lest it stops them: 2^-20 of the hit's largest coordinate,
// along the geometric normal, on the side that they leave to. In units of 2^-24 of that coordinate: blending
// three corners is off by at most 7 along each axis (Pharr, Jakob, Humphreys 2023, 6.8.5), 7 sqrt(3) along any
// normal; adding the offset, by sqrt(3) more. That is 13.9 of the 16; the rest is for the rounding of the
// search. Others: experiments/README.md.
#include "lib/surface/surfel.cl"

/// Distance that origins keep from the hit, m.
INLINE Real rayOffsetAt(const RenderConstants* constants, const Surfel* s) {
#if HAS(FIXED_RAY_OFFSET)
  if (!(constants->rayOffset < 0.0f)) return (Real)(constants->rayOffset);
#endif
  const Real scaled = largestOfThree(s->extent.x, s->extent.y, s->extent.z) * 9.5367431640625e-7f;  // 2^-20
  return scaled > 1e-30f ? scaled : (Real)(1e-30f);
}

/// Origin of the rays that leave along w_i.
INLINE Real3 offsetOrigin(const RenderConstants* constants, const Surfel* s, Real3 w_i) {
  const Real offset = rayOffsetAt(constants, s);
  const Real side = dot3(s->n_g, w_i) > 0.0f ? offset : -offset;
  return add3(s->position, scale3(side, s->n_g));
}

/// How far a shadow ray goes to a light at that distance from the hit: short of a surface that the light lies on.
INLINE Real shadowLength(const RenderConstants* constants, const Surfel* s, Real distance) {
  const Real free = distance - 2.0f * rayOffsetAt(constants, s);
  const Real length = distance < INFINITY ? free : (Real)(MAXFLOAT);
  return length > 0.0f ? length : (Real)(0.0f);
}
