// What a driver may do otherwise than OpenCL says, tried before anything is drawn on it: how long loops run, and the
// arithmetic that the bits of a picture depend on. host/cl/device_probes.cpp knows what must come out.
#include "lib/math.cl"

/// A generator of full period (Numerical Recipes' constants): where it stands tells how often it was asked.
INLINE uint probeStep(uint x) { return x * 1664525u + 1013904223u; }

/// `outer` iterations, each with `inner` more within, take a step each. states: where each item begins, and ends. (A
/// loop within counts once more than it runs where loops are counted, so that none may be there for `inner` 0.)
__kernel void probe_loops(const uint outer, const uint inner, __global uint* states) {
  const uint i = get_global_id(0);
  uint x = states[i];
  if (inner == 0) {
    for (uint k = 0; k < outer; ++k) x = probeStep(x);
  } else {
    for (uint k = 0; k < outer; ++k) {
      x = probeStep(x);
      for (uint m = 0; m < inner; ++m) x = probeStep(x);
    }
  }
  states[i] = x;
}

/// Values for each item.
#define PROBE_VALUES 14

__kernel void probe_arithmetic(const uint count, __global const float* a, __global const float* b,
                               __global const float* c, __global float* out) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  const float x = a[i], y = b[i], z = c[i];
  __global float* own = out + (size_t)i * PROBE_VALUES;
  own[0] = x * y - y * x;  // contracted, it is what one of the products lost
  own[1] = fma(x, y, z);
  own[2] = differenceOfProducts(x, y, z, x);
  own[3] = x / y;
  own[4] = sqrt(fabs(x));
  own[5] = x > y ? x : z;
  own[6] = (float)((int)(x * 1000.0f));
  own[7] = (float)((uint)fabs(z * 4096.0f));
  own[8] = (float)(as_uint(x) * 2654435761u >> 8);
  const ulong wide = (ulong)as_uint(x) << 24 | as_uint(y);
  own[9] = (float)((uint)((wide + as_uint(z)) >> 32));
  const float8 lanes = (float8)(x, y, z, x, y, z, x, y);
  const float8 chosen = lanes > (float8)(y) ? lanes : (float8)(z);
  own[10] = chosen.s0;
  float values[8];
  vstore8(lanes, 0, values);
  own[11] = values[as_uint(y) & 7u];  // a private array at a place that no compiler knows
  const float nan = as_float(0x7fc00000u | (as_uint(x) & 1u));
  own[12] = (nan > x ? 1.0f : 0.0f) + (nan == nan ? 2.0f : 0.0f) + (isfinite(nan) ? 4.0f : 0.0f) +
            (isfinite(x) ? 8.0f : 0.0f);
  own[13] = as_float((as_uint(x) & 0xffffu) | 0x00800000u) * 0.5f;  // too small for a normal number
}
