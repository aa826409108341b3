// See difference.h.
#include "view/difference.h"

#include <algorithm>
#include <cmath>

#include "image/metrics.h"
#include "image/tone_map.h"

namespace whittle::view {
namespace {

using Code = std::array<std::uint8_t, 3>;

constexpr int kColors = 256;
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

Code colorAt(double share) {
  std::array<double, 3> lab{};
  for (std::size_t i = 0; i < 3; ++i) lab[i] = kDarkBlue[i] + share * (kLightYellow[i] - kDarkBlue[i]);
  const auto linear = linearOf(lab);
  Code code{};
  for (std::size_t i = 0; i < 3; ++i)
    code[i] = static_cast<std::uint8_t>(std::lround(255 * srgbEncode(std::clamp(linear[i], 0.0, 1.0))));
  return code;
}

}  // namespace

std::vector<float> pixelErrors(const FloatImage& a, const FloatImage& b, bool isRelative) {
  const std::size_t pixels = static_cast<std::size_t>(a.width) * a.height;
  std::vector<float> errors(pixels);
  for (std::size_t p = 0; p < pixels; ++p) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double r = b.pixels[p * static_cast<std::size_t>(b.channels) + c],
                   d = a.pixels[p * static_cast<std::size_t>(a.channels) + c] - r;
      sum += isRelative ? d * d / (r * r + kRelativeFloor) : d * d;
    }
    errors[p] = static_cast<float>(std::sqrt(sum / 3));
  }
  return errors;
}

ErrorScale scaleOf(const std::vector<float>& errors) {
  double most = 0;
  for (const float e : errors)
    if (std::isfinite(e)) most = std::max(most, static_cast<double>(e));
  if (!(most > 0)) return {};
  const double high = std::pow(10.0, std::ceil(std::log10(most)));
  return {high / std::pow(10.0, kDecades), high};
}

const std::vector<Code>& errorColors() {
  static const std::vector<Code> colors = [] {
    std::vector<Code> all;
    for (int i = 0; i < kColors; ++i) all.push_back(colorAt(i / (kColors - 1.0)));
    return all;
  }();
  return colors;
}

std::vector<std::uint8_t> errorCodes(const std::vector<float>& errors, const ErrorScale& scale) {
  constexpr Code kNone{0, 0, 0}, kNotFinite{255, 0, 255};
  const auto& colors = errorColors();
  const auto codeOf = [&](float e) {
    if (!std::isfinite(e)) return kNotFinite;
    if (!(e > 0.0F)) return kNone;
    const double share = std::log10(static_cast<double>(e) / scale.low) / kDecades;
    return colors[static_cast<std::size_t>(std::lround(std::clamp(share, 0.0, 1.0) * (kColors - 1)))];
  };
  std::vector<std::uint8_t> codes(4 * errors.size(), 255);
  for (std::size_t p = 0; p < errors.size(); ++p) {
    const Code code = codeOf(errors[p]);
    std::copy(code.begin(), code.end(), codes.begin() + static_cast<std::ptrdiff_t>(4 * p));
  }
  return codes;
}

}  // namespace whittle::view
