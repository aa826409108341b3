// `whittle scale`: the points of a sweep rendered in turns on one machine, timed by stage, and held against
// each other and against what the machine gives.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "measure/ceilings.h"
#include "measure/load_watch.h"
#include "measure/rounds.h"
#include "measure/scaling_laws.h"
#include "render/renderer.h"
#include "scale/sweep.h"
#include "scene/scene.h"

namespace whittle {

struct SweepPlan {
  RoundsPlan rounds;
  bool measuresCeilings = false;  ///< of as many threads as the points have
  /// What sessions may hold on devices together, bytes. Where it is too little for all points they are set up
  /// anew, and warmed up, for each turn: slower, with the same numbers.
  std::uint64_t memory = 0;
  RenderHooks hooks;  ///< kernelFolder and compiler; phase: what is done now
  std::function<bool()> keepGoing;
};

struct SweptPoint {
  SweepPoint point;
  std::string refused;         ///< why it could not be measured; empty: it was
  Settings used;               ///< as the render used them
  std::vector<Sample> frames;  ///< seconds from the first launch to the last result (time.render)
  std::map<std::string, std::vector<Sample>>
      stages;                 ///< by kernel: seconds on the device, of the same frames
  std::uint64_t picture = 0;  ///< a hash of its pixels
  std::uint64_t rays = 0;     ///< of a frame
};

struct Sweep {
  std::vector<SweptPoint> points;
  std::vector<std::string> stages;  ///< their order in a frame
  std::vector<Ceilings> ceilings;   ///< of 1, and of each number of threads; empty: not asked for
  std::string device;               ///< of the first point
  unsigned processors = 0;          ///< of the machine
  double seconds = 0.0;             ///< that it took
  double frameSeconds = 0.0;        ///< of it, in the frames that are measured
  Load load;                        ///< the busiest that was seen of others
  bool isWhole = true;              ///< false: somebody ended it, or the time did
  /// Pairs of points whose pictures should be the same and are not.
  std::vector<std::pair<std::size_t, std::size_t>> differing;
};

/// Throws as render where the first point cannot be had; a later one is refused, with the reason.
Sweep runSweep(const Scene& scene, std::vector<SweepPoint> points, const SweepPlan& plan);

/// Of samples of points of a sweep.
struct Comparison {
  Interval seconds;
  Interval speedUp;  ///< over the first point, round by round
};
Comparison compare(const std::vector<Sample>& first, const std::vector<Sample>& samples);

/// Index of the fastest point of those with the first one's picture, and those that cannot be told from it.
struct Best {
  std::size_t point = 0;
  std::vector<std::size_t> asGood;
};
/// There must be a point with a frame.
Best bestOf(const Sweep& sweep);

/// Of the points that differ from the first in their threads alone, frame by frame.
std::vector<ScalingPoint> scalingPoints(const Sweep& sweep);

}  // namespace whittle
