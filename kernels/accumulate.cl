// accumulate: throughput · radiance of a segment's entries into the radiance of their samples. The entries of
// one sample are neighbours; the work item at the first of them adds them all in queue order, so no order is
// left to chance.
#include "lib/math.cl"

/// Planes p, p + 1, p + 2 of entry i of a struct-of-arrays queue.
INLINE float3 loadPlanes3(__global const float* queue, uint capacity, uint plane, uint i) {
  return (float3)(queue[(size_t)plane * capacity + i], queue[(size_t)(plane + 1) * capacity + i],
                  queue[(size_t)(plane + 2) * capacity + i]);
}

INLINE void storePlanes3(__global float* queue, uint capacity, uint plane, uint i, float3 v) {
  queue[(size_t)plane * capacity + i] = v.x;
  queue[(size_t)(plane + 1) * capacity + i] = v.y;
  queue[(size_t)(plane + 2) * capacity + i] = v.z;
}

__kernel void accumulate(const uint first, const uint count, const uint capacity, __global const float* rays,
                         __global const float* entryRadiance, __global float* sampleRadiance) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  __global const float* slots = rays + (size_t)RAY_SLOT * capacity + first;
  const uint slot = as_uint(slots[i]);
  if (i > 0 && as_uint(slots[i - 1]) == slot) return;
  float3 sum = loadPlanes3(sampleRadiance, capacity, 0, slot);
  for (uint k = i; k < count && as_uint(slots[k]) == slot; ++k)
    sum += loadPlanes3(rays, capacity, RAY_THROUGHPUT, first + k) * loadPlanes3(entryRadiance, capacity, 0, k);
  storePlanes3(sampleRadiance, capacity, 0, slot, sum);
#if HAS(COVERAGE)
  __global const float* own = entryRadiance + (size_t)RADIANCE_TRANSMITTANCE * capacity;
  __global float* transmittance = sampleRadiance + (size_t)RADIANCE_TRANSMITTANCE * capacity + slot;
  float clear = *transmittance;
  for (uint k = i; k < count && as_uint(slots[k]) == slot; ++k) {
    const float3 throughput = loadPlanes3(rays, capacity, RAY_THROUGHPUT, first + k);
    clear += (throughput.x + throughput.y + throughput.z) * (1.0f / 3.0f) * own[k];
  }
  *transmittance = clear;
#endif
}
