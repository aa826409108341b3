// What the samples of LANES neighbouring entries are called, and where they lie in squares of random numbers.
#include "lib/lanes.cl"
#include "lib/sampler.cl"

/// What the entries' samples are called.
typedef struct {
  uint pixel[LANES];  // of the pass; of the film, where the sample is the first: all get that one in one pass
  uint place[LANES];  // in the picture: y width + x
  uint sample[LANES];
} SampleNames;

INLINE SampleNames sampleNames(const Batch* batch, uint width, __global const uint* pixelOrder,
                               __global const float* rays, uint capacity, uint entry, uint active) {
  SampleNames names;
  for (uint k = 0; k < LANES; ++k) {
    const uint own = entry + (k < active ? k : active - 1);
#if HAS(IMPULSES)
    const uint slot = as_uint(rays[(size_t)RAY_SLOT * capacity + own]);
#else
    const uint slot = own;
#endif
    names.pixel[k] = batch->firstPixel + slot / batch->samples;
    const uint packed = pixelOrder[names.pixel[k]];
    names.place[k] = (packed >> 16) * width + (packed & 0xffffu);
    names.sample[k] = batch->firstSample + slot % batch->samples;
  }
  return names;
}

/// Where the entries' samples lie in the square whose dimensions begin at `dimension`.
INLINE Square sampleSquares(const RenderConstants* constants, const SampleNames* names, uint dimension) {
  float u[LANES], v[LANES];
  for (uint k = 0; k < LANES; ++k) {
    const float2 at = sampleSquare(constants->sampler, names->place[k], names->sample[k], constants->raysPerPixel,
                                   dimension, constants->seed);
    u[k] = at.x, v[k] = at.y;
  }
  const Square square = {LOAD(u), LOAD(v)};
  return square;
}
