// Lanes: the neighbouring entries of a queue that one work item handles side by side, eight (PACKETS, for a CPU's
// vectors) or one. Code in these types reads the same for both and gives the same bits: a choice is cond ? a : b, a
// comparison's result a Mask, combined by & | and ! only.
#include "lib/math.cl"

#if HAS(PACKETS)
#define LANES 8
typedef float8 Real;
typedef int8 Mask;
typedef uint8 Natural;
#define AS_REAL(x) as_float8(x)
#define AS_NATURAL(x) as_uint8(x)
#define TO_REAL(x) convert_float8(x)
#define LOAD(p) vload8(0, p)
#define STORE(x, p) vstore8(x, 0, p)
#define LANE_NUMBERS ((uint8)(0, 1, 2, 3, 4, 5, 6, 7))
INLINE int some(Mask mask) {
  const int4 four = mask.lo | mask.hi;
  const int2 two = four.lo | four.hi;
  return (two.x | two.y) != 0;
}
#else
#define LANES 1
typedef float Real;
typedef int Mask;
typedef uint Natural;
#define AS_REAL(x) as_float(x)
#define AS_NATURAL(x) as_uint(x)
#define TO_REAL(x) convert_float(x)
#define LOAD(p) (*(p))
#define STORE(x, p) (*(p) = (x))
#define LANE_NUMBERS 0u
INLINE int some(Mask mask) { return mask != 0; }
#endif

/// A vector for each lane.
typedef struct {
  Real x, y, z;
} Real3;

INLINE Real3 real3(Real x, Real y, Real z) {
  const Real3 v = {x, y, z};
  return v;
}

INLINE void storeReal3(__global float* queue, uint capacity, uint plane, uint i, Real3 v) {
  STORE(v.x, queue + (size_t)plane * capacity + i);
  STORE(v.y, queue + (size_t)(plane + 1) * capacity + i);
  STORE(v.z, queue + (size_t)(plane + 2) * capacity + i);
}

INLINE Real3 loadReal3(__global const float* queue, uint capacity, uint plane, uint i) {
  return real3(LOAD(queue + (size_t)plane * capacity + i), LOAD(queue + (size_t)(plane + 1) * capacity + i),
               LOAD(queue + (size_t)(plane + 2) * capacity + i));
}

/// The exact error of a sum, as sumError.
INLINE Real sumErrorReal(Real a, Real b, Real sum) {
  const Real part = sum - a;
  return (a - (sum - part)) + (b - part);
}
