// One impulse where no more are followed: that which is there, or one of those that are, chosen at random. Formulas:
// host/reference/README.md.
#include "lib/sample_names.cl"
#include "lib/surface/bsdf.cl"

#if HAS(IMPULSES) && !HAS(BOTH_BRANCHES)
/// Where no surface sends out two impulses: the one there is.
INLINE Impulse existing(const Impulse* first, const Impulse* second) {
  const Mask isSecond = anyPositive(second->magnitude);
  Impulse only = *second;
  only.w_i = choose3(isSecond, second->w_i, first->w_i);
  only.magnitude = choose3(isSecond, second->magnitude, first->magnitude);
  only.straight = isSecond ? second->straight : first->straight;
  return only;
}
#endif

#if HAS(ONE_IMPULSE)
INLINE Real randomNumber(const SampleNames* names, uint dimension, uint seed) {
  float own[LANES];
  for (uint k = 0; k < LANES; ++k) own[k] = unitFloat(hash4(names->place[k], names->sample[k], dimension, seed));
  return LOAD(own);
}

#if HAS(DISPERSION)
/// Of what splits nothing goes on in colours that the ray has none of.
INLINE void keepCarried(Impulse* impulse, Real3 throughput) {
  const Real3 kept = real3(throughput.x > 0.0f ? impulse->magnitude.x : (Real)(0.0f),
                           throughput.y > 0.0f ? impulse->magnitude.y : (Real)(0.0f),
                           throughput.z > 0.0f ? impulse->magnitude.z : (Real)(0.0f));
  impulse->magnitude = choose3(impulse->splits, kept, impulse->magnitude);
}

/// One colour of what splits, likewise; u is below 0 where the other impulse is chosen, and says nothing then.
INLINE void chooseColor(const Surfel* s, Impulse* impulse, Real u) {
  const Mask splits = impulse->splits;
  const Real3 m = impulse->magnitude;
  const Real sum = luminance(m), red = 0.2126f * m.x / sum, green = 0.7152f * m.y / sum, blue = 0.0722f * m.z / sum;
  const Mask isRed = (red > 0.0f) & ((u < red) | !((green > 0.0f) | (blue > 0.0f)));
  const Mask isGreen = !isRed & (green > 0.0f) & ((u < red + green) | !(blue > 0.0f)), isBlue = !isRed & !isGreen;
  const Real3 zero = same3((float3)(0.0f));
  const Real3 one = choose3(isRed, real3(m.x / red, zero.y, zero.z),
                            choose3(isGreen, real3(zero.x, m.y / green, zero.z), real3(zero.x, zero.y, m.z / blue)));
  impulse->magnitude = choose3(splits & (sum > 0.0f), one, m);
  impulse->w_i = choose3(splits & isGreen, impulse->ways[0], choose3(splits & isBlue, impulse->ways[1], impulse->w_i));
  const Real greenEta = interfaceEta(s, s->ior), blueEta = interfaceEta(s, channelIndex(s->ior, s->halfSpread, 2));
  impulse->eta = splits & isGreen ? greenEta : (splits & isBlue ? blueEta : impulse->eta);
}
#endif

/// Keeps one of two impulses with probability proportional to its luminance, divided by that probability.
INLINE void chooseOne(Impulse* first, Impulse* second, Real u) {
  const Real3 zero = same3((float3)(0.0f));
  const Real a = luminance(first->magnitude), b = luminance(second->magnitude);
  const Real sum = a + b;
  const Mask any = sum > 0.0f;
  const Real p = a / sum;
  const Mask one = u < p;
  first->magnitude = choose3(any, choose3(one, over3(first->magnitude, p), zero), first->magnitude);
  second->magnitude = choose3(any, choose3(one, zero, over3(second->magnitude, 1.0f - p)), second->magnitude);
}
#endif
