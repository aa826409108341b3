// Film arithmetic in double precision.
#include "wavefront/film.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "kernels/shared/layout.h"

namespace whittle {
namespace {

/// `pixel` counts from the beginning of the part.
double plane(const FilmPart& s, int sum, int compensation, std::size_t pixel) {
  const std::size_t pixels = s.pixelOrder.size();
  const auto value = [&](int at) {
    return static_cast<double>(s.planes[static_cast<std::size_t>(at) * pixels + pixel]);
  };
  const bool compensated = s.planes.size() >= FILM_PLANES * pixels;
  return value(sum) + (compensated ? value(compensation) : 0.0);
}

FloatImage gather(FloatImage image, const std::vector<std::uint32_t>& pixelOrder,
                  const std::vector<float>& planes, int first) {
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t p = 0; p < pixelOrder.size(); ++p)
    for (std::size_t c = 0; c < channels; ++c)
      image.pixels[placeOf(pixelOrder[p], image) * channels + c] =
          planes[(static_cast<std::size_t>(first) + c) * pixelOrder.size() + p];
  return image;
}

}  // namespace

std::size_t placeOf(std::uint32_t pixel, const FloatImage& image) {
  const int x = static_cast<int>(pixel & 0xffffU) - image.frame.x,
            y = static_cast<int>(pixel >> 16) - image.frame.y;
  return static_cast<std::size_t>(y) * image.width + x;
}

std::size_t filmPlanes(const Settings& settings, bool coverage) {
  // What is resumed may get more samples.
  if (settings.raysPerPixel > 1 || settings.resumable) return coverage ? FILM_PLANES_COVERAGE : FILM_PLANES;
  return coverage ? FILM_PLANES_OF_ONE_COVERAGE : FILM_PLANES_OF_ONE;
}

namespace {

/// Of the mean of n samples of pixel p, averaged over the channels; infinite where squares of the samples
/// left the range of floats (radiance above 1e19): nothing is known then.
double varianceOfMean(const FilmPart& sums, std::size_t p, double n) {
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

void resolveFilm(const FilmPart& part, const SampleCounts& counts, FloatImage& image) {
  for (std::size_t p = 0; p < part.pixelOrder.size(); ++p) {
    const double n = std::max(1U, counts.ofPixel(part.first + p));
    for (int c = 0; c < 3; ++c)
      image.pixels[placeOf(part.pixelOrder[p], image) * 3 + c] =
          static_cast<float>(plane(part, FILM_SUM + c, FILM_COMPENSATION + c, p) / n);
  }
}

void addBlockVariances(const FilmPart& part, const SampleCounts& counts, std::vector<double>& variances) {
  for (std::size_t p = 0; p < part.pixelOrder.size(); ++p) {
    const std::uint32_t n = counts.ofPixel(part.first + p);
    variances[(part.first + p) / FILM_BLOCK] +=
        n >= 2 ? varianceOfMean(part, p, n) : std::numeric_limits<double>::infinity();
  }
}

double estimateError(const std::vector<double>& blockVariances, const SampleCounts& counts) {
  const double total = std::accumulate(blockVariances.begin(), blockVariances.end(), 0.0);
  return std::sqrt(total / static_cast<double>(counts.pixels()));
}

void addRadiance(const FilmPart& part, const SampleCounts& counts, double& total) {
  for (std::size_t p = 0; p < part.pixelOrder.size(); ++p)
    for (int c = 0; c < 3; ++c)
      total +=
          plane(part, FILM_SUM + c, FILM_COMPENSATION + c, p) / std::max(1U, counts.ofPixel(part.first + p));
}

void resolveAlpha(const FilmPart& part, const SampleCounts& counts, FloatImage& image) {
  const bool ofOne = part.planes.size() < FILM_PLANES * part.pixelOrder.size();
  const int sum = ofOne ? FILM_TRANSMITTANCE_OF_ONE : FILM_TRANSMITTANCE;
  for (std::size_t p = 0; p < part.pixelOrder.size(); ++p) {
    const double n = std::max(1U, counts.ofPixel(part.first + p));
    const double clear = plane(part, sum, FILM_TRANSMITTANCE_COMPENSATION, p) / n;
    image.pixels[placeOf(part.pixelOrder[p], image)] = static_cast<float>(std::clamp(1.0 - clear, 0.0, 1.0));
  }
}

void showErrors(const FilmPart& part, const SampleCounts& counts, FloatImage& image) {
  for (std::size_t p = 0; p < part.pixelOrder.size(); ++p) {
    const std::uint32_t n = counts.ofPixel(part.first + p);
    image.pixels[placeOf(part.pixelOrder[p], image)] =
        n >= 2 ? static_cast<float>(std::sqrt(varianceOfMean(part, p, n)))
               : std::numeric_limits<float>::infinity();
  }
}

void showSamples(const FilmPart& part, const SampleCounts& counts, FloatImage& image) {
  for (std::size_t p = 0; p < part.pixelOrder.size(); ++p)
    image.pixels[placeOf(part.pixelOrder[p], image)] = static_cast<float>(counts.ofPixel(part.first + p));
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

std::map<std::string, FloatImage> splitAovs(const Settings& settings,
                                            const std::vector<std::uint32_t>& pixelOrder,
                                            const std::vector<float>& planes) {
  const auto image = [&](int first, int channels) {
    return gather(blackImage(settings, channels), pixelOrder, planes, first);
  };
  return {{"depth", image(AOV_DEPTH, 1)},
          {"primitive", image(AOV_PRIMITIVE, 1)},
          {"normal", image(AOV_NORMAL, 3)},
          {"albedo", image(AOV_ALBEDO, 3)}};
}

}  // namespace whittle
