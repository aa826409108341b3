// Linear radiance to 8-bit sRGB for people to look at: exposure, a highlight roll-off, the exact sRGB curve.
#pragma once

#include <cstdint>
#include <vector>

#include "image/image_io.h"
#include "image/srgb.h"

namespace whittle {

/// Largest channel value that the tone map leaves as it is.
inline constexpr double kToneKnee = 0.8;

/// The roll-off: the identity up to kToneKnee, then 1 − d²/(v − kToneKnee + d) with d = 1 − kToneKnee, which
/// goes on with slope 1 and approaches 1. `v` is a linear value ≥ 0 after exposure.
double rollOff(double v);

/// Stops that make a picture fit: 0 where it does. One fits if the middle of what is not black (its geometric
/// mean luminance) lies between 1/50 and 1, and no more than a quarter of it is brighter than white.
/// Otherwise that middle becomes 18 %, but the brightest 2 % stay within a stop above white; tenths of a
/// stop. Pixels that are not finite, or a millionth of the brightest and less, do not count. The same for any
/// number of threads. `block`: of so many by so many pixels the mean counts, in the place of each by itself.
/// Noise lowers the logarithm of a pixel, so that a picture of few rays would seem darker than one of many.
float fittingExposure(const FloatImage& image, int block = 1);
/// For light of random directions (--sky-light): as many samples as a good pixel has.
inline constexpr int kNoisyBlock = 8;

/// Width·height·3 bytes. With `rollsOff` the largest of the three channels goes through rollOff and the other
/// two are scaled with it, so that hue stays where single channels would clip; what the roll-off takes away
/// is given back as a slow fade to white, at the same hue in OKLab. Two or fewer channels are grey, a fourth
/// is left out. A pixel that is not finite becomes magenta (255, 0, 255) and is counted in `nonFinite` if
/// given; negative values are 0. Rounds to the nearest code; the same bytes for any number of threads.
/// Without `rollsOff` channels above 1 are cut: codes of an 8-bit texture come out as they went in. With
/// `dithers` a value between two codes is rounded up in as many pixels as it is near the upper one, by
/// orderedThreshold of the pixel's place in the picture (in `frame` where the image is a region): off by less
/// than a code, in the mean by nothing, and a value that is a code stays that code.
std::vector<std::uint8_t> toneMap(const FloatImage& image, float exposureStops,
                                  std::uint64_t* nonFinite = nullptr, bool rollsOff = true,
                                  bool dithers = false);

/// The same with `alpha` (one channel, [0, 1]) as the fourth byte: width·height·4. Files of codes hold
/// colours that are not multiplied by alpha, so `image`, which is, is divided by it first; 0 where alpha is.
/// Alpha is not dithered.
std::vector<std::uint8_t> toneMapWithAlpha(const FloatImage& image, const FloatImage& alpha,
                                           float exposureStops, bool rollsOff = true, bool dithers = false);

}  // namespace whittle
