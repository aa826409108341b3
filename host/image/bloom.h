// Glare: a part of each pixel's light spread about it, in linear radiance.
#pragma once

#include "image/image_io.h"
#include "scene/settings.h"

namespace whittle {

/// Gaussians that share the scattered light evenly; each is half as wide as the one before.
inline constexpr int kBloomOctaves = 5;

/// `image` with the share `bloom.strength` of its light spread by a sum of kBloomOctaves Gaussians, the
/// widest with a standard deviation of bloom.radius times the height of the picture (of `frame` where the
/// image is a region). What would leave the image is mirrored at its border, so that its sum stays and a
/// constant image stays constant. Pixels that are not finite stay as they are and spread nothing. The same
/// for any number of threads; with strength 0 the same bits.
FloatImage withBloom(const FloatImage& image, const Bloom& bloom);

}  // namespace whittle
