// The film on the host: compensated sums to pixels, auxiliary outputs, and the picture's own error estimate.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "image/image_io.h"
#include "wavefront/sample_counts.h"

namespace whittle {

/// Planes of the film of a picture with this many samples for each pixel.
std::size_t filmPlanes(int samples);

/// filmPlanes planes of width·height floats (kernels/shared/layout.h), pixels in the
/// order of makePixelOrder.
struct FilmSums {
  int width = 0, height = 0;
  std::span<const std::uint32_t> pixelOrder;  ///< y << 16 | x
  std::vector<float> planes;
};

/// Mean of each pixel's samples, RGB; 0 where a pixel has none.
FloatImage resolveFilm(const FilmSums& sums, const SampleCounts& counts);

/// For each block of pixels, the sum over them of the variance of the pixel's mean, averaged over the
/// channels, (W/(m² sr))². Needs planes of more than one sample; infinite for a block with fewer than two
/// samples. It is what independent samples would give; stratified and Sobol samples do better than it says.
std::vector<double> blockVariances(const FilmSums& sums, const SampleCounts& counts);

/// Standard error of the picture, W/(m² sr): what `rootMeanSquare` to the true picture is expected to be (the
/// root of its expected square). blockVariances over all pixels.
double estimateError(const std::vector<double>& blockVariances, const SampleCounts& counts);

/// Mean radiance over pixels and colour channels, W/(m² sr).
double meanOfChannels(const FilmSums& sums, const SampleCounts& counts);

/// Samples of each pixel, one channel.
FloatImage sampleImage(const FilmSums& sums, const SampleCounts& counts);

/// Root mean square difference over the colour channels of two pictures of one size, as `whittle compare`
/// prints it.
double rootMeanSquare(const FloatImage& picture, const FloatImage& reference);

/// AOV_PLANES planes to named images.
std::map<std::string, FloatImage> splitAovs(int width, int height, const std::vector<float>& planes);

}  // namespace whittle
