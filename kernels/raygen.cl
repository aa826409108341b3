// raygen: one eye ray for each slot of the batch, LANES of them for each work item. Writes the ray queue but for
// the throughput, which is 1, and, without NEAR_PLANE, what rays have passed, which is nothing.
//
// A direction a float's rounding off (3e-8) moves a texture seen at grazing incidence by hundredths of a texel, so the
// point on the image plane is computed to twice a float's precision, and rounded once.
#include "lib/lanes.cl"
#include "lib/sampler.cl"

/// (high + low) · scale, rounded once; error: what that rounding lost.
INLINE Real scaledComponent(Real high, Real low, Real scale, Real* error) {
  const Real product = high * scale;
  const Real rest = fma(high, scale, -product) + low * scale;
  const Real rounded = product + rest;
  *error = (product - rounded) + rest;
  return rounded;
}

/// The vector along high + low of length 1 (to within some 1e-7) whose components' rounding turns it least, out of four
/// lengths a float apart: half the error of rounding at one length.
INLINE Real3 leastTurned(Real3 high, Real3 low) {
  const Real ax = fabs(high.x), ay = fabs(high.y), az = fabs(high.z);
  const Real xy = ax > ay ? ax : ay, largest = xy > az ? xy : az;
  const Real sx = high.x / largest, sy = high.y / largest, sz = high.z / largest;
  const Real scale = 1.0f / (largest * sqrt(sx * sx + sy * sy + sz * sz));
  Real3 best = high;
  Real leastTurn = INFINITY;
  for (uint k = 0; k < 4; ++k) {
    const Real tried = AS_REAL(AS_NATURAL(scale) + k - 2u);
    Real ex, ey, ez;
    const Real x = scaledComponent(high.x, low.x, tried, &ex);
    const Real y = scaledComponent(high.y, low.y, tried, &ey);
    const Real z = scaledComponent(high.z, low.z, tried, &ez);
    const Real along = ex * x + ey * y + ez * z;
    const Real turn = ex * ex + ey * ey + ez * ez - along * along;
    const Mask better = turn < leastTurn;
    leastTurn = better ? turn : leastTurn;
    best.x = better ? x : best.x;
    best.y = better ? y : best.y;
    best.z = better ? z : best.z;
  }
  return best;
}

/// start + nx stepX + ny stepY, one component, and what that lost; steps and counts come in a high and a low part.
INLINE Real onPlane(float start, float stepX, float stepXLow, float stepY, float stepYLow, Real nx, Real nxLow, Real ny,
                    Real nyLow, Real* low) {
  const Real moveX = nx * stepX, moveY = ny * stepY;
  const Real withX = start + moveX, high = withX + moveY;
  *low = sumError(start, moveX, withX) + sumError(withX, moveY, high) +
         (fma(nx, (Real)(stepX), -moveX) + nxLow * stepX + nx * stepXLow) +
         (fma(ny, (Real)(stepY), -moveY) + nyLow * stepY + ny * stepYLow);
  return high;
}

/// Pixels (y << 16 | x) of LANES slots, and where in them their samples lie, twice: the sampled place runs over [0, 2).
INLINE Natural samplePixels(const DeviceCamera* camera, const Batch* batch, uint slot, uint count,
                            __global const uint* pixelOrder, Real* twiceX, Real* twiceY) {
  uint packed[LANES];
  float x[LANES], y[LANES];
  for (uint k = 0; k < LANES; ++k) {
    const uint own = slot + k < count ? slot + k : count - 1;
    packed[k] = pixelOrder[batch->firstPixel + own / batch->samples];
    const uint pixel = (packed[k] >> 16) * camera->width + (packed[k] & 0xffffu);
    const float2 at = samplePixel(camera, pixel, batch->firstSample + own % batch->samples);
    x[k] = 2.0f * at.x;
    y[k] = 2.0f * at.y;
  }
  *twiceX = LOAD(x);
  *twiceY = LOAD(y);
  return LOAD(packed);
}

#if HAS(LENS)
/// Where the samples' rays go through the lens, m from its middle, evenly over its disk; in a square of their own,
/// LENS_DIMENSION on.
#define LENS_DIMENSION 8u

