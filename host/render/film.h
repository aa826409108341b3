// The film on the host: compensated sums to pixels, auxiliary outputs, and the picture's own error estimate.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "scene/image_io.h"

namespace whittle {

/// Planes of the film of a picture with this many samples for each pixel.
std::size_t filmPlanes(int samples);

/// filmPlanes planes of width·height floats (kernels/shared/layout.h), pixels in the order of
/// makePixelOrder.
struct FilmSums {
  int width = 0, height = 0;
  std::span<const std::uint32_t> pixelOrder;  ///< y << 16 | x
  std::vector<float> planes;
};

/// Mean of `samples` samples for each pixel, RGB.
FloatImage resolveFilm(const FilmSums& sums, int samples);

/// Standard error of the picture from the variance of its samples: the RMS over pixels of the standard
/// deviation of the luminance mean, W/(m² sr). Needs samples >= 2. It is what independent samples would give;
/// stratified and Sobol samples do better than it says.
double estimateError(const FilmSums& sums, int samples);

/// Root mean square difference over the colour channels of two pictures of one size, as `whittle compare`
/// prints it.
double rootMeanSquare(const FloatImage& picture, const FloatImage& reference);

/// AOV_PLANES planes to named images.
std::map<std::string, FloatImage> splitAovs(int width, int height, const std::vector<float>& planes);

}  // namespace whittle
