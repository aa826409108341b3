// Small mathematics: vectors in plain arrays, exact-sign differences of products, luminance.
#include "shared/features.h"
#include "shared/layout.h"
#pragma OPENCL FP_CONTRACT OFF

// A work-group function of PoCL is compiled three times over, so that no helper is called once only and few would be put in
// line; in line they take a tenth less time in shade.
#define INLINE __attribute__((always_inline))

#define PI 3.14159265358979323846f

INLINE float3 load3(__global const float* p) { return (float3)(p[0], p[1], p[2]); }

/// Plane p, p+1, p+2 of entry i of a struct-of-arrays queue.
INLINE float3 loadPlanes3(__global const float* queue, uint capacity, uint plane, uint i) {
  return (float3)(queue[(size_t)plane * capacity + i], queue[(size_t)(plane + 1) * capacity + i],
                  queue[(size_t)(plane + 2) * capacity + i]);
}

INLINE void storePlanes3(__global float* queue, uint capacity, uint plane, uint i, float3 v) {
  queue[(size_t)plane * capacity + i] = v.x;
  queue[(size_t)(plane + 1) * capacity + i] = v.y;
  queue[(size_t)(plane + 2) * capacity + i] = v.z;
}

INLINE float dot3(float3 a, float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

INLINE float3 cross3(float3 a, float3 b) {
  return (float3)(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/// Unit vector; scaled first so that 1e-30 and 1e30 survive the squares. (0,0,0) and NaN give NaN.
INLINE float3 normalize3(float3 v) {
  float m = fabs(v.x);
  m = fabs(v.y) > m ? fabs(v.y) : m;
  m = fabs(v.z) > m ? fabs(v.z) : m;
  const float3 s = v / m;
  return s / sqrt(dot3(s, s));
}

/// a·b − c·d with the right sign and 1.5 ulp (Kahan; Jeannerod, Louvet, Muller 2013).
INLINE float differenceOfProducts(float a, float b, float c, float d) {
  const float cd = c * d;
  const float difference = fma(a, b, -cd);
  const float error = fma(-c, d, cd);
  return difference + error;
}

INLINE float8 differenceOfProducts8(float8 a, float8 b, float8 c, float8 d) {
  const float8 cd = c * d;
  const float8 difference = fma(a, b, -cd);
  const float8 error = fma(-c, d, cd);
  return difference + error;
}

INLINE float16 differenceOfProducts16(float16 a, float16 b, float16 c, float16 d) {
  const float16 cd = c * d;
  const float16 difference = fma(a, b, -cd);
  const float16 error = fma(-c, d, cd);
  return difference + error;
}

/// Of four, pairs first; selects, since fmax and fmin are slow on PoCL.
INLINE float8 largest8(float8 a, float8 b, float8 c, float8 d) {
  const float8 ab = a > b ? a : b, cd = c > d ? c : d;
  return ab > cd ? ab : cd;
}

INLINE float8 smallest8(float8 a, float8 b, float8 c, float8 d) {
  const float8 ab = a < b ? a : b, cd = c < d ? c : d;
  return ab < cd ? ab : cd;
}

INLINE float16 largest16(float16 a, float16 b, float16 c, float16 d) {
  const float16 ab = a > b ? a : b, cd = c > d ? c : d;
  return ab > cd ? ab : cd;
}

INLINE float16 smallest16(float16 a, float16 b, float16 c, float16 d) {
  const float16 ab = a < b ? a : b, cd = c < d ? c : d;
  return ab < cd ? ab : cd;
}

// Clang that writes code for a processor has operations of its own. On the way to SPIR-V it takes them too, and the
// translation ends there, as that does not know them; Mesa hides __SPIR__, so it is processors that are named.
#if defined(__clang__) && (defined(__x86_64__) || defined(__i386__) || defined(__aarch64__) || defined(__arm__) || \
                           defined(__powerpc64__) || defined(__riscv))
#define CLANG_FOR_PROCESSOR 1
#endif

// Reductions over lanes. Where the compiler has them of its own, they become few instructions.
#if defined(CLANG_FOR_PROCESSOR) && defined(__has_builtin)
#if __has_builtin(__builtin_reduce_or) && __has_builtin(__builtin_reduce_min)
#define HAS_REDUCTIONS 1
#endif
#endif

#ifdef HAS_REDUCTIONS
/// True if any (every) lane's mask, all bits set or none, is set.
INLINE int anyOf8(int8 mask) { return __builtin_reduce_or(mask) < 0; }
INLINE int anyOf16(int16 mask) { return __builtin_reduce_or(mask) < 0; }
INLINE int allOf16(int16 mask) { return __builtin_reduce_and(mask) < 0; }
INLINE uint least8(uint8 v) { return __builtin_reduce_min(v); }
#else
INLINE int anyOf8(int8 mask) {
  const int4 a = mask.lo | mask.hi;
  const int2 b = a.lo | a.hi;
  return (b.x | b.y) != 0;
}
INLINE int anyOf16(int16 mask) { return anyOf8(mask.lo | mask.hi); }
INLINE int allOf16(int16 mask) { return !anyOf16(~mask); }
INLINE uint least8(uint8 v) {
  const uint4 a = min(v.lo, v.hi);
  const uint2 b = min(a.lo, a.hi);
  return min(b.x, b.y);
}
#endif

/// Of lanes that are numbers; halving, because a compiler's own reduction takes care of NaN in each step.
INLINE float greatest16(float16 v) {
  const float8 a = v.lo > v.hi ? v.lo : v.hi;
  const float4 b = a.lo > a.hi ? a.lo : a.hi;
  const float2 c = b.lo > b.hi ? b.lo : b.hi;
  return c.x > c.y ? c.x : c.y;
}

INLINE float least16(float16 v) {
  const float8 a = v.lo < v.hi ? v.lo : v.hi;
  const float4 b = a.lo < a.hi ? a.lo : a.hi;
  const float2 c = b.lo < b.hi ? b.lo : b.hi;
  return c.x < c.y ? c.x : c.y;
}

/// What a + b lost when it was rounded to `sum`; exact (Knuth's two-sum).
INLINE float sumError(float a, float b, float sum) {
  const float part = sum - a;
  return (a - (sum - part)) + (b - part);
}

INLINE float3 sumError3(float3 a, float3 b, float3 sum) {
  const float3 part = sum - a;
  return (a - (sum - part)) + (b - part);
}

/// Rec. 709 luminance.
INLINE float luminance(float3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

INLINE int anyPositive(float3 c) { return c.x > 0.0f || c.y > 0.0f || c.z > 0.0f; }

INLINE int isFinite3(float3 v) { return isfinite(v.x) && isfinite(v.y) && isfinite(v.z); }
