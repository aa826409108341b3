// See texture_levels.h.
#include "wavefront/texture_levels.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "image/srgb.h"

namespace whittle {
namespace {

int halved(int size) { return std::max(1, size / 2); }

/// The light of sRGB codes, and the codes of light.
struct Srgb {
  std::array<double, 256> light{};
  SrgbCodes codes{SrgbCodes::Halves::ToEven};

  Srgb() {
    for (std::size_t c = 0; c < light.size(); ++c) light[c] = srgbDecode(static_cast<double>(c) / 255.0);
  }
};

/// The texels of a row or column that make one of the next level, and their weights, whole numbers: of an odd
/// size three, in turns more of the first and more of the last.
struct Taps {
  int first = 0, count = 1;
  std::array<double, 3> weights{1, 0, 0};
};

Taps tapsOf(int at, int size) {
  if (size == 1) return {};
  const int half = size / 2;
  if (size % 2 == 0) return {2 * at, 2, {1, 1, 0}};
  return {
      2 * at, 3, {static_cast<double>(half - at), static_cast<double>(half), static_cast<double>(at + 1)}};
}

template <typename Code>
struct Level {
  int width, height;
  std::span<const Code> texels;
};

/// The mean of the texels under both taps, as codes that are not rounded yet.
template <typename Code>
std::array<double, 4> meanOf(const Level<Code>& from, const Taps& x, const Taps& y, Averaging averaging,
                             const Srgb& srgb) {
  std::array<double, 4> sum{}, weighted{};
  double all = 0.0;
  for (int j = 0; j < y.count; ++j)
    for (int i = 0; i < x.count; ++i) {
      const double weight = x.weights[i] * y.weights[j];
      const Code* rgba = &from.texels[4 * (static_cast<std::size_t>(y.first + j) * from.width + x.first + i)];
      all += weight;
      sum[3] += weight * rgba[3];
      for (std::size_t c = 0; c < 3; ++c) {
        const double value = averaging == Averaging::Linear ? rgba[c] : srgb.light[rgba[c] & 255U];
        sum[c] += weight * value;
        weighted[c] += weight * rgba[3] * value;
      }
    }
  const bool byAlpha = averaging == Averaging::ColorsByAlpha && sum[3] > 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double mean = byAlpha ? weighted[c] / sum[3] : sum[c] / all;
    sum[c] = averaging == Averaging::Linear ? mean : srgb.codes.codeOf(mean);
  }
  sum[3] /= all;
  return sum;
}

/// The same of four texels of one weight, side by side in two rows, as nearly all means are: the same sums in
/// the same order.
template <typename Code>
std::array<double, 4> meanOfFour(const Code* upper, const Code* lower, Averaging averaging,
                                 const Srgb& srgb) {
  const std::array<const Code*, 4> texels{upper, upper + 4, lower, lower + 4};
  std::array<double, 4> sum{};
  for (const Code* rgba : texels) sum[3] += rgba[3];
  const bool byAlpha = averaging == Averaging::ColorsByAlpha && sum[3] > 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (averaging == Averaging::Linear) {
      for (const Code* rgba : texels) sum[c] += rgba[c];
      sum[c] /= 4.0;
      continue;
    }
    for (const Code* rgba : texels) sum[c] += (byAlpha ? rgba[3] : 1.0) * srgb.light[rgba[c] & 255U];
    sum[c] = srgb.codes.codeOf(sum[c] / (byAlpha ? sum[3] : 4.0));
  }
  sum[3] /= 4.0;
  return sum;
}

/// As std::nearbyint, of codes; a call for each would take longer than all else.
double roundedToEven(double code) {
  constexpr double kWhole = 0x1p52;  // from here on doubles have no fractions
  return code + kWhole - kWhole;
}

template <typename Code>
void eachLevelOf(const Image& image, std::span<const Code> texels, Averaging averaging,
                 const std::function<void(std::span<const std::byte>)>& write) {
  static const Srgb kSrgb;
  Level<Code> from{image.width, image.height, texels};
  std::vector<Code> made, before;
  while (from.width > 1 || from.height > 1) {
    const int width = halved(from.width), height = halved(from.height);
    made.resize(std::size_t{4} * width * height);
    tbb::parallel_for(tbb::blocked_range<int>(0, height, 16), [&](const tbb::blocked_range<int>& rows) {
      const bool isEven = from.width % 2 == 0 && from.height % 2 == 0;
      for (int y = rows.begin(); y < rows.end(); ++y)
        for (int x = 0; x < width; ++x) {
          const Code* const upper =
              &from.texels[std::size_t{8} * (static_cast<std::size_t>(y) * from.width + x)];
          const std::array<double, 4> mean =
              isEven ? meanOfFour(upper, upper + std::size_t{4} * from.width, averaging, kSrgb)
                     : meanOf(from, tapsOf(x, from.width), tapsOf(y, from.height), averaging, kSrgb);
          Code* const out = &made[4 * (static_cast<std::size_t>(y) * width + x)];
          // Halves to even: to one side they would add up from level to level.
          for (std::size_t c = 0; c < 4; ++c) out[c] = static_cast<Code>(roundedToEven(mean[c]));
        }
    });
    write(std::as_bytes(std::span(made)));
    std::swap(made, before);
    from = {width, height, before};
  }
}

}  // namespace

int levelCount(int width, int height) {
  int count = 1;
  for (int size = std::max(width, height); size > 1; size /= 2) ++count;
  return count;
}

std::size_t texelsOfLevels(int width, int height) {
  std::size_t texels = 0;
  for (int level = levelCount(width, height); level > 0; --level) {
    texels += static_cast<std::size_t>(width) * height;
    width = halved(width), height = halved(height);
  }
  return texels;
}

void eachSmallerLevel(const Image& image, Averaging averaging, bool isDeep,
                      const std::function<void(std::span<const std::byte>)>& write) {
  if (averaging == Averaging::None) return;
  if (isDeep)
    eachLevelOf<std::uint16_t>(image, image.deepTexels, averaging, write);
  else
    eachLevelOf<std::uint8_t>(image, image.texels, averaging, write);
}

}  // namespace whittle
