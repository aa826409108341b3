// Small mathematics: vectors in plain arrays, exact-sign differences of products, luminance.
#include "shared/features.h"
#include "shared/layout.h"
#pragma OPENCL FP_CONTRACT OFF

#define PI 3.14159265358979323846f

float3 load3(__global const float* p) { return (float3)(p[0], p[1], p[2]); }

/// Plane p, p+1, p+2 of entry i of a struct-of-arrays queue.
float3 loadPlanes3(__global const float* queue, uint capacity, uint plane, uint i) {
  return (float3)(queue[(size_t)plane * capacity + i], queue[(size_t)(plane + 1) * capacity + i],
                  queue[(size_t)(plane + 2) * capacity + i]);
}

void storePlanes3(__global float* queue, uint capacity, uint plane, uint i, float3 v) {
  queue[(size_t)plane * capacity + i] = v.x;
  queue[(size_t)(plane + 1) * capacity + i] = v.y;
  queue[(size_t)(plane + 2) * capacity + i] = v.z;
}

float dot3(float3 a, float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

float3 cross3(float3 a, float3 b) {
  return (float3)(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/// Unit vector; scaled first so that 1e-30 and 1e30 survive the squares. (0,0,0) and NaN give NaN.
float3 normalize3(float3 v) {
  float m = fabs(v.x);
  m = fabs(v.y) > m ? fabs(v.y) : m;
  m = fabs(v.z) > m ? fabs(v.z) : m;
  const float3 s = v / m;
  return s / sqrt(dot3(s, s));
}

/// a·b − c·d with the right sign and 1.5 ulp (Kahan; Jeannerod, Louvet, Muller 2013).
float differenceOfProducts(float a, float b, float c, float d) {
  const float cd = c * d;
  const float difference = fma(a, b, -cd);
  const float error = fma(-c, d, cd);
  return difference + error;
}

/// Rec. 709 luminance.
float luminance(float3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

int anyPositive(float3 c) { return c.x > 0.0f || c.y > 0.0f || c.z > 0.0f; }

int isFinite3(float3 v) { return isfinite(v.x) && isfinite(v.y) && isfinite(v.z); }
