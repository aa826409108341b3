// Values as colours that anyone can read: brighter is more, whatever one's colour vision.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

namespace whittle::view {

using Code = std::array<std::uint8_t, 3>;  ///< sRGB

/// share in [0, 1] (what lies outside is clamped, NaN is 0) on a straight line in OKLab (Ottosson 2020) from
/// dark blue to light yellow: equal steps look equal, it grows lighter all the way, and blue against yellow
/// is what people with a red-green deficiency tell apart.
Code rampAt(double share);

/// What a picture's colours mean.
struct ColorScale {
  double low = 0, high = 1;  ///< values at the ramp's ends
  bool isLogarithmic = false;
  std::string quantity;  ///< with its unit: "standard error, W/(m² sr)"

  /// In [0, 1] within the ends.
  double shareOf(double value) const {
    if (isLogarithmic) return value > 0 ? std::log(value / low) / std::log(high / low) : 0.0;
    return (value - low) / (high - low);
  }
  double valueAt(double share) const {
    return isLogarithmic ? low * std::pow(high / low, share) : low + share * (high - low);
  }
  Code at(double value) const { return rampAt(shareOf(value)); }
};

/// Logarithmic from `high` down to at most `decades` decades below it; linear from 0 where nothing is
/// positive.
ColorScale logarithmicScale(double low, double high, double decades, std::string quantity);

}  // namespace whittle::view
