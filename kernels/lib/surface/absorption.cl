// What volumes take of the light that crosses them (Beer, Lambert); formulas: host/reference/README.md.
#include "lib/surface/surfel.cl"

/// exp(-sigma t), 1 where sigma is 0; lane by lane, since exp of a vector may round otherwise.
INLINE Real absorbed(Real sigma, Real t) {
  float own[LANES], distance[LANES];
  STORE(sigma, own);
  STORE(t, distance);
  for (uint k = 0; k < LANES; ++k) own[k] = own[k] > 0.0f ? exp(-own[k] * distance[k]) : 1.0f;
  return LOAD(own);
}

/// What is left of the radiance from hits at distance t after the volume in front of them; 1 where it crossed none.
INLINE Real3 absorptionAlong(const Surfel* s, Real t) {
  const Real3 none = same3((float3)(1.0f));
#if HAS(ABSORPTION)
  const Mask inside = ((s->flags & MATERIAL_VOLUME) != 0) & !s->front;
  if (some(inside))
    return choose3(inside, real3(absorbed(s->sigma_a.x, t), absorbed(s->sigma_a.y, t), absorbed(s->sigma_a.z, t)),
                   none);
#endif
  return none;
}
