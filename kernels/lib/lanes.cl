// Lanes: what one work item handles side by side, in the types Real, Natural, Mask and Real3. LANES says how many:
// eight entries of a queue with PACKETS (for a CPU's vectors), else one. Searches ask about one surface at a time and
// have one lane (search/one_lane.cl). Code in these types is one text for both and gives the same bits: a choice is
// cond ? a : b, a comparison's result a Mask, combined by & | and ! only.
//
// Names: an 8 or 16 at the end (anyOf8, largest16) is a width of its own, whatever LANES is. Without it a function of
// these types has LANES lanes, and one of float, uint or float3 a single value. The 3 of dot3 counts axes.
#include "lib/math.cl"

#ifndef LANES
#if HAS(PACKETS)
#define LANES ENTRY_LANES
#else
#define LANES 1
#endif
#endif

#if LANES == ENTRY_LANES
typedef float8 Real;
typedef int8 Mask;
typedef uint8 Natural;
#define AS_REAL(x) as_float8(x)
#define AS_NATURAL(x) as_uint8(x)
#define TO_REAL(x) convert_float8(x)
#define TO_WHOLE(x) convert_int8(x)
#define TO_SIGNED(x) as_int8(x)
#define LOAD(p) vload8(0, p)
#define STORE(x, p) vstore8(x, 0, p)
#define LANE_NUMBERS ((uint8)(0, 1, 2, 3, 4, 5, 6, 7))
#define FIRST(x) (x).s0
INLINE Real gather(__global const float* p, Natural at) {
  return (float8)(p[at.s0], p[at.s1], p[at.s2], p[at.s3], p[at.s4], p[at.s5], p[at.s6], p[at.s7]);
}
/// Of places below 2^31: with signed indices processors that gather take all lanes at once.
INLINE Real gatherNear(__global const float* p, Mask at) {
  return (float8)(p[at.s0], p[at.s1], p[at.s2], p[at.s3], p[at.s4], p[at.s5], p[at.s6], p[at.s7]);
}
INLINE int some(Mask mask) { return anyOf8(mask); }
#else
typedef float Real;
typedef int Mask;
typedef uint Natural;
#define AS_REAL(x) as_float(x)
#define AS_NATURAL(x) as_uint(x)
#define TO_REAL(x) convert_float(x)
#define TO_WHOLE(x) convert_int(x)
#define TO_SIGNED(x) as_int(x)
#define LOAD(p) (*(p))
#define STORE(x, p) (*(p) = (x))
#define LANE_NUMBERS 0u
#define FIRST(x) (x)
INLINE Real gather(__global const float* p, Natural at) { return p[at]; }
INLINE Real gatherNear(__global const float* p, Mask at) { return p[at]; }
INLINE int some(Mask mask) { return mask != 0; }
#endif

INLINE Natural gatherWords(__global const uint* p, Natural at) {
  return AS_NATURAL(gather((__global const float*)p, at));
}

/// A vector for each lane.
typedef struct {
  Real x, y, z;
} Real3;

INLINE Real3 real3(Real x, Real y, Real z) {
  const Real3 v = {x, y, z};
  return v;
}

