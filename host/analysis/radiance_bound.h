// What a cut-off can cost at most: an upper bound on the radiance that comes back along any ray.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "image/image_io.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

/// Element n: an upper bound, each channel, W/(m² sr), on the radiance along a ray that may be followed
/// through n hits more (element 0: 0). Infinite where there is no bound: a light on a surface that scatters
/// it, factors of a material outside their range.
std::vector<glm::dvec3> radianceBounds(const Scene& scene, const Settings& settings, int hits);

/// An upper bound on the mean over the picture of the radiance (largest channel, W/(m² sr)) that the cut-off
/// left out. cutOffPerSample: RayTally::cutOff for each sample. 0 where nothing was cut off; infinite where
/// radianceBounds is. With ImpulseMode::One it bounds the expected radiance, about which the choices scatter.
double biasBound(const Scene& scene, const Settings& settings, const std::vector<double>& cutOffPerSample);

/// The mean of a picture in its brightest channel, W/(m² sr): what biasBound bounds a change of.
double meanRadiance(const FloatImage& radiance);

/// RayTally::cutOff as throughput: the sum of the largest channels.
double cutOffThroughput(const Settings& settings, const std::vector<std::uint64_t>& cutOff);

}  // namespace whittle
