// The bound of the rounding error of each coordinate, gamma(7) of its extent, along the geometric normal;
// then the next float away from the surface (pbrt-v4: Pharr, Jakob, Humphreys 2023, 6.8.5 and 6.8.6). pbrt's
// triangles also refuse hits within the error bound of their distance (6.8.7); ours do not.
#include "lib/surface/surfel.cl"

INLINE Real rayOffsetAt(const RenderConstants* constants, const Surfel* s) {
#if HAS(FIXED_RAY_OFFSET)
  if (!(constants->rayOffset < 0.0f)) return (Real)(constants->rayOffset);
#endif
  const Real3 size = real3(fabs(s->n_g.x), fabs(s->n_g.y), fabs(s->n_g.z));
  return dot3(size, s->extent) * (7.0f * 5.9604645e-8f / (1.0f - 7.0f * 5.9604645e-8f));
}

/// x, or its neighbour in the direction of `offset`.
INLINE Real roundedAway(Real x, Real offset) {
  const Natural bits = AS_NATURAL(x);
  const Natural outwards = (offset > 0.0f) == (x > 0.0f) ? bits + 1u : bits - 1u;
  const Real next = x == 0.0f ? offset : AS_REAL(outwards);
  return offset == 0.0f ? x : next;
}

INLINE Real3 offsetOrigin(const RenderConstants* constants, const Surfel* s, Real3 w_i) {
  const Real bump = rayOffsetAt(constants, s);
  const Real3 offset = scale3(dot3(s->n_g, w_i) > 0.0f ? bump : -bump, s->n_g);
  const Real3 o = add3(s->position, offset);
  return real3(roundedAway(o.x, offset.x), roundedAway(o.y, offset.y), roundedAway(o.z, offset.z));
}

INLINE Real shadowLength(const RenderConstants* constants, const Surfel* s, Real distance) {
  const Real free = distance - 2.0f * rayOffsetAt(constants, s);
  const Real length = distance < INFINITY ? free : (Real)(MAXFLOAT);
  return length > 0.0f ? length : (Real)(0.0f);
}
