// film: adds the finished samples of a batch to their pixels, in sample order, with compensated sums (Neumaier 1974;
// renormalised at each step, Dekker 1971).
// A sample that is not finite is counted and left out.
#include "lib/math.cl"

/// sum + value; *compensation is what the result lacks. Errors of a long sum all lean the same way: the compensation is
/// handed back to the sum at once, or it would itself grow until it rounds (6e-5 off after 10^6 samples).
INLINE float compensatedAdd(float sum, float value, float* compensation) {
  const float result = sum + value;
  const float error = fabs(sum) >= fabs(value) ? (sum - result) + value : (value - result) + sum;
  const float lacking = *compensation + error;
  const float renormalised = result + lacking;
  *compensation = (result - renormalised) + lacking;
  return renormalised;
}

__kernel void film(const Batch batch, const uint capacity, const uint pixels, __global const float* sampleRadiance,
                   __global float* sums,  // [FILM_PLANES][pixels of the picture], in the pixel order: no scattered writes
                   __global uint* counters) {
  const uint k = get_global_id(0);
  if (k >= batch.pixels) return;
  const uint pixel = batch.firstPixel + k;
  float sum[4], compensation[4];
  for (int c = 0; c < 4; ++c) {
    sum[c] = sums[(size_t)(c < 3 ? FILM_SUM + c : FILM_SQUARES) * pixels + pixel];
    compensation[c] = sums[(size_t)(c < 3 ? FILM_COMPENSATION + c : FILM_SQUARES_COMPENSATION) * pixels + pixel];
  }
  for (uint s = 0; s < batch.samples; ++s) {
    const float3 value = loadPlanes3(sampleRadiance, capacity, 0, k * batch.samples + s);
    if (!isFinite3(value)) {
      atomic_inc(counters + COUNTER_NONFINITE);
      continue;
    }
    const float y = luminance(value);
    sum[0] = compensatedAdd(sum[0], value.x, &compensation[0]);
    sum[1] = compensatedAdd(sum[1], value.y, &compensation[1]);
    sum[2] = compensatedAdd(sum[2], value.z, &compensation[2]);
    sum[3] = compensatedAdd(sum[3], y * y, &compensation[3]);
  }
  for (int c = 0; c < 4; ++c) {
    sums[(size_t)(c < 3 ? FILM_SUM + c : FILM_SQUARES) * pixels + pixel] = sum[c];
    sums[(size_t)(c < 3 ? FILM_COMPENSATION + c : FILM_SQUARES_COMPENSATION) * pixels + pixel] = compensation[c];
  }
}
