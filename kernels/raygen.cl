// raygen: one eye ray for each slot of the batch. Writes the ray queue, clears the slots' radiance.
#include "lib/sampler.cl"

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
  const float x = 2.0f * (((float)px + at.x) / (float)camera.width) - 1.0f;
  const float y = 1.0f - 2.0f * (((float)py + at.y) / (float)camera.height);
  const float3 right = (float3)(camera.right[0], camera.right[1], camera.right[2]);
  const float3 up = (float3)(camera.up[0], camera.up[1], camera.up[2]);
  const float3 forward = (float3)(camera.forward[0], camera.forward[1], camera.forward[2]);
  const float3 offset = right * (x * camera.scaleX) + up * (y * camera.scaleY);
  float3 o = (float3)(camera.position[0], camera.position[1], camera.position[2]);
  float3 d = forward;
#if HAS(ORTHOGRAPHIC)
  if (camera.orthographic)
    o += offset;
  else
#endif
    d = normalize3(offset + forward);
  storePlanes3(rays, capacity, RAY_O, slot, o);
  storePlanes3(rays, capacity, RAY_D, slot, d);
  storePlanes3(rays, capacity, RAY_THROUGHPUT, slot, (float3)(1.0f));
  rays[(size_t)RAY_SLOT * capacity + slot] = as_float(slot);
  storePlanes3(sampleRadiance, capacity, 0, slot, (float3)(0.0f));
}
