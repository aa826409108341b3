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

INLINE float2 samplePixelRandom(uint pixel, uint sample, uint seed) {
  return (float2)(unitFloat(hash4(pixel, sample, 0, seed)), unitFloat(hash4(pixel, sample, 1, seed)));
}

INLINE float2 samplePixelStratified(uint pixel, uint sample, uint count, uint seed) {
  uint m = (uint)sqrt((float)count);
  while (m * m > count) --m;
  while ((m + 1) * (m + 1) <= count) ++m;
  const float2 u = samplePixelRandom(pixel, sample, seed);
  if (sample >= m * m) return u;
  return ((float2)((float)(sample % m), (float)(sample / m)) + u) / (float)m;
}

INLINE float2 samplePixelSobol(uint pixel, uint sample, uint seed) {
  const uint i = owenScramble(sample, hash4(pixel, 0, 2, seed));  // aligned blocks stay aligned blocks
  const uint a = owenScramble(reverseBits(i), hash4(pixel, 0, 3, seed));
  const uint b = owenScramble(sobolSecond(i), hash4(pixel, 0, 4, seed));
  return (float2)(unitFloat(a), unitFloat(b));
}

/// Position of a sample in its pixel, [0,1)².
INLINE float2 samplePixel(const DeviceCamera* camera, uint pixel, uint sample) {
  if (camera->raysPerPixel == 1) return (float2)(0.5f, 0.5f);
#if HAS(SAMPLER_STRATIFIED)
  if (camera->sampler == 1) return samplePixelStratified(pixel, sample, camera->raysPerPixel, camera->seed);
#endif
#if HAS(SAMPLER_SOBOL)
  if (camera->sampler == 2) return samplePixelSobol(pixel, sample, camera->seed);
#endif
  return samplePixelRandom(pixel, sample, camera->seed);
}
