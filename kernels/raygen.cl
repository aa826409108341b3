// raygen: one eye ray for each slot of the batch. Writes the ray queue, clears the slots' radiance.
//
// A direction a float's rounding off (3e-8) moves a texture seen at grazing incidence by hundredths of a texel, so the
// point on the image plane is computed to twice a float's precision, and rounded once.
#include "lib/sampler.cl"

/// (x, y, z) of a kernel argument's array.
#define VECTOR3(array) ((float3)((array)[0], (array)[1], (array)[2]))

/// (high + low) · scale, rounded once, for four scales; error: what that rounding lost.
INLINE float4 scaledComponent(float high, float low, float4 scale, float4* error) {
  const float4 product = high * scale;
  const float4 rest = fma((float4)(high), scale, -product) + low * scale;
  const float4 rounded = product + rest;
  *error = (product - rounded) + rest;
  return rounded;
}

/// The vector along high + low of length 1 (to within some 1e-7) whose components' rounding turns it least, out of four
/// lengths a float apart: half the error of rounding at one length.
INLINE float3 leastTurned(float3 high, float3 low) {
  const float3 size = fabs(high);
  const float largest = size.x > size.y ? (size.x > size.z ? size.x : size.z) : (size.y > size.z ? size.y : size.z);
  const float3 scaled = high / largest;
  const float scale = 1.0f / (largest * sqrt(dot3(scaled, scaled)));
  const float4 scales = as_float4(as_uint(scale) + (uint4)(0, 1, 2, 3) - 2u);
  float4 ex, ey, ez;
  const float4 x = scaledComponent(high.x, low.x, scales, &ex);
  const float4 y = scaledComponent(high.y, low.y, scales, &ey);
  const float4 z = scaledComponent(high.z, low.z, scales, &ez);
  const float4 along = ex * x + ey * y + ez * z;
  const float4 turn = ex * ex + ey * ey + ez * ez - along * along;
  const int2 second = turn.odd < turn.even;
  const float2 pairTurn = select(turn.even, turn.odd, second);
  const float2 pairX = select(x.even, x.odd, second), pairY = select(y.even, y.odd, second);
  const float2 pairZ = select(z.even, z.odd, second);
  return pairTurn.y < pairTurn.x ? (float3)(pairX.y, pairY.y, pairZ.y) : (float3)(pairX.x, pairY.x, pairZ.x);
}

__kernel void raygen(const DeviceCamera camera, const Batch batch, const uint count, const uint capacity,
                     __global const uint* pixelOrder,  // [pixels of the picture] y << 16 | x along a space-filling order
                     __global float* rays,             // [RAY_PLANES][capacity]
                     __global float* sampleRadiance) { // [3][capacity] by slot
  const uint slot = get_global_id(0);
  if (slot >= count) return;
  const uint packed = pixelOrder[batch.firstPixel + slot / batch.samples];
  const uint sample = batch.firstSample + slot % batch.samples;
  const uint px = packed & 0xffffu, py = packed >> 16;
  const DeviceCamera own = camera;
  const float2 at = samplePixel(&own, py * camera.width + px, sample);
  // Half pixels from the middle of the picture: whole + fraction, both exact.
  const float wholeX = (float)(2 * (int)px - (int)camera.width), wholeY = (float)(2 * (int)py - (int)camera.height);
  const float fractionX = 2.0f * at.x, fractionY = 2.0f * at.y;
  const float3 stepX = VECTOR3(camera.stepX), stepY = VECTOR3(camera.stepY);
  float3 start = VECTOR3(camera.forward);
#if HAS(ORTHOGRAPHIC)
  if (camera.orthographic) start = VECTOR3(camera.position);
#endif
  const float nx = wholeX + fractionX, ny = wholeY + fractionY;
  const float nxLow = (wholeX - nx) + fractionX, nyLow = (wholeY - ny) + fractionY;
  const float3 moveX = nx * stepX, moveY = ny * stepY;
  const float3 withX = start + moveX, high = withX + moveY;
  const float3 low = sumError3(start, moveX, withX) + sumError3(withX, moveY, high) +
                     (fma((float3)(nx), stepX, -moveX) + nxLow * stepX + nx * VECTOR3(camera.stepXLow)) +
                     (fma((float3)(ny), stepY, -moveY) + nyLow * stepY + ny * VECTOR3(camera.stepYLow));
  float3 o = VECTOR3(camera.position);
  float3 d;
#if HAS(ORTHOGRAPHIC)
  if (camera.orthographic) {
    o = high + low;
    d = VECTOR3(camera.forward);
  } else
#endif
    d = leastTurned(high, low);
  storePlanes3(rays, capacity, RAY_O, slot, o);
  storePlanes3(rays, capacity, RAY_D, slot, d);
  storePlanes3(rays, capacity, RAY_THROUGHPUT, slot, (float3)(1.0f));
  rays[(size_t)RAY_SLOT * capacity + slot] = as_float(slot);
  storePlanes3(sampleRadiance, capacity, 0, slot, (float3)(0.0f));
}
