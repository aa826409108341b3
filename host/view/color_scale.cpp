// See color_scale.h.
#include "view/color_scale.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whittle::view {

Code rampAt(double share) {
  constexpr std::array<std::array<double, 3>, 6> kAnchors{
      {{8, 10, 40}, {60, 30, 125}, {150, 45, 120}, {220, 85, 65}, {248, 165, 50}, {252, 250, 190}}};
  constexpr double kLast = kAnchors.size() - 1;
  const double at = share > 0 ? std::min(share, 1.0) * kLast : 0.0;
  const auto below = static_cast<std::size_t>(std::min(std::floor(at), kLast - 1));
  Code code{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double a = kAnchors[below][c], b = kAnchors[below + 1][c];
    code[c] = static_cast<std::uint8_t>(std::lround(a + (b - a) * (at - static_cast<double>(below))));
  }
  return code;
}

double ColorScale::shareOf(double value) const {
  if (isLogarithmic) return value > 0 ? std::log(value / low) / std::log(high / low) : 0.0;
  return (value - low) / (high - low);
}

double ColorScale::valueAt(double share) const {
  return isLogarithmic ? low * std::pow(high / low, share) : low + share * (high - low);
}

ColorScale logarithmicScale(double low, double high, double decades, std::string quantity) {
  if (!(high > 0) || !std::isfinite(high)) return {0, 1, false, std::move(quantity)};
  low = std::max(low, high * std::pow(10.0, -decades));
  if (!(low < high)) low = high / 10;
  return {low, high, true, std::move(quantity)};
}

}  // namespace whittle::view
