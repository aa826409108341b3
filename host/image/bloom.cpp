// See bloom.h. Equal shares of light an octave are a point spread that falls as 1/r², as glare in the eye
// does some degrees away (Vos 1984; Spencer, Shirley, Zimmerman, Greenberg 1995). Each Gaussian is six
// extended boxes along rows and along columns, whose sums run (Gwosdek, Grewenig, Bruhn, Weickert 2011).
#include "image/bloom.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace whittle {
namespace {

/// Boxes of a Gaussian: with six its fourth moment is 7 % low, and its circles are round to a sixth two and a
/// half standard deviations away.
constexpr int kBoxes = 6;
constexpr std::size_t kChannels = 3;

/// 2·reach + 1 values in full and one more at each end by `ends`.
struct Box {
  int reach = 0;
  double ends = 0.0;
  double sum() const { return 2.0 * reach + 1.0 + 2.0 * ends; }
};

Box boxOf(double variance) {
  Box box;
  box.reach = static_cast<int>(std::floor((std::sqrt(12.0 * variance + 1.0) - 1.0) / 2.0));
  const double r = box.reach;
  box.ends = (2.0 * r + 1.0) * (r * (r + 1.0) - 3.0 * variance) / (6.0 * (variance - (r + 1.0) * (r + 1.0)));
  return box;
}

/// Of a line that goes on mirrored at both ends.
std::size_t mirrored(std::ptrdiff_t at, std::ptrdiff_t length) {
  if (at >= 0 && at < length) return static_cast<std::size_t>(at);
  const std::ptrdiff_t period = 2 * length, m = ((at % period) + period) % period;
  return static_cast<std::size_t>(m < length ? m : period - 1 - m);
}

/// One box along a line.
void blurOnce(const Box& box, const std::vector<double>& in, std::vector<double>& out) {
  const auto length = static_cast<std::ptrdiff_t>(in.size()), reach = static_cast<std::ptrdiff_t>(box.reach);
  const auto at = [&](std::ptrdiff_t i) { return in[mirrored(i, length)]; };
  double sum = 0.0;
  for (std::ptrdiff_t i = -reach; i <= reach; ++i) sum += at(i);
  const double share = 1.0 / box.sum();
  for (std::ptrdiff_t i = 0; i < length; ++i) {
    const double entering = at(i + reach + 1);
    out[static_cast<std::size_t>(i)] = share * (sum + box.ends * (at(i - reach - 1) + entering));
    sum += entering - at(i - reach);
  }
}

/// Blurs each of `lines` lines of `length` pixels, one after another in `in`; in `out` columns are lines.
void blurLines(const Box& box, const std::vector<float>& in, std::size_t lines, std::size_t length,
               std::vector<float>& out) {
  tbb::parallel_for(std::size_t{0}, lines, [&](std::size_t line) {
    std::vector<double> a(length), b(length);
    for (std::size_t c = 0; c < kChannels; ++c) {
      for (std::size_t i = 0; i < length; ++i)
        a[i] = static_cast<double>(in[(line * length + i) * kChannels + c]);
      for (int k = 0; k < kBoxes; ++k) {
        blurOnce(box, a, b);
        a.swap(b);
      }
      // Running sums leave rounding where there is no light.
      for (std::size_t i = 0; i < length; ++i)
        out[(i * lines + line) * kChannels + c] = static_cast<float>(std::max(0.0, a[i]));
    }
  });
}

bool isFinitePixel(const float* p, std::size_t channels) {
  return std::all_of(p, p + channels, [](float v) { return std::isfinite(v); });
}

/// What there is to spread: three channels, nothing negative.
std::vector<float> lightOf(const FloatImage& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::size_t pixels = image.pixels.size() / channels;
  std::vector<float> light(pixels * kChannels, 0.0F);
  for (std::size_t p = 0; p < pixels; ++p) {
    const float* const in = &image.pixels[p * channels];
    if (!isFinitePixel(in, std::min(channels, kChannels))) continue;
    for (std::size_t c = 0; c < kChannels; ++c)
      light[p * kChannels + c] = std::max(0.0F, in[channels >= kChannels ? c : 0]);
  }
  return light;
}

}  // namespace

FloatImage withBloom(const FloatImage& image, const Bloom& bloom) {
  if (!(bloom.strength > 0.0F)) return image;
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  const auto channels = static_cast<std::size_t>(image.channels), colors = std::min(channels, kChannels);
  const std::vector<float> light = lightOf(image);
  FloatImage result = image;
  const double share = static_cast<double>(bloom.strength) / kBloomOctaves;
  for (std::size_t p = 0; p < width * height; ++p)
    for (std::size_t c = 0; c < colors; ++c) result.pixels[p * channels + c] *= 1.0F - bloom.strength;
  std::vector<float> turned(light.size()), spread(light.size());
  const int whole = image.frame.height > 0 ? image.frame.height : image.height;
  double deviation = static_cast<double>(bloom.radius) * whole;
  for (int octave = 0; octave < kBloomOctaves; ++octave, deviation /= 2.0) {
    const Box box = boxOf(deviation * deviation / kBoxes);
    blurLines(box, light, height, width, turned);
    blurLines(box, turned, width, height, spread);
    tbb::parallel_for(std::size_t{0}, width * height, [&](std::size_t p) {
      for (std::size_t c = 0; c < colors; ++c) {
        float& v = result.pixels[p * channels + c];
        v = static_cast<float>(static_cast<double>(v) +
                               share * static_cast<double>(spread[p * kChannels + c]));
      }
    });
  }
  for (std::size_t p = 0; p < width * height; ++p)
    if (const float* const in = &image.pixels[p * channels]; !isFinitePixel(in, colors))
      std::copy(in, in + channels, &result.pixels[p * channels]);
  return result;
}

}  // namespace whittle
