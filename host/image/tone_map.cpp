// Tone map: compression of the largest channel with a fade to white after the Khronos PBR Neutral tone mapper
// (Lalish 2024), without its toe; the fade goes through OKLab (Ottosson 2020), where hue is an angle: in
// linear light blue would turn violet on its way. Encoding: IEC 61966-2-1 through a table of the 255 borders
// between codes, so that no rounding is left to pow(), but where it dithers.
#include "image/tone_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "image/blue_noise.h"

namespace whittle {
namespace {

/// Share of the removed excess that fades towards white; Khronos' value.
constexpr double kFade = 0.15;

/// `color` (largest channel 1) with the share `keep` of its OKLab chroma and of its distance to white's
/// lightness: its hue stays. The largest channel is 1 again; what sRGB has no place for is cut.
glm::dvec3 faded(const glm::dvec3& color, double keep) {
  // Rows: of linear sRGB the responses of cones, and of their cube roots lightness, a and b.
  static const glm::dmat3 toCones(0.4122214708, 0.5363325363, 0.0514459929, 0.2119034982, 0.6806995451,
                                  0.1073969566, 0.0883024619, 0.2817188376, 0.6299787005);
  static const glm::dmat3 toLab(0.2104542553, 0.7936177850, -0.0040720468, 1.9779984951, -2.4285922050,
                                0.4505937099, 0.0259040371, 0.7827717662, -0.8086757660);
  static const glm::dmat3 ofLab = glm::inverse(toLab), ofCones = glm::inverse(toCones);
  const glm::dvec3 cones = color * toCones;
  const glm::dvec3 lab = glm::dvec3(std::cbrt(cones.x), std::cbrt(cones.y), std::cbrt(cones.z)) * toLab;
  const glm::dvec3 roots = glm::dvec3(1.0 + (lab.x - 1.0) * keep, lab.y * keep, lab.z * keep) * ofLab;
  const glm::dvec3 light = glm::max(roots * roots * roots * ofCones, glm::dvec3(0.0));
  return light / std::max({light.x, light.y, light.z});
}

/// The code below a value or the one above, by a threshold in (0, 1).
std::uint8_t ditheredByte(double v, double threshold) {
  return static_cast<std::uint8_t>(std::min(255.0, std::floor(255.0 * srgbEncode(v) + threshold)));
}

/// How a picture's values become codes.
struct Encoding {
  double scale = 1.0;
  bool rollsOff = true, dithers = false;
  int channels = 3;
  Frame frame{};

  std::uint8_t operator()(double v, double threshold) const {
    static const SrgbCodes kCodes(SrgbCodes::Halves::Up);
    return dithers ? ditheredByte(v, threshold) : kCodes.codeOf(v);
  }
};

/// Writes the pixel at (x, y) of the picture; `alpha`: what it was multiplied by. False if it was not finite.
bool mapPixel(const Encoding& encode, const float* in, int x, int y, std::uint8_t* out, double alpha = 1.0) {
  const std::size_t step = encode.channels >= 3 ? 1 : 0;
  const double scale = encode.scale / alpha;
  const double threshold = encode.dithers ? orderedThreshold(encode.frame.x + x, encode.frame.y + y) : 0.0;
  glm::dvec3 c(0.0);
  double peak = 0;
  for (int k = 0; k < 3; ++k) {
    const float v = in[k * step];
    if (!std::isfinite(v)) {
      out[0] = out[2] = 255;
      out[1] = 0;
      return false;
    }
    c[k] = std::max(0.0, v * scale);
    peak = std::max(peak, c[k]);
  }
  if (!encode.rollsOff) {
    c = glm::min(c, glm::dvec3(1.0));
  } else if (peak > kToneKnee) {
    const double mapped = rollOff(peak);
    const bool isGrey = c.x == c.y && c.y == c.z;
    c = isGrey ? glm::dvec3(mapped) : mapped * faded(c / peak, 1 / (kFade * (peak - mapped) + 1));
  }
  for (int k = 0; k < 3; ++k) out[k] = encode(c[k], threshold);
  return true;
}

Encoding encodingOf(const FloatImage& image, float exposureStops, bool rollsOff, bool dithers) {
  Encoding encode;
  encode.scale = std::exp2(static_cast<double>(exposureStops));
  encode.rollsOff = rollsOff;
  encode.dithers = dithers;
  encode.channels = image.channels;
  encode.frame = image.frame;
  return encode;
}

}  // namespace

double rollOff(double v) {
  constexpr double kRoom = 1 - kToneKnee;
  return v <= kToneKnee ? v : 1 - kRoom * kRoom / (v - kToneKnee + kRoom);
}

namespace {

double luminanceOf(const FloatImage& image, int x, int y) {
  const auto channels = static_cast<std::size_t>(image.channels);
  const float* p = &image.pixels[(static_cast<std::size_t>(y) * image.width + x) * channels];
  return channels >= 3 ? 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2] : static_cast<double>(p[0]);
}

/// Of the pixels; with a block above 1 of the means of what is finite in squares.
std::vector<double> luminances(const FloatImage& image, int block) {
  std::vector<double> all;
  for (int y0 = 0; y0 < image.height; y0 += block)
    for (int x0 = 0; x0 < image.width; x0 += block) {
      double sum = 0, count = 0;
      for (int y = y0; y < std::min(y0 + block, image.height); ++y)
        for (int x = x0; x < std::min(x0 + block, image.width); ++x)
          if (const double v = luminanceOf(image, x, y); std::isfinite(v) || block == 1) sum += v, ++count;
      all.push_back(count > 0 ? sum / count : 0);
    }
  return all;
}

}  // namespace

