// See color_scale.h.
#include "view/color_scale.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "image/tone_map.h"

namespace whittle::view {

namespace {

/// Lightness, green to red, blue to yellow: both ends lie inside sRGB, and so does the line between them.
constexpr std::array<double, 3> kDarkBlue{0.25, 0.0, -0.13}, kLightYellow{0.96, -0.04, 0.14};

/// OKLab to linear sRGB, by the matrices of its definition.
std::array<double, 3> linearOf(const std::array<double, 3>& lab) {
  const double l = lab[0] + 0.3963377774 * lab[1] + 0.2158037573 * lab[2],
               m = lab[0] - 0.1055613458 * lab[1] - 0.0638541728 * lab[2],
               s = lab[0] - 0.0894841775 * lab[1] - 1.2914855480 * lab[2];
  const double l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
  return {4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3,
          -1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3,
          -0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * s3};
}

}  // namespace

Code rampAt(double share) {
  share = share > 0 ? std::min(share, 1.0) : 0.0;
  std::array<double, 3> lab{};
  for (std::size_t i = 0; i < 3; ++i) lab[i] = kDarkBlue[i] + share * (kLightYellow[i] - kDarkBlue[i]);
  const auto linear = linearOf(lab);
  Code code{};
  for (std::size_t i = 0; i < 3; ++i)
    code[i] = static_cast<std::uint8_t>(std::lround(255 * srgbEncode(std::clamp(linear[i], 0.0, 1.0))));
  return code;
}

ColorScale logarithmicScale(double low, double high, double decades, std::string quantity) {
  if (!(high > 0) || !std::isfinite(high)) return {0, 1, false, std::move(quantity)};
  low = std::max(low, high * std::pow(10.0, -decades));
  if (!(low < high)) low = high / 10;
  return {low, high, true, std::move(quantity)};
}

}  // namespace whittle::view
