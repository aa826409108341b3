// How far each pixel of a picture is from a reference, and that as colours.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "image/image_io.h"

namespace whittle::view {

/// A logarithmic scale.
struct ErrorScale {
  double low = 1e-4, high = 1;
};
/// Powers of ten between the ends of a scale.
inline constexpr int kDecades = 4;

/// The root mean square over a pixel's channels of a − b, so that the root mean square over the pixels is
/// `rmse`; or, relative, of (a − b)/√(b² + kRelativeFloor), whose mean square is `relMse` (image/metrics.h).
/// `a` and `b` of one size, with three channels at least.
std::vector<float> pixelErrors(const FloatImage& a, const FloatImage& b, bool isRelative);

/// Up to the power of ten at or above the largest finite error.
ErrorScale scaleOf(const std::vector<float>& errors);

/// Colours of the scale from its low to its high end. A straight line in OKLab (Ottosson 2020) from dark blue
/// to light yellow: equal steps look equal, it grows lighter all the way, and blue against yellow is what
/// people with a red-green deficiency tell apart.
const std::vector<std::array<std::uint8_t, 3>>& errorColors();

/// Codes, RGBA: 0 is black, what is not finite magenta, what lies outside the scale has its end's colour.
std::vector<std::uint8_t> errorCodes(const std::vector<float>& errors, const ErrorScale& scale);

}  // namespace whittle::view
