// Choosing one of many by shares of [0, 1): each begins where the one before ends.
#include "lib/math.cl"

typedef struct {
  uint chosen;
  float begin, end;
} Share;

/// The share that u in [0, 1) lies in, of `count`: the first whose end is beyond it. Ends are `stride` floats apart.
INLINE Share shareAt(__global const float* ends, uint stride, uint count, float u) {
  uint low = 0, high = count - 1;
  while (low < high) {
    const uint middle = (low + high) / 2;
    if (u < ends[(size_t)middle * stride])
      high = middle;
    else
      low = middle + 1;
  }
  const Share share = {low, low > 0 ? ends[(size_t)(low - 1) * stride] : 0.0f, ends[(size_t)low * stride]};
  return share;
}
