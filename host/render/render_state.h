// A picture under way: all that a later render needs to go on to the same bits.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/stats.h"
#include "wavefront/sample_counts.h"
#include "wavefront/wavefront.h"

namespace whittle {

/// What a render had when it was interrupted, or ended. With the same scene, settings and device a render
/// that goes on from here (RenderHooks::resumed) ends with the bits of one that was never interrupted.
struct RenderState {
  std::vector<std::uint32_t> counts;  ///< samples of each block of pixels (SampleCounts)
  /// Of the passes that were decided on, what is still to be traced: decisions of --adaptive and of a target
  /// are taken at the same counts whether somebody interrupts or not.
  std::vector<SamplePass> pending;
  std::vector<float> film;  ///< planes × pixels in the pixel order (kernels/shared/layout.h)
  std::vector<float> aovs;  ///< likewise; empty: none are kept
  std::string device;       ///< its name and driver: others round otherwise
  RayTally tally;
  std::uint32_t nonFinite = 0;    ///< samples
  double endedShare = 0.0;        ///< as SamplingLoop sums it
  double seconds = 0.0;           ///< of rendering, over all sittings
  std::vector<ErrorPoint> error;  ///< of all sittings
};

}  // namespace whittle
