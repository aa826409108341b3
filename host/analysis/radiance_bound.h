// What rays that are not followed can cost at most: an upper bound on the radiance that comes back along one.
#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include "image/image_io.h"
#include "kernels/shared/layout.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

/// Throughputs (largest channels) of the impulses that were not followed, summed in units of 1 / ENDED_UNITS,
/// by what ended them (ENDED_…). The same however the samples were cut into batches.
using EndedUnits = std::array<std::uint64_t, ENDED_KINDS>;

/// The same as numbers: 1 is all that one sample may carry.
struct EndedThroughput {
  double cutOff = 0.0;    ///< --cutoff
  double bounces = 0.0;   ///< --bounces
  double straight = 0.0;  ///< --transparent-bounces
};
EndedThroughput endedThroughput(const EndedUnits& units);

/// An upper bound, each channel, W/(m² sr), on the radiance along any ray, followed as far as it goes.
/// Infinite where there is none: a light on a surface that scatters it, factors of a material outside their
/// range, surfaces that emit and reflect everything.
glm::dvec3 radianceBound(const Scene& scene, const Settings& settings);

/// An upper bound on the mean over the picture of the radiance (largest channel, W/(m² sr)) that impulses
/// would have brought which --cutoff, --bounces or --transparent-bounces ended. endedPerSample: throughput
/// for each sample, of all kinds. With one bounce reflections are not even counted: then it is all that any
/// surface may reflect or refract. 0 where nothing ended; infinite where radianceBound is. With
/// ImpulseMode::One or a sky light it bounds the expected radiance, about which the choices scatter.
double biasBound(const Scene& scene, const Settings& settings, double endedPerSample);

/// The same for picture after picture of one scene, which is gone through once, when it is first needed.
class BiasBound {
 public:
  /// Refers to both.
  BiasBound(const Scene& scene, const Settings& settings) : scene_(scene), settings_(settings) {}
  double operator()(double endedPerSample);

 private:
  const Scene& scene_;
  const Settings& settings_;
  bool isKnown_ = false;
  glm::dvec3 bound_{0}, impulses_{0};  ///< of a ray; what impulses may bring, where they are not counted
};

/// The mean of a picture in its brightest channel, W/(m² sr): what biasBound bounds a change of.
double meanRadiance(const FloatImage& radiance);

}  // namespace whittle
