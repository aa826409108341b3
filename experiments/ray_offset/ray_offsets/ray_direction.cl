// The default's length along the ray itself.
#define offsetOrigin alongGeometricNormal
#include "lib/surface/default_ray_offset.cl"
#undef offsetOrigin

/// Origin of the rays that leave along w_i.
INLINE Real3 offsetOrigin(const RenderConstants* constants, const Surfel* s, Real3 w_i) {
  return add3(s->position, scale3(rayOffsetAt(constants, s), w_i));
}