INLINE Real3 same3(float3 v) { return real3(v.x, v.y, v.z); }
INLINE Real3 add3(Real3 a, Real3 b) { return real3(a.x + b.x, a.y + b.y, a.z + b.z); }
INLINE Real3 sub3(Real3 a, Real3 b) { return real3(a.x - b.x, a.y - b.y, a.z - b.z); }
INLINE Real3 mul3(Real3 a, Real3 b) { return real3(a.x * b.x, a.y * b.y, a.z * b.z); }
INLINE Real3 scale3(Real s, Real3 v) { return real3(s * v.x, s * v.y, s * v.z); }
INLINE Real3 over3(Real3 v, Real s) { return real3(v.x / s, v.y / s, v.z / s); }
INLINE Real3 minus3(Real3 v) { return real3(-v.x, -v.y, -v.z); }
INLINE Real3 choose3(Mask m, Real3 a, Real3 b) { return real3(m ? a.x : b.x, m ? a.y : b.y, m ? a.z : b.z); }
/// The same for each axis by itself.
typedef struct {
  Mask x, y, z;
} Mask3;
INLINE Real3 chooseEach3(Mask3 m, Real3 a, Real3 b) { return real3(m.x ? a.x : b.x, m.y ? a.y : b.y, m.z ? a.z : b.z); }
INLINE Real dot3(Real3 a, Real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
INLINE Real3 cross3(Real3 a, Real3 b) {
  return real3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
INLINE Real largestOfThree(Real a, Real b, Real c) {
  const Real ab = a > b ? a : b;
  return ab > c ? ab : c;
}
INLINE Real clampUnit(Real x) { return x > 0.0f ? (x < 1.0f ? x : (Real)(1.0f)) : (Real)(0.0f); }
/// Rec. 709 luminance.
INLINE Real luminance(Real3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }
INLINE Mask anyPositive(Real3 c) { return (c.x > 0.0f) | (c.y > 0.0f) | (c.z > 0.0f); }
/// Light that must not be lost: also what is no number, so that the film can count it.
INLINE Mask notDark(Real3 c) { return !((c.x <= 0.0f) & (c.y <= 0.0f) & (c.z <= 0.0f)); }
INLINE Mask isFinite3(Real3 v) { return isfinite(v.x) & isfinite(v.y) & isfinite(v.z); }

/// Unit vector; scaled first so that 1e-30 and 1e30 survive the squares. (0,0,0) and NaN give NaN.
INLINE Real3 normalize3(Real3 v) {
  const Real3 s = over3(v, largestOfThree(fabs(v.x), fabs(v.y), fabs(v.z)));
  return over3(s, sqrt(dot3(s, s)));
}

INLINE Real3 gather3(__global const float* p, Natural at) {
  return real3(gather(p, at), gather(p + 1, at), gather(p + 2, at));
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

/// What a + b lost when it was rounded to `sum`; exact (Knuth's two-sum).
INLINE Real sumError(Real a, Real b, Real sum) {
  const Real part = sum - a;
  return (a - (sum - part)) + (b - part);
}
INLINE Real3 sumError3(Real3 a, Real3 b, Real3 sum) {
  return real3(sumError(a.x, b.x, sum.x), sumError(a.y, b.y, sum.y), sumError(a.z, b.z, sum.z));
}

/// Two unit vectors across `axis` (unit) and each other (Duff et al., "Building an Orthonormal Basis, Revisited",
/// 2017).
INLINE void basisAbout(Real3 axis, Real3* right, Real3* up) {
  const Real side = axis.z < 0.0f ? (Real)(-1.0f) : (Real)(1.0f);
  const Real a = -1.0f / (side + axis.z), b = axis.x * axis.y * a;
  *right = real3(1.0f + side * axis.x * axis.x * a, side * b, -side * axis.x);
  *up = real3(b, side + axis.y * axis.y * a, -axis.y);
}

/// A point of the unit square for each lane.
typedef struct {
  Real u, v;
} Square;

/// cos and sin of 2 pi turns; lane by lane, since those of vectors may round otherwise.
INLINE void aroundCircle(Real turns, Real* cosine, Real* sine) {
  float c[LANES], s[LANES];
  STORE(turns, c);
  for (uint k = 0; k < LANES; ++k) {
    const float halfTurns = 2.0f * c[k];
    c[k] = cospi(halfTurns), s[k] = sinpi(halfTurns);
  }
  *cosine = LOAD(c);
  *sine = LOAD(s);
}

/// One struct out of an array for each lane: where its words begin. Neighbours mostly share one.
typedef struct {
  __global const float* words;
  Natural begin;
  int same;  // in all lanes
} Records;

INLINE Records recordsAt(__global const void* array, Natural index, uint wordsEach) {
  Records r;
  r.words = (__global const float*)array;
  r.begin = index * wordsEach;
  r.same = !some(r.begin != FIRST(r.begin));
  return r;
}

INLINE Real wordOf(const Records* r, uint word) {
  return r->same ? (Real)(r->words[FIRST(r->begin) + word]) : gather(r->words + word, r->begin);
}

#define WORDS_OF(Struct) ((uint)(sizeof(Struct) / 4))
/// A null pointer need not be address 0 (in Mesa a private one is not): what counts is the distance from
/// the struct's begin.
#define WORD_OF(Struct, field) \
  ((uint)(((__global const char*)&((__global Struct*)0)->field - (__global const char*)(__global Struct*)0) / 4))
#define FIELD(records, Struct, field) wordOf(records, WORD_OF(Struct, field))
#define FIELD_BITS(records, Struct, field) AS_NATURAL(FIELD(records, Struct, field))
