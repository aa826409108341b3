// The film on the host: compensated sums to pixels, auxiliary outputs, and the picture's own error estimate.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "image/image_io.h"
#include "wavefront/sample_counts.h"

namespace whittle {

/// Planes of the film of such a picture; `coverage`: with the transmittance.
std::size_t filmPlanes(const Settings& settings, bool coverage);

/// A part of the film, pixels `first` and on in the order of makePixelOrder: as much as is looked at at once.
struct FilmPart {
  std::size_t first = 0;                  ///< the beginning of a block
  std::vector<std::uint32_t> pixelOrder;  ///< y << 16 | x, of its pixels
  std::vector<float> planes;              ///< filmPlanes planes of its pixels (kernels/shared/layout.h)
};

// Images are black images of what the film holds: the picture, or a region in its frame.

/// Where a pixel (y << 16 | x of the picture) lies in such an image.
std::size_t placeOf(std::uint32_t pixel, const FloatImage& image);

/// Puts the mean of each pixel's samples into `image`, RGB; 0 where a pixel has none.
void resolveFilm(const FilmPart& part, const SampleCounts& counts, FloatImage& image);

/// Adds to each block of pixels the sum over those of the part of the variance of the pixel's mean, averaged
/// over the channels, (W/(m² sr))². Needs planes of more than one sample; infinite for a block with fewer
/// than two samples. It is what independent samples would give; stratified and Sobol samples do better than
/// it says.
void addBlockVariances(const FilmPart& part, const SampleCounts& counts, std::vector<double>& variances);

/// Standard error of the picture, W/(m² sr): what `rootMeanSquare` to the true picture is expected to be (the
/// root of its expected square). blockVariances over all pixels.
double estimateError(const std::vector<double>& blockVariances, const SampleCounts& counts);

/// Adds the radiance of all pixels and colour channels, W/(m² sr), to `total`.
void addRadiance(const FilmPart& part, const SampleCounts& counts, double& total);

/// Puts the share of each pixel that the scene covers into `image`, one channel: 1 less the mean
/// transmittance of the samples. Needs a film with coverage.
void resolveAlpha(const FilmPart& part, const SampleCounts& counts, FloatImage& image);

/// Puts the standard error of each pixel's mean into `image`, the root of its variance averaged over the
/// channels, W/(m² sr), one channel. Needs planes of more than one sample; infinite with fewer than two.
void showErrors(const FilmPart& part, const SampleCounts& counts, FloatImage& image);

/// Puts the samples of each pixel into `image`, one channel.
void showSamples(const FilmPart& part, const SampleCounts& counts, FloatImage& image);

/// Root mean square difference over the colour channels of two pictures of one size, as `whittle compare`
/// prints it.
double rootMeanSquare(const FloatImage& picture, const FloatImage& reference);

/// AOV_PLANES planes to named images of the settings' region.
std::map<std::string, FloatImage> splitAovs(const Settings& settings,
                                            const std::vector<std::uint32_t>& pixelOrder,
                                            const std::vector<float>& planes);

}  // namespace whittle
