// Small mathematics that is not counted in lanes: differences of products, the largest of some, reductions.
#include "shared/features.h"
#include "shared/layout.h"
#pragma OPENCL FP_CONTRACT OFF
#ifdef __clang__
#pragma clang diagnostic ignored "-Wpsabi"  // sixteen floats passed without AVX-512: every function is put in line
#endif

// A work-group function of PoCL is compiled three times over, so that no helper is called once only and few would be
// put in line; in line they take a tenth less time in shade.
#ifndef INLINE  // noinline for Oclgrind: what is put in line has hints about aliases that it does not know
#define INLINE __attribute__((always_inline))
#endif

#define PI 3.14159265358979323846f

INLINE float3 load3(__global const float* p) { return (float3)(p[0], p[1], p[2]); }

// Searches compare eight boxes or sixteen rays at once: their functions end in the number of values side by side
// (lanes.cl). What they compute has one text, a macro, written out for each width; `width` is empty for a single value.

/// a·b − c·d with the right sign and 1.5 ulp (Kahan; Jeannerod, Louvet, Muller 2013).
#define DIFFERENCE_OF_PRODUCTS(Float, width)                                     \
  INLINE Float differenceOfProducts##width(Float a, Float b, Float c, Float d) { \
    const Float cd = c * d;                                                      \
    const Float difference = fma(a, b, -cd);                                     \
    const Float error = fma(-c, d, cd);                                          \
    return difference + error;                                                   \
  }
DIFFERENCE_OF_PRODUCTS(float, )
DIFFERENCE_OF_PRODUCTS(float8, 8)
DIFFERENCE_OF_PRODUCTS(float16, 16)

/// Of four, pairs first; selects, since fmax and fmin are slow on PoCL.
#define FIRST_OF_FOUR(Float, name, before)                \
  INLINE Float name(Float a, Float b, Float c, Float d) { \
    const Float ab = a before b ? a : b;                  \
    const Float cd = c before d ? c : d;                  \
    return ab before cd ? ab : cd;                        \
  }
FIRST_OF_FOUR(float8, largest8, >)
FIRST_OF_FOUR(float8, smallest8, <)
FIRST_OF_FOUR(float16, largest16, >)
FIRST_OF_FOUR(float16, smallest16, <)

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

/// One bit for each lane of a comparison.
INLINE uint laneBits(int8 mask) {
#if defined(__AVX__) && defined(CLANG_FOR_PROCESSOR)
  return (uint)__builtin_ia32_movmskps256(as_float8(mask));
#else
  const int8 bits = mask & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
  const int4 a = bits.lo | bits.hi;
  const int2 b = a.lo | a.hi;
  return (uint)(b.x | b.y);
#endif
}

INLINE uint laneBits16(int16 mask) {
#if defined(__AVX512DQ__) && defined(CLANG_FOR_PROCESSOR)
  return (uint)__builtin_ia32_cvtd2mask512(mask);
#else
  return laneBits(mask.lo) | laneBits(mask.hi) << 8;
#endif
}

/// The mask that has these bits.
INLINE int16 lanesOfBits(uint bits) {
  const int16 bit = (int16)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768);
  return ((int16)((int)bits) & bit) != 0;
}

INLINE uint lowestBit(uint bits) {
#ifdef CLANG_FOR_PROCESSOR
  return (uint)__builtin_ctz(bits);
#else
  return popcount((bits & (0u - bits)) - 1u);
#endif
}

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
