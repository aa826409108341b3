// Sample positions in the pixel and the random numbers of a path: hashes of (pixel, sample, dimension, seed), never of
// a thread or a time. Sobol with Owen scrambling after Burley 2020, hash after Laine & Karras 2011.
#include "lib/math.cl"

INLINE uint mixBits(uint v) {
  v ^= v >> 16;
  v *= 0x7feb352du;
  v ^= v >> 15;
  v *= 0x846ca68bu;
  v ^= v >> 16;
  return v;
}

INLINE uint hash4(uint pixel, uint sample, uint dimension, uint seed) {
  return mixBits(pixel + mixBits(sample + mixBits(dimension + mixBits(seed + 0x9e3779b9u))));
}

/// [0, 1) in steps of 2^-24.
INLINE float unitFloat(uint h) { return (float)(h >> 8) * 5.9604644775390625e-8f; }

INLINE uint reverseBits(uint v) {
  v = ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
  v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
  v = ((v >> 4) & 0x0f0f0f0fu) | ((v & 0x0f0f0f0fu) << 4);
  v = ((v >> 8) & 0x00ff00ffu) | ((v & 0x00ff00ffu) << 8);
  return (v >> 16) | (v << 16);
}

INLINE uint laineKarras(uint x, uint seed) {
  x += seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return x;
}

INLINE uint owenScramble(uint x, uint seed) { return reverseBits(laineKarras(reverseBits(x), seed)); }

INLINE uint sobolSecond(uint i) {
  uint result = 0;
  for (uint v = 0x80000000u; i != 0; i >>= 1, v ^= v >> 1)
    if (i & 1u) result ^= v;
  return result;
}

// Points of the unit square; a square has the dimensions from `dimension` on.

INLINE float2 squareRandom(uint pixel, uint sample, uint dimension, uint seed) {
  return (float2)(unitFloat(hash4(pixel, sample, dimension, seed)),
                  unitFloat(hash4(pixel, sample, dimension + 1, seed)));
}

/// The side of the largest square of strata that `count` samples fill.
INLINE uint strataAcross(uint count) {
  uint m = (uint)sqrt((float)count);
  while (m * m > count) --m;
  while ((m + 1) * (m + 1) <= count) ++m;
  return m;
}

/// A point of stratum `at` of m by m, the one at u of it; beyond the last stratum u itself.
INLINE float2 inStratum(uint at, uint m, float2 u) {
  if (at >= m * m) return u;
  return ((float2)((float)(at % m), (float)(at / m)) + u) / (float)m;
}

INLINE float2 squareSobol(uint pixel, uint sample, uint dimension, uint seed) {
  const uint i = owenScramble(sample, hash4(pixel, 0, dimension + 2, seed));  // aligned blocks stay aligned blocks
  const uint a = owenScramble(reverseBits(i), hash4(pixel, 0, dimension + 3, seed));
  const uint b = owenScramble(sobolSecond(i), hash4(pixel, 0, dimension + 4, seed));
  return (float2)(unitFloat(a), unitFloat(b));
}

/// i < n in an order of its own for each seed: steps that keep each number of as many bits as n - 1 apart, again while
/// the result is not below n.
INLINE uint permuted(uint i, uint n, uint seed) {
  uint bits = n - 1;
  bits |= bits >> 1;
  bits |= bits >> 2;
  bits |= bits >> 4;
  bits |= bits >> 8;
  bits |= bits >> 16;
  const uint shift = (popcount(bits) + 1) / 2;
  do {
    i = (i + seed) & bits;
    i ^= i >> shift;
    i = (i * 0x9e3779b1u) & bits;
    i ^= i >> shift;
    i = (i * 0x85ebca6bu + (seed >> 16)) & bits;
    i ^= i >> shift;
  } while (i >= n);
  return i;
}

/// Point of a sample in a square of its own, [0,1)²; of stratified samples in an order of its own, so that where a
/// sample lies in the pixel does not say where it lies here.
INLINE float2 sampleSquare(uint sampler, uint pixel, uint sample, uint count, uint dimension, uint seed) {
#if HAS(SAMPLER_STRATIFIED)
  if (sampler == 1 && count > 1) {
    const uint m = strataAcross(count);
    const uint at = sample < m * m ? permuted(sample, m * m, hash4(pixel, 0, dimension + 2, seed)) : sample;
    return inStratum(at, m, squareRandom(pixel, sample, dimension, seed));
  }
#endif
#if HAS(SAMPLER_SOBOL)
  if (sampler == 2 && count > 1) return squareSobol(pixel, sample, dimension, seed);
#endif
  return squareRandom(pixel, sample, dimension, seed);
}

/// Position of a sample in its pixel, [0,1)².
INLINE float2 samplePixel(const DeviceCamera* camera, uint pixel, uint sample) {
  if (camera->raysPerPixel == 1) return (float2)(0.5f, 0.5f);
#if HAS(SAMPLER_STRATIFIED)
  if (camera->sampler == 1)
    return inStratum(sample, strataAcross(camera->raysPerPixel), squareRandom(pixel, sample, 0, camera->seed));
#endif
#if HAS(SAMPLER_SOBOL)
  if (camera->sampler == 2) return squareSobol(pixel, sample, 0, camera->seed);
#endif
  return squareRandom(pixel, sample, 0, camera->seed);
}
