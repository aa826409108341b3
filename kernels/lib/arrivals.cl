// The rays of LANES neighbouring entries with what they hit, as shading reads them from their queues.
#include "lib/impulses.cl"
#include "lib/lanes.cl"
#include "lib/surface/footprint.cl"

/// The rays of LANES neighbouring entries and what they hit.
typedef struct {
  Real3 o, d;
  Real t, b1, b2;
  Natural triangle;  // where nothing is hit, one that another lane hits
  Mask hit;
#if HAS(TEXTURE_LEVELS)
  Cone cone;
#endif
#if HAS(STRAIGHT)
  Real passed;           // distance up to which the ray has gone straight on, 0: not yet
  Mask bounces, goesOn;  // may still do so: be reflected or refracted, go straight on
  Mask hasBranched;      // too often to follow impulses that carry little (BRANCH_SHARE)
#endif
} Arrivals;

/// Entry i and its neighbours of a segment that begins at `first` and has `count`.
INLINE Arrivals loadArrivals(__global const float* rays, __global const float* hits, uint first, uint count,
                             uint capacity, uint i) {
  Arrivals a;
  a.triangle = AS_NATURAL(LOAD(hits + (size_t)HIT_TRIANGLE * capacity + i));
  a.hit = (LANE_NUMBERS < count - i) & (a.triangle != NO_HIT);
  a.o = loadReal3(rays, capacity, RAY_O, first + i);
  a.d = loadReal3(rays, capacity, RAY_D, first + i);
#if HAS(TEXTURES) || HAS(ABSORPTION) || HAS(AOVS) || HAS(FAR_PLANE)
  a.t = LOAD(hits + (size_t)HIT_T * capacity + i);
#else
  a.t = (Real)(0.0f);  // nothing asks, and the plane is not there
#endif
  a.b1 = LOAD(hits + (size_t)HIT_B1 * capacity + i);
  a.b2 = LOAD(hits + (size_t)HIT_B2 * capacity + i);
  uint triangle[LANES];
  int hit[LANES];
  STORE(a.triangle, triangle);
  STORE(a.hit, hit);
  uint there = 0;
  for (uint k = 0; k < LANES; ++k) there = hit[k] ? triangle[k] : there;
  a.triangle = a.hit ? a.triangle : (Natural)(there);
  return a;
}

#if HAS(STRAIGHT)
/// What the rays have done so far; eye rays (bounce 1) come from nowhere.
INLINE void loadSteps(__global const float* rays, uint entry, uint capacity, uint bounce, uint lastBounce,
                      uint transparentBounces, Arrivals* a) {
  Natural steps = (Natural)(STEP_BOUNCE);
  a->passed = (Real)(0.0f);
  if (bounce > 1) {
    steps = AS_NATURAL(LOAD(rays + (size_t)RAY_STEPS * capacity + entry));
    a->passed = LOAD(rays + (size_t)RAY_AFTER_ORDER * capacity + entry);
  }
  const Natural bounces = steps & (STEP_STRAIGHT - 1);
  a->bounces = bounces < lastBounce;
  a->goesOn = (steps & (STEP_BRANCHED - 1)) / STEP_STRAIGHT < transparentBounces;
  a->hasBranched = bounces + steps / STEP_BRANCHED >= lastBounce;
}
#endif

#if HAS(FAR_PLANE) || HAS(COVERAGE)
/// Rays that come from the eye, straight on.
INLINE Mask comeFromEye(__global const float* rays, uint entry, uint capacity, uint bounce) {
#if HAS(STRAIGHT)
  if (bounce > 1) return (AS_NATURAL(LOAD(rays + (size_t)RAY_STEPS * capacity + entry)) & (STEP_STRAIGHT - 1)) == 1u;
#endif
  return (Natural)(bounce) == 1u;
}
#endif

#if HAS(FAR_PLANE)
/// Nothing is seen beyond the far plane: of rays that come from the eye, straight on.
INLINE void endAtFarPlane(const RenderConstants* constants, __global const float* rays, uint entry, uint capacity,
                          uint bounce, Arrivals* a) {
  const Real depth = a->t * dot3(a->d, real3(constants->forward[0], constants->forward[1], constants->forward[2]));
  a->hit = a->hit & !((depth > constants->zfar) & comeFromEye(rays, entry, capacity, bounce));
}
#endif

#if HAS(TEXTURE_LEVELS)
/// The cones of the rays. Eye rays have the solid angle of their pixel, sample n that over n + 1: so the mean of any
/// number of them is filtered the less the more they are, and what a sample brings does not depend on that number.
INLINE void loadCones(const RenderConstants* constants, const Batch* batch, __global const float* rays, uint entry,
                      uint capacity, uint bounce, Arrivals* a) {
  if (bounce > 1) {
    a->cone.width = LOAD(rays + (size_t)(RAY_CONE + CONE_WIDTH) * capacity + entry);
    a->cone.spread = LOAD(rays + (size_t)(RAY_CONE + CONE_SPREAD) * capacity + entry);
    return;
  }
  // The entries are the samples.
  const Natural from = (Natural)(entry % batch->samples) + LANE_NUMBERS;
  // One division for all lanes; the quotient is exact, as a batch has at most 2^22 samples of a pixel.
  const Natural pixels = AS_NATURAL(TO_WHOLE((TO_REAL(from) + 0.5f) / (float)batch->samples));
  const Real share = 1.0f / sqrt(TO_REAL(batch->firstSample + from - pixels * batch->samples + 1u));
  const Real along = dot3(a->d, real3(constants->forward[0], constants->forward[1], constants->forward[2]));
  const Real cosine = along > 0.0f ? along : (Real)(0.0f);
  a->cone.width = share * constants->coneWidth;
  a->cone.spread = share * constants->coneSpread * cosine * sqrt(cosine);
}
#endif

/// Entry i and its neighbours of a segment that begins at `first` and has `count`, with all that shading asks of them.
/// lastBounce: for what their impulses may do; 0 where nobody asks.
INLINE Arrivals arrivalsOf(const RenderConstants* constants, const Batch* batch, __global const float* rays,
                           __global const float* hits, uint first, uint count, uint capacity, uint bounce,
                           uint lastBounce, uint i) {
  Arrivals a = loadArrivals(rays, hits, first, count, capacity, i);
#if HAS(STRAIGHT)
  loadSteps(rays, first + i, capacity, bounce, lastBounce, constants->transparentBounces, &a);
#endif
#if HAS(FAR_PLANE)
  endAtFarPlane(constants, rays, first + i, capacity, bounce, &a);
#endif
#if HAS(TEXTURE_LEVELS)
  loadCones(constants, batch, rays, first + i, capacity, bounce, &a);
#endif
  return a;
}

/// What the rays stand for where they hit.
INLINE Footprint footprintOf(const RenderConstants* constants, const Arrivals* a) {
#if HAS(TEXTURE_LEVELS)
  const Footprint footprint = {fabs(a->cone.width + a->cone.spread * a->t), constants->textureProbes};
  return footprint;
#else
  return noFootprint();
#endif
}

/// How far the rays came since they last met something.
INLINE Real distanceInside(const Arrivals* a) {
#if HAS(STRAIGHT)
  return a->t - a->passed;
#else
  return a->t;
#endif
}