float fittingExposure(const FloatImage& image, int block) {
  std::vector<double> luminance = luminances(image, block);
  std::erase_if(luminance, [](double v) { return !(std::isfinite(v) && v > 0); });
  if (luminance.empty()) return 0;
  constexpr double kDark = 1e-6;
  const double dark = kDark * *std::max_element(luminance.begin(), luminance.end());
  const auto first =
      std::partition(luminance.begin(), luminance.end(), [dark](double v) { return v < dark; });
  const auto count = static_cast<double>(luminance.end() - first);
  double logs = 0, burnt = 0;
  for (auto v = first; v != luminance.end(); ++v) logs += std::log2(*v), burnt += *v > 1 ? 1 : 0;
  const double middle = logs / count;                                          // stops
  constexpr double kLeast = -5.643856189774724, kWanted = -2.473931188332412;  // log2 of 1/50 and of 0.18
  if (middle >= kLeast && middle <= 0 && burnt <= 0.25 * count) return 0;
  const auto brightest = first + static_cast<std::ptrdiff_t>(0.98 * (count - 1));
  std::nth_element(first, brightest, luminance.end());
  const double bright = std::log2(*brightest);
  const double stops = std::min(kWanted - middle, 1 - bright);
  return static_cast<float>(std::clamp(std::round(10 * stops) / 10, -60.0, 60.0));
}

std::vector<std::uint8_t> toneMap(const FloatImage& image, float exposureStops, std::uint64_t* nonFinite,
                                  bool rollsOff, bool dithers) {
  const Encoding encode = encodingOf(image, exposureStops, rollsOff, dithers);
  const std::size_t width = image.width;
  std::vector<std::uint8_t> bytes(width * image.height * 3);
  std::vector<std::uint64_t> badInRow(image.height);
  tbb::parallel_for(0, image.height, [&](int y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t pixel = y * width + x;
      const float* in = &image.pixels[pixel * image.channels];
      if (!mapPixel(encode, in, static_cast<int>(x), y, &bytes[pixel * 3])) ++badInRow[y];
    }
  });
  if (nonFinite != nullptr) {
    *nonFinite = 0;
    for (const std::uint64_t bad : badInRow) *nonFinite += bad;
  }
  return bytes;
}

std::vector<std::uint8_t> toneMapWithAlpha(const FloatImage& image, const FloatImage& alpha,
                                           float exposureStops, bool rollsOff, bool dithers) {
  const Encoding encode = encodingOf(image, exposureStops, rollsOff, dithers);
  const std::size_t width = image.width;
  std::vector<std::uint8_t> bytes(width * image.height * 4);
  tbb::parallel_for(0, image.height, [&](int y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t pixel = y * width + x;
      const double a = std::clamp(static_cast<double>(alpha.pixels[pixel]), 0.0, 1.0);
      std::uint8_t* const out = &bytes[pixel * 4];
      out[3] = static_cast<std::uint8_t>(std::lround(255 * a));
      if (out[3] > 0) mapPixel(encode, &image.pixels[pixel * image.channels], static_cast<int>(x), y, out, a);
    }
  });
  return bytes;
}

}  // namespace whittle
