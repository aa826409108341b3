// 256 units in the last place of each coordinate times the normal's component, and 1/65536 m of the normal
// where a coordinate is below 1/32 m (Wächter and Binder 2019, Ray Tracing Gems, chapter 6).
#include "lib/surface/surfel.cl"

/// What shadow rays are shortened by: the most that the offset is, 256 ulp of the largest coordinate.
INLINE Real rayOffsetAt(const RenderConstants* constants, const Surfel* s) {
  const Real most = largestOfThree(s->extent.x, s->extent.y, s->extent.z) * 3.0517578125e-5f;  // 2^-15
  return most > 1.0f / 65536.0f ? most : (Real)(1.0f / 65536.0f);
}

INLINE Real offsetBy(Real p, Real n) {
  const Natural steps = AS_NATURAL(TO_WHOLE(256.0f * n));
  const Real moved = AS_REAL(AS_NATURAL(p) + (p < 0.0f ? 0u - steps : steps));
  return fabs(p) < 1.0f / 32.0f ? p + n / 65536.0f : moved;
}

INLINE Real3 offsetOrigin(const RenderConstants* constants, const Surfel* s, Real3 w_i) {
  const Real3 n = choose3(dot3(s->n_g, w_i) > 0.0f, s->n_g, minus3(s->n_g));
  return real3(offsetBy(s->position.x, n.x), offsetBy(s->position.y, n.y), offsetBy(s->position.z, n.z));
}

INLINE Real shadowLength(const RenderConstants* constants, const Surfel* s, Real distance) {
  const Real free = distance - 2.0f * rayOffsetAt(constants, s);
  const Real length = distance < INFINITY ? free : (Real)(MAXFLOAT);
  return length > 0.0f ? length : (Real)(0.0f);
}
