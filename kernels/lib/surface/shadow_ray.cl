// Shadow rays: where light may come from, and where the rays towards it begin and end. From a surface that is curved
// between coarse triangles they start on that surface (liftSurfel in surfel.cl).
#include "lib/surface/ray_offset.cl"

#if HAS(DIFFUSE_TRANSMISSION)
/// The place as light from behind finds it.
INLINE Surfel turnedOver(const Surfel* s) {
  Surfel other = *s;
  other.n = minus3(s->n);
  other.n_g = minus3(s->n_g);
#if HAS(TERMINATOR)
  other.lift = s->liftBehind;
#endif
  return other;
}
#endif

typedef struct {
  Real3 o, d;
  Real length;
} ShadowRay;

/// Towards a light that lies along w_i at that distance, infinite for one without a place. From where the surface is
/// curved the light is elsewhere than from its triangle.
INLINE ShadowRay shadowRayAlong(const RenderConstants* constants, const Surfel* s, Real3 w_i, Real distance) {
  ShadowRay ray;
  ray.o = offsetOrigin(constants, s, w_i);
  ray.d = w_i;
  ray.length = shadowLength(constants, s, distance);
#if HAS(TERMINATOR)
  if (some(s->curved)) {
    const Real3 above = scale3(rayOffsetAt(constants, s), s->n_g);
    ray.o = choose3(s->curved, add3(add3(s->position, above), s->lift), ray.o);
    const Mask placed = s->curved & (distance < INFINITY);
    const Real3 along = sub3(scale3(ray.length, w_i), s->lift);
    const Real length = sqrt(dot3(along, along));
    const Mask moved = placed & (length > 0.0f);
    ray.d = choose3(moved, over3(along, length), ray.d);
    ray.length = moved ? length : ray.length;
  }
#endif
  return ray;
}

/// Whether light along w_i can meet the surface from outside: above the triangle's plane or, where it is a piece of a
/// curved surface, as its shadow ray finds.
INLINE Mask isLitSide(const Surfel* s, Real3 w_i) {
#if HAS(TERMINATOR)
  return (dot3(s->n_g, w_i) > 0.0f) | s->curved;
#else
  return dot3(s->n_g, w_i) > 0.0f;
#endif
}
