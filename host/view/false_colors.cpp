// See false_colors.h.
#include "view/false_colors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "image/tone_map.h"

namespace whittle::view {
namespace {

std::uint8_t byteOf(double share) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
}

Code grey(double share) {
  const std::uint8_t b = byteOf(share);
  return {b, b, b};
}

/// Hues a golden angle apart: neighbours in the file's order differ.
Code colorOfNumber(double number) {
  const double hue = std::fmod(number * 0.61803398875, 1.0) * 6.0;
  const auto channel = [&](double at) {
    const double away = std::abs(std::fmod(hue - at + 9.0, 6.0) - 3.0);  // from the channel's own hue
    return byteOf(0.25 + 0.7 * std::clamp(2.0 - away, 0.0, 1.0));
  };
  return {channel(0), channel(2), channel(4)};
}

/// Each pixel's code from its channels.
template <typename Color>
std::vector<std::uint8_t> codesOf(const FloatImage& image, const Color& color) {
  const std::size_t pixels = static_cast<std::size_t>(image.width) * image.height;
  std::vector<std::uint8_t> codes(4 * pixels, 255);
  for (std::size_t i = 0; i < pixels; ++i) {
    const Code code = color(&image.pixels[i * static_cast<std::size_t>(image.channels)]);
    std::copy(code.begin(), code.end(), codes.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
  return codes;
}

std::vector<std::uint8_t> depthCodes(const FloatImage& depth) {
  constexpr Code kNothing{20, 40, 90};
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const float d : depth.pixels) {
    if (!std::isfinite(d) || !(d > 0.0F)) continue;
    nearest = std::min(nearest, static_cast<double>(d));
    farthest = std::max(farthest, static_cast<double>(d));
  }
  const double range = std::max(std::log(farthest / nearest), 1e-6);
  return codesOf(depth, [&](const float* d) {
    if (!std::isfinite(*d) || !(*d > 0.0F)) return kNothing;
    return grey(1.0 - 0.9 * std::log(static_cast<double>(*d) / nearest) / range);
  });
}

std::vector<std::uint8_t> albedoCodes(const FloatImage& albedo) {
  const std::vector<std::uint8_t> rgb = toneMap(albedo, 0.0F, nullptr, false);
  std::vector<std::uint8_t> codes(rgb.size() / 3 * 4, 255);
  for (std::size_t i = 0; i < rgb.size(); ++i) codes[i / 3 * 4 + i % 3] = rgb[i];
  return codes;
}

/// Least and greatest finite value above 0; 0, 0: there is none.
std::pair<double, double> rangeOf(const std::vector<double>& values) {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const double v : values)
    if (v > 0 && std::isfinite(v)) least = std::min(least, v), greatest = std::max(greatest, v);
  return greatest > 0 ? std::pair(least, greatest) : std::pair(0.0, 0.0);
}

/// Sums of each pixel's channels.
std::vector<double> sumsOf(const FloatImage& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  std::vector<double> sums(image.pixels.size() / channels, 0.0);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    sums[i / channels] += static_cast<double>(image.pixels[i]);
  return sums;
}

FalseColors onScale(const std::vector<double>& values, const ColorScale& scale) {
  FalseColors colors{std::vector<std::uint8_t>(4 * values.size(), 255), scale};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Code code = values[i] > 0 ? scale.at(values[i]) : Code{0, 0, 0};
    std::copy(code.begin(), code.end(), colors.codes.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
  return colors;
}

/// Decades of a logarithmic ramp: more than an eye tells apart, few enough that one outlier does not flatten
/// it.
constexpr double kRampDecades = 4;

FalseColors onLogarithmicScale(const FloatImage& image, const char* quantity) {
  const auto values = sumsOf(image);
  const auto range = rangeOf(values);
  return onScale(values, logarithmicScale(range.first, range.second, kRampDecades, quantity));
}

FalseColors bounceColors(const FloatImage& bounce) {
  const auto values = sumsOf(bounce);
  return onScale(
      values, {1, std::max(2.0, std::ceil(rangeOf(values).second)), false, "bounce that light comes from"});
}

std::vector<std::uint8_t> plainCodes(const FloatImage& image, const std::string& layer) {
  if (layer == "depth") return depthCodes(image);
  if (layer == "albedo") return albedoCodes(image);
  if (layer == "primitive")
    return codesOf(image, [](const float* p) {
      return *p < 0.0F ? Code{0, 0, 0} : colorOfNumber(static_cast<double>(*p));
    });
  if (layer == "samples") {
    const float most = std::max(1.0F, *std::max_element(image.pixels.begin(), image.pixels.end()));
    return codesOf(image, [&](const float* s) { return grey(static_cast<double>(*s / most)); });
  }
  return codesOf(image, [](const float* n) {
    const bool isNothing = n[0] == 0.0F && n[1] == 0.0F && n[2] == 0.0F;
    Code code{0, 0, 0};
    for (std::size_t c = 0; c < 3 && !isNothing; ++c) code[c] = byteOf(0.5 + 0.5 * static_cast<double>(n[c]));
    return code;
  });
}

}  // namespace

FalseColors falseColors(const RenderResult& result, const std::string& layer) {
  const FloatImage& image = result.aovs.at(layer);
  if (layer == "error") return onLogarithmicScale(image, "standard error, W/(m² sr)");
  if (layer == "cost") return onLogarithmicScale(image, "nodes and triangles of a sample");
  if (layer == "bounce") return bounceColors(image);
  return {plainCodes(image, layer), {}};
}

}  // namespace whittle::view
