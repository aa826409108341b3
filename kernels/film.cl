// film: adds the finished samples of a batch to their pixels, LANES pixels for each work item, in sample order, with
// compensated sums (Neumaier 1974; renormalised at each step, Dekker 1971).
// A sample that is not finite is counted and left out.
#include "lib/lanes.cl"

/// sum + value; *compensation is what the result lacks. Errors of a long sum all lean the same way: the compensation is
/// handed back to the sum at once, or it would itself grow until it rounds (6e-5 off after 10^6 samples).
INLINE void compensatedAdd(Real* sum, Real value, Real* compensation) {
  const Real result = *sum + value;
  const Real error = fabs(*sum) >= fabs(value) ? (*sum - result) + value : (value - result) + *sum;
  const Real lacking = *compensation + error;
  *sum = result + lacking;
  *compensation = (result - *sum) + lacking;
}

/// Slots first, first + step, … of a plane of the samples; the last of `active` lanes stands in for those beyond.
INLINE Real loadSlots(__global const float* plane, uint first, uint step, uint active) {
  if (step == 1 && active == LANES) return LOAD(plane + first);
  float own[LANES];
  for (uint k = 0; k < LANES; ++k) own[k] = plane[first + step * (k < active ? k : active - 1)];
  return LOAD(own);
}

/// The film's sums: RGB, the mean of their squares, the transmittance; and the planes where they are.
#define SUM_SQUARES 3
#define SUM_TRANSMITTANCE 4
#define FILM_SUMS (HAS(COVERAGE) ? 5 : 4)

INLINE uint planeOfSum(int c) {
  return c < SUM_SQUARES ? FILM_SUM + c : (c == SUM_SQUARES ? FILM_SQUARES : FILM_TRANSMITTANCE);
}

INLINE uint planeOfCompensation(int c) {
  return c < SUM_SQUARES ? FILM_COMPENSATION + c
                         : (c == SUM_SQUARES ? FILM_SQUARES_COMPENSATION : FILM_TRANSMITTANCE_COMPENSATION);
}

INLINE void storeActive(Real value, __global float* to, uint active) {
  if (active == LANES) {
    STORE(value, to);
    return;
  }
  float own[LANES];
  STORE(value, own);
  for (uint k = 0; k < active; ++k) to[k] = own[k];
}

__kernel void film(
    const Batch batch, const uint capacity, const uint pixels, const uint planes,
    __global const uint* blocks,  // of the film, one for each FILM_BLOCK pixels of the pass; null: pixel by pixel
    __global const float* sampleRadiance,
    __global float* sums,  // [planes][pixels of the film], in the pixel order: no scattered writes
    __global uint* counters) {
  const uint k = (uint)get_global_id(0) * LANES;
  if (k >= batch.pixels) return;
  const uint active = batch.pixels - k < LANES ? batch.pixels - k : LANES;
  const uint pixel = batch.firstPixel + k;
  __global float* own = sums + (blocks ? blocks[pixel / FILM_BLOCK] * FILM_BLOCK + pixel % FILM_BLOCK : pixel);
  Real sum[FILM_SUMS], compensation[FILM_SUMS];
  for (int c = 0; c < FILM_SUMS; ++c) {
    // Before the first sample the film is 0.
    sum[c] = compensation[c] = (Real)(0.0f);
    if (batch.firstSample == 0) continue;
    sum[c] = loadSlots(own + (size_t)planeOfSum(c) * pixels, 0, 1, active);
    compensation[c] = loadSlots(own + (size_t)planeOfCompensation(c) * pixels, 0, 1, active);
  }
  for (uint s = 0; s < batch.samples; ++s) {
    const uint slot = k * batch.samples + s;
    Real value[FILM_SUMS];
    for (int c = 0; c < 3; ++c)
      value[c] = loadSlots(sampleRadiance + (size_t)c * capacity, slot, batch.samples, active);
    const Mask finite = isfinite(value[0]) & isfinite(value[1]) & isfinite(value[2]);
    if (some(!finite)) {
      int lost[LANES];
      STORE(!finite, lost);
      for (uint lane = 0; lane < active; ++lane)
        if (lost[lane]) atomic_inc(counters + COUNTER_NONFINITE);
    }
    value[SUM_SQUARES] = (value[0] * value[0] + value[1] * value[1] + value[2] * value[2]) * (1.0f / 3.0f);
#if HAS(COVERAGE)
    value[SUM_TRANSMITTANCE] = loadSlots(sampleRadiance + (size_t)RADIANCE_TRANSMITTANCE * capacity, slot,
                                         batch.samples, active);
#endif
    for (int c = 0; c < FILM_SUMS; ++c) {
      Real after = sum[c], lacking = compensation[c];
      compensatedAdd(&after, value[c], &lacking);
      sum[c] = finite ? after : sum[c];
      compensation[c] = finite ? lacking : compensation[c];
    }
  }
  if (planes < FILM_PLANES) {
    for (int c = 0; c < 3; ++c) storeActive(sum[c], own + (size_t)(FILM_SUM + c) * pixels, active);
#if HAS(COVERAGE)
    storeActive(sum[SUM_TRANSMITTANCE], own + (size_t)FILM_TRANSMITTANCE_OF_ONE * pixels, active);
#endif
    return;
  }
  for (int c = 0; c < FILM_SUMS; ++c) {
    storeActive(sum[c], own + (size_t)planeOfSum(c) * pixels, active);
    storeActive(compensation[c], own + (size_t)planeOfCompensation(c) * pixels, active);
  }
}
