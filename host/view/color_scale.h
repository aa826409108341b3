// Values as colours that anyone can read: brighter is more, whatever one's colour vision.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace whittle::view {

using Code = std::array<std::uint8_t, 3>;  ///< sRGB

/// share in [0, 1] (what lies outside is clamped, NaN is 0) on a ramp from dark blue over red to pale yellow,
/// whose luminance only rises.
Code rampAt(double share);

/// What a picture's colours mean.
struct ColorScale {
  double low = 0, high = 1;  ///< values at the ramp's ends
  bool isLogarithmic = false;
  std::string quantity;  ///< with its unit: "standard error, W/(m² sr)"

  double shareOf(double value) const;  ///< in [0, 1] within the ends
  double valueAt(double share) const;
  Code at(double value) const { return rampAt(shareOf(value)); }
};

/// Logarithmic from `high` down to at most `decades` decades below it; linear from 0 where nothing is
/// positive.
ColorScale logarithmicScale(double low, double high, double decades, std::string quantity);

}  // namespace whittle::view
