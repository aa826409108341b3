// See difference.h.
#include "view/difference.h"

#include <algorithm>
#include <cmath>

#include "image/metrics.h"
#include "view/color_scale.h"

namespace whittle::view {
namespace {

constexpr int kColors = 256;

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
    all.reserve(kColors);
    for (int i = 0; i < kColors; ++i) all.push_back(rampAt(i / (kColors - 1.0)));
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
