// The default's length along the shading normal.
#define bumpedOrigin alongGeometricNormal
#include "lib/default_bump.cl"
#undef bumpedOrigin

/// Origin of the rays that leave along w_i.
INLINE Real3 bumpedOrigin(const RenderConstants* constants, const Surfel* s, Real3 w_i) {
  const Real bump = bumpAt(constants, s);
  const Real side = dots(s->n_g, w_i) > 0.0f ? bump : -bump;
  return add3(s->position, scale3(side, s->n));
}
