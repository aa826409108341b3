// The buffers of rays in flight: a pool of ray queues of one capacity, and the work space of one segment.
#pragma once

#include <cstdint>
#include <vector>

#include "analysis/scene_features.h"
#include "cl/program.h"
#include "report/stats.h"
#include "wavefront/stages.h"

namespace whittle {

/// Entries [begin, end) of a ray queue that are traced together.
struct Segment {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint32_t count() const { return end - begin; }
};

/// The features that decide on the queues' buffers.
inline constexpr std::uint64_t kQueueFeatures =
    bitOf(Feature::TEXTURES) | bitOf(Feature::ABSORPTION) | bitOf(Feature::AOVS) | bitOf(Feature::FAR_PLANE) |
    bitOf(Feature::STRAIGHT) | bitOf(Feature::IMPULSES) | bitOf(Feature::BOTH_BRANCHES) |
    bitOf(Feature::COVERAGE) | bitOf(Feature::SHADOWS) | bitOf(Feature::COST) |
    bitOf(Feature::TEXTURE_LEVELS) | bitOf(Feature::DISPERSION);

/// The most rays that a hit sends out: a reflection, and a refraction that splits into three.
inline std::uint32_t mostRaysOfHit(const SceneFeatures& features) {
  if (!features.has(Feature::BOTH_BRANCHES)) return 1;
  return features.has(Feature::DISPERSION) ? 4 : 2;
}

class RayQueues {
 public:
  /// Allocates what the features need for `capacity` entries; ray queues themselves come on demand.
  /// waitingLights: lights whose shadow candidates are kept at once (mostWaiting).
  RayQueues(Compute& compute, const SceneFeatures& features, std::uint32_t waitingLights,
            std::uint32_t capacity, std::uint32_t compactChunk)
      : RayQueues(compute, features, features, waitingLights, capacity, compactChunk) {}
  /// The same with the planes of `planes`, which has all of `features`, in each of those buffers: for kernels
  /// that have more features than the scene needs.
  RayQueues(Compute& compute, const SceneFeatures& features, const SceneFeatures& planes,
            std::uint32_t waitingLights, std::uint32_t capacity, std::uint32_t compactChunk)
      : RayQueues(compute,
                  Asked{SceneFeatures::ofBits(features.bits() & kQueueFeatures),
                        SceneFeatures::ofBits(planes.bits() & kQueueFeatures), std::max(waitingLights, 1U)},
                  capacity, compactChunk) {}

  std::uint32_t capacity() const { return capacity_; }
  /// Entries a segment may have: the capacity over the rays that a hit can send out.
  std::uint32_t segmentLimit() const { return segmentLimit_; }
  /// Without distances where nothing asks for them.
  std::uint32_t hitPlanes() const { return hitPlanes_; }
  /// Of one impulse candidate, as kernels with the features lay it out; with cones where textures are
  /// filtered.
  std::uint32_t impulsePlanes() const { return impulsePlanes_; }
  /// Flags take none where nothing is found that has to be compacted.
  EntryBytes entryBytes() const { return entryBytes_; }

  /// A free ray queue; give it back with release. Queues are kept and reused.
  Buffer acquire();
  void release(Buffer queue) { free_.push_back(std::move(queue)); }
  /// Makes sure that `count` ray queues are there.
  void reserve(std::size_t count);

  /// Splits [0, count) of `queue` into segments that the next queue can hold, never inside a sample, unless
  /// the sample is longer than LONG_RUN: such a one is always sliced alike, whatever the capacity.
  std::vector<Segment> cut(const Buffer& queue, std::uint32_t count, bool mayHaveLongRuns) const;

  void report(std::vector<BufferStats>& out) const;

  Buffer hits, entryRadiance, sampleRadiance, shadows, shadowQueue, impulses, flags, totals, sums;

 private:
  /// Of kQueueFeatures alone.
  struct Asked {
    SceneFeatures features, planes;
    std::uint32_t waitingLights;
  };
  RayQueues(Compute& compute, const Asked& asked, std::uint32_t capacity, std::uint32_t compactChunk);
  std::vector<std::uint32_t> readSlots(const Buffer& queue, std::uint32_t begin, std::uint32_t count) const;
  std::vector<Segment> cutLongRuns(const std::vector<std::uint32_t>& slots) const;

  Compute& compute_;
  std::uint32_t capacity_;
  std::uint32_t segmentLimit_;
  std::uint32_t rayPlanes_;  ///< of a ray queue
  std::uint32_t hitPlanes_;
  std::uint32_t impulsePlanes_;
  std::uint32_t radiancePlanes_;
  EntryBytes entryBytes_;
  std::vector<Buffer> free_;
  std::uint64_t queuesMade_ = 0;
};

}  // namespace whittle
