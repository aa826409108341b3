// Film arithmetic in double precision.
#include "wavefront/film.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "kernels/shared/layout.h"

namespace whittle {
namespace {

double plane(const FilmSums& s, int sum, int compensation, std::size_t pixel) {
  const std::size_t pixels = static_cast<std::size_t>(s.width) * s.height;
  const auto value = [&](int at) {
    return static_cast<double>(s.planes[static_cast<std::size_t>(at) * pixels + pixel]);
  };
  const bool compensated = s.planes.size() > FILM_PLANES_OF_ONE * pixels;
  return value(sum) + (compensated ? value(compensation) : 0.0);
}

FloatImage gather(int width, int height, const std::vector<float>& planes, int first, int channels) {
  FloatImage image{width, height, channels, {}};
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  image.pixels.resize(pixels * channels);
  for (std::size_t p = 0; p < pixels; ++p)
    for (int c = 0; c < channels; ++c)
      image.pixels[p * channels + c] = planes[static_cast<std::size_t>(first + c) * pixels + p];
  return image;
}

}  // namespace

std::size_t filmPlanes(int samples) { return samples > 1 ? FILM_PLANES : FILM_PLANES_OF_ONE; }

namespace {

/// Where pixel p of the pixel order lies in an image.
std::size_t placeOf(const FilmSums& sums, std::size_t p) {
  return static_cast<std::size_t>(sums.pixelOrder[p] >> 16) * sums.width + (sums.pixelOrder[p] & 0xffffU);
}

/// Of the mean of n samples of pixel p, averaged over the channels; infinite where squares of the samples
/// left the range of floats (radiance above 1e19): nothing is known then.
double varianceOfMean(const FilmSums& sums, std::size_t p, double n) {
  double squaredMean = 0.0;
  for (int c = 0; c < 3; ++c) {
    const double mean = plane(sums, FILM_SUM + c, FILM_COMPENSATION + c, p) / n;
    squaredMean += mean * mean / 3.0;
  }
  const double meanSquare = plane(sums, FILM_SQUARES, FILM_SQUARES_COMPENSATION, p) / n;
  if (!std::isfinite(meanSquare)) return std::numeric_limits<double>::infinity();
  return std::max(0.0, meanSquare - squaredMean) / (n - 1.0);
}

}  // namespace

FloatImage resolveFilm(const FilmSums& sums, const SampleCounts& counts) {
  FloatImage image{sums.width, sums.height, 3, {}};
  const std::size_t pixels = static_cast<std::size_t>(sums.width) * sums.height;
  image.pixels.resize(pixels * 3);
  for (std::size_t p = 0; p < pixels; ++p) {
    const double n = std::max(1U, counts.ofPixel(p));
    for (int c = 0; c < 3; ++c)
      image.pixels[placeOf(sums, p) * 3 + c] =
          static_cast<float>(plane(sums, FILM_SUM + c, FILM_COMPENSATION + c, p) / n);
  }
  return image;
}

std::vector<double> blockVariances(const FilmSums& sums, const SampleCounts& counts) {
  std::vector<double> variances(counts.blocks(), 0.0);
  for (std::size_t p = 0; p < counts.pixels(); ++p) {
    const std::uint32_t n = counts.ofPixel(p);
    variances[p / FILM_BLOCK] +=
        n >= 2 ? varianceOfMean(sums, p, n) : std::numeric_limits<double>::infinity();
  }
  return variances;
}

double estimateError(const std::vector<double>& blockVariances, const SampleCounts& counts) {
  const double total = std::accumulate(blockVariances.begin(), blockVariances.end(), 0.0);
  return std::sqrt(total / static_cast<double>(counts.pixels()));
}

double meanOfChannels(const FilmSums& sums, const SampleCounts& counts) {
  double total = 0.0;
  for (std::size_t p = 0; p < counts.pixels(); ++p)
    for (int c = 0; c < 3; ++c)
      total += plane(sums, FILM_SUM + c, FILM_COMPENSATION + c, p) / std::max(1U, counts.ofPixel(p));
  return total / (3.0 * static_cast<double>(counts.pixels()));
}

FloatImage sampleImage(const FilmSums& sums, const SampleCounts& counts) {
  FloatImage image{sums.width, sums.height, 1, {}};
  image.pixels.resize(counts.pixels());
  for (std::size_t p = 0; p < counts.pixels(); ++p)
    image.pixels[placeOf(sums, p)] = static_cast<float>(counts.ofPixel(p));
  return image;
}

double rootMeanSquare(const FloatImage& picture, const FloatImage& reference) {
  const std::size_t pixels = static_cast<std::size_t>(picture.width) * picture.height;
  double sum = 0.0;
  for (std::size_t p = 0; p < pixels; ++p)
    for (int c = 0; c < 3; ++c) {
      const double d = static_cast<double>(picture.pixels[p * picture.channels + c]) -
                       static_cast<double>(reference.pixels[p * reference.channels + c]);
      sum += d * d;
    }
  return std::sqrt(sum / (3.0 * static_cast<double>(pixels)));
}

std::map<std::string, FloatImage> splitAovs(int width, int height, const std::vector<float>& planes) {
  return {{"depth", gather(width, height, planes, AOV_DEPTH, 1)},
          {"primitive", gather(width, height, planes, AOV_PRIMITIVE, 1)},
          {"normal", gather(width, height, planes, AOV_NORMAL, 3)},
          {"albedo", gather(width, height, planes, AOV_ALBEDO, 3)}};
}

}  // namespace whittle
