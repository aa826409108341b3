// The default's length along the shading normal.
#define offsetOrigin alongGeometricNormal
#include "lib/surface/default_ray_offset.cl"
#undef offsetOrigin

/// Origin of the rays that leave along w_i.
INLINE Real3 offsetOrigin(const RenderConstants* constants, const Surfel* s, Real3 w_i) {
  const Real bump = rayOffsetAt(constants, s);
  const Real side = dot3(s->n_g, w_i) > 0.0f ? bump : -bump;
  return add3(s->position, scale3(side, s->n));
}
