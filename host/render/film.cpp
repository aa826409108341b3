// Film arithmetic in double precision.
#include "render/film.h"

#include <algorithm>
#include <cmath>

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

FloatImage resolveFilm(const FilmSums& sums, int samples) {
  FloatImage image{sums.width, sums.height, 3, {}};
  const std::size_t pixels = static_cast<std::size_t>(sums.width) * sums.height;
  image.pixels.resize(pixels * 3);
  const auto at = [&](std::size_t p) {
    return static_cast<std::size_t>(sums.pixelOrder[p] >> 16) * sums.width + (sums.pixelOrder[p] & 0xffffU);
  };
  for (std::size_t p = 0; p < pixels; ++p)
    for (int c = 0; c < 3; ++c)
      image.pixels[at(p) * 3 + c] =
          static_cast<float>(plane(sums, FILM_SUM + c, FILM_COMPENSATION + c, p) / samples);
  return image;
}

double estimateError(const FilmSums& sums, int samples) {
  const std::size_t pixels = static_cast<std::size_t>(sums.width) * sums.height;
  double total = 0.0;
  for (std::size_t p = 0; p < pixels; ++p) {
    const double r = plane(sums, FILM_SUM, FILM_COMPENSATION, p),
                 g = plane(sums, FILM_SUM + 1, FILM_COMPENSATION + 1, p),
                 b = plane(sums, FILM_SUM + 2, FILM_COMPENSATION + 2, p);
    const double mean = (0.2126 * r + 0.7152 * g + 0.0722 * b) / samples;
    const double squares = plane(sums, FILM_SQUARES, FILM_SQUARES_COMPENSATION, p) / samples;
    total += std::max(0.0, squares - mean * mean) / (samples - 1);
  }
  return std::sqrt(total / static_cast<double>(pixels));
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
