// RMSE, relative MSE, largest difference and FLIP of two pictures. Rows are summed in parallel, each from
// left to right, and then added from top to bottom, so that the result does not depend on the threads.
#include "image/metrics.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <bit>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "image/flip.h"
#include "image/tone_map.h"

namespace whittle {
namespace {

struct RowSums {
  double squared = 0, relative = 0, maxAbs = 0;
  std::uint64_t differing = 0, nonFinite = 0, nonFiniteReference = 0;
};

/// The larger one; NaN wins over everything, which std::max would leave to the order of its arguments.
double largerOrNan(double a, double b) { return std::isnan(a) || a > b ? a : b; }

int colorChannels(const FloatImage& image) { return image.channels >= 3 ? 3 : 1; }

RowSums compareRow(const FloatImage& a, const FloatImage& reference, int y) {
  RowSums sums;
  const int channels = colorChannels(a);
  for (int x = 0; x < a.width; ++x) {
    const std::size_t pixel = static_cast<std::size_t>(y) * a.width + x;
    bool differs = false, finite = true, finiteReference = true;
    for (int c = 0; c < channels; ++c) {
      const float v = a.pixels[pixel * a.channels + c], r = reference.pixels[pixel * reference.channels + c];
      const double d = static_cast<double>(v) - r;
      sums.squared += d * d;
      sums.relative += d * d / (static_cast<double>(r) * r + kRelativeFloor);
      sums.maxAbs = largerOrNan(std::abs(d), sums.maxAbs);
      differs |= std::bit_cast<std::uint32_t>(v) != std::bit_cast<std::uint32_t>(r);
      finite &= std::isfinite(v);
      finiteReference &= std::isfinite(r);
    }
    sums.differing += differs ? 1 : 0;
    sums.nonFinite += finite ? 0 : 1;
    sums.nonFiniteReference += finiteReference ? 0 : 1;
  }
  return sums;
}

void checkComparable(const FloatImage& a, const FloatImage& b) {
  if (a.width != b.width || a.height != b.height) {
    throw std::runtime_error(
        fmt::format("the pictures differ in size: {}x{} and {}x{}", a.width, a.height, b.width, b.height));
  }
  if (colorChannels(a) != colorChannels(b)) {
    throw std::runtime_error(
        fmt::format("the pictures differ in channels: {} and {}", a.channels, b.channels));
  }
}

std::vector<std::uint8_t> codesOf(const FloatImage& image, Shown shown) {
  return toneMap(image, 0.0F, nullptr, shown == Shown::ToneMapped);
}

}  // namespace

ImageMetrics compareImages(const FloatImage& a, const FloatImage& reference, Shown shown,
                           Shown referenceShown) {
  checkComparable(a, reference);
  std::vector<RowSums> rows(a.height);
  tbb::parallel_for(0, a.height, [&](int y) { rows[y] = compareRow(a, reference, y); });
  ImageMetrics m;
  for (const RowSums& row : rows) {
    m.rmse += row.squared;
    m.relMse += row.relative;
    m.maxAbs = largerOrNan(row.maxAbs, m.maxAbs);
    m.differingPixels += row.differing;
    m.nonFinite += row.nonFinite;
    m.nonFiniteReference += row.nonFiniteReference;
  }
  const double count = static_cast<double>(a.width) * a.height * colorChannels(a);
  if (count == 0) return m;
  m.rmse = std::sqrt(m.rmse / count);
  m.relMse /= count;
  m.flip = flipMean(codesOf(a, shown), codesOf(reference, referenceShown), a.width, a.height);
  return m;
}

}  // namespace whittle