INLINE Real3 lensPoints(const DeviceCamera* camera, const Batch* batch, uint slot, uint count,
                        __global const uint* pixelOrder) {
  float x[LANES], y[LANES];
  for (uint k = 0; k < LANES; ++k) {
    const uint own = slot + k < count ? slot + k : count - 1;
    const uint packed = pixelOrder[batch->firstPixel + own / batch->samples];
    const float2 at = sampleSquare(camera->sampler, (packed >> 16) * camera->width + (packed & 0xffffu),
                                   batch->firstSample + own % batch->samples, camera->raysPerPixel, LENS_DIMENSION,
                                   camera->seed);
    x[k] = at.x, y[k] = at.y;
  }
  const Real radius = camera->lensRadius * sqrt(LOAD(x));
  Real cosine, sine;
  aroundCircle(LOAD(y), &cosine, &sine);
  return add3(scale3(radius * cosine, same3((float3)(camera->right[0], camera->right[1], camera->right[2]))),
              scale3(radius * sine, same3((float3)(camera->up[0], camera->up[1], camera->up[2]))));
}
#endif

__kernel void raygen(
    const DeviceCamera camera, const Batch batch, const uint count, const uint capacity,
    __global const uint* pixelOrder,  // [pixels of the film] y << 16 | x of the picture, along a space-filling order
    __global float* rays) {           // [RAY_PLANES][capacity]; EYE_… without IMPULSES
  const uint slot = (uint)get_global_id(0) * LANES;
  if (slot >= count) return;
  const DeviceCamera own = camera;
  const Batch ownBatch = batch;
  Natural packed;
  Real fractionX = (Real)(1.0f), fractionY = (Real)(1.0f);
  if (own.raysPerPixel == 1 && slot + LANES <= count)
    packed = LOAD(pixelOrder + batch.firstPixel + slot);
  else
    packed = samplePixels(&own, &ownBatch, slot, count, pixelOrder, &fractionX, &fractionY);
  // Half pixels from the middle of the picture: whole + fraction, both exact.
  const Real wholeX = TO_REAL(2 * (packed & 0xffffu)) - (float)camera.width;
  const Real wholeY = TO_REAL(2 * (packed >> 16)) - (float)camera.height;
  const Real nx = wholeX + fractionX, ny = wholeY + fractionY;
  const Real nxLow = (wholeX - nx) + fractionX, nyLow = (wholeY - ny) + fractionY;
  const float* start = own.forward;
#if HAS(ORTHOGRAPHIC)
  if (camera.orthographic) start = own.position;
#endif
  Real3 high, low;
  high.x = onPlane(start[0], own.stepX[0], own.stepXLow[0], own.stepY[0], own.stepYLow[0], nx, nxLow, ny, nyLow,
                   &low.x);
  high.y = onPlane(start[1], own.stepX[1], own.stepXLow[1], own.stepY[1], own.stepYLow[1], nx, nxLow, ny, nyLow,
                   &low.y);
  high.z = onPlane(start[2], own.stepX[2], own.stepXLow[2], own.stepY[2], own.stepYLow[2], nx, nxLow, ny, nyLow,
                   &low.z);
  Real3 o = real3(own.position[0], own.position[1], own.position[2]);
  Real3 d;
#if HAS(ORTHOGRAPHIC)
  if (camera.orthographic) {
    o = real3(high.x + low.x, high.y + low.y, high.z + low.z);
    d = real3(own.forward[0], own.forward[1], own.forward[2]);
  } else
#endif
    d = leastTurned(high, low);
#if HAS(LENS)
  if (own.lensRadius > 0.0f) {
    // All that goes through a point of the plane in focus, from where on the lens it leaves.
    const Real3 lens = lensPoints(&own, &ownBatch, slot, count, pixelOrder);
    Real3 ahead = real3(high.x + low.x, high.y + low.y, high.z + low.z);
#if HAS(ORTHOGRAPHIC)
    if (camera.orthographic) ahead = d;
#endif
    d = normalize3(sub3(scale3((Real)(own.focusDistance), ahead), lens));
    o = add3(o, lens);
  }
#endif
  storeReal3(rays, capacity, RAY_O, slot, o);
  storeReal3(rays, capacity, RAY_D, slot, d);
#if HAS(NEAR_PLANE)
  // As though they had gone straight through the plane.
  const Real along = d.x * own.forward[0] + d.y * own.forward[1] + d.z * own.forward[2];
  STORE(own.znear / along, rays + (size_t)RAY_AFTER_ORDER * capacity + slot);
  STORE((Real)(0.0f), rays + (size_t)RAY_AFTER_TRIANGLE * capacity + slot);
#endif
#if HAS(IMPULSES)
  STORE(AS_REAL(slot + LANE_NUMBERS), rays + (size_t)RAY_SLOT * capacity + slot);
#endif
}
