// How far a picture is from a reference: numbers for experiments and for `whittle compare`.
#pragma once

#include <cstdint>

#include "image/image_io.h"

namespace whittle {

/// Added to the reference's square in relMse, which stays finite where that is black: a tenth of white counts
/// as the eye's floor.
inline constexpr double kRelativeFloor = 0.01;

/// All over the colour channels of all pixels, in double, in a fixed order: the same
/// bits for any number of threads.
struct ImageMetrics {
  double rmse = 0;    ///< sqrt of the mean of (x − r)²; not finite where a value of either picture is not
  double relMse = 0;  ///< mean of (x − r)²/(r² + 0.01)
  double maxAbs = 0;  ///< largest |x − r|; NaN if any difference is
  double flip = 0;    ///< mean FLIP of the two pictures as they are shown, in [0, 1]
  std::uint64_t differingPixels = 0;     ///< pixels with a channel whose bits differ
  std::uint64_t nonFinite = 0;           ///< pixels of `a` with a channel that is not finite
  std::uint64_t nonFiniteReference = 0;  ///< the same for the reference
};

/// How a picture reaches the screen, where FLIP is asked.
enum class Shown : std::uint8_t {
  ToneMapped,  ///< radiance: by toneMap, at no exposure
  AsItIs       ///< colours of a screen made linear: back to their own sRGB codes, without a roll-off
};

/// An alpha channel (the fourth, or the second of two) is left out. Throws std::runtime_error if sizes or
/// numbers of colour channels differ.
ImageMetrics compareImages(const FloatImage& a, const FloatImage& reference, Shown shown = Shown::ToneMapped,
                           Shown referenceShown = Shown::ToneMapped);

}  // namespace whittle
