// The default's length along the ray itself.
#define bumpedOrigin alongGeometricNormal
#include "lib/default_bump.cl"
#undef bumpedOrigin

/// Origin of the rays that leave along w_i.
INLINE Real3 bumpedOrigin(const RenderConstants* constants, const Surfel* s, Real3 w_i) {
  return add3(s->position, scale3(bumpAt(constants, s), w_i));
}
