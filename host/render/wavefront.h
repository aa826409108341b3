// The wavefront loop: batches of samples through the stages, bounce by bounce. The only file that launches
// kernels.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "cl/program.h"
#include "kernels/shared/layout.h"
#include "render/device_scene.h"
#include "render/ray_queues.h"
#include "render/scene_features.h"
#include "render/stage_runner.h"

namespace whittle {

struct RayTally {
  std::uint64_t primary = 0, impulse = 0, shadow = 0;
  std::uint64_t produced = 0;  ///< rays put into a queue
  std::uint64_t finished = 0;  ///< rays intersected and shaded
  /// Of the impulses that the cut-off left out at the hits of bounce b + 1: largest channels of their
  /// throughputs, summed, in units of cutoff / CUTOFF_UNITS. The same however the samples were cut into
  /// batches.
  std::vector<std::uint64_t> cutOff;
};

/// What every launch needs besides the queues; owned by the Renderer.
struct WavefrontSetup {
  const SceneFeatures& features;
  const DeviceScene& scene;
  device::DeviceCamera camera;
  device::RenderConstants constants;
  std::uint32_t bounces;
  std::uint32_t compactChunk;
};

class Wavefront {
 public:
  /// `film`, `aovs`, `pixelOrder`: of the whole picture. `aovs` may be empty.
  Wavefront(Compute& compute, StageRunner& stages, RayQueues& queues, const WavefrontSetup& setup,
            const Buffer& pixelOrder, const Buffer& film, const Buffer& aovs);

  /// Traces samples [firstSample, firstSample + samples) of every pixel and adds them to the film; the
  /// picture's bits do not depend on how samples are split into calls. `progress(samplesDone)` is called
  /// after each batch.
  void trace(std::uint32_t firstSample, std::uint32_t samples,
             const std::function<void(std::uint64_t)>& progress);

  const RayTally& tally() const { return tally_; }
  std::uint32_t nonFinite();

 private:
  void traceBatch(const device::Batch& batch);
  void traceQueue(Buffer queue, std::uint32_t count, std::uint32_t bounce);
  std::uint32_t traceSegment(const Buffer& queue, Segment segment, std::uint32_t bounce, Buffer& next);

  void raygen(const Buffer& queue, std::uint32_t count);
  void intersect(const Buffer& queue, Segment segment);
  void shade(const Buffer& queue, Segment segment, std::uint32_t bounce);
  void shadeLight(const Buffer& queue, Segment segment, std::uint32_t light);
  /// What shading asked for in a segment.
  struct Candidates {
    std::uint32_t shadow = 0, impulse = 0;
    std::uint64_t cutOff = 0;  ///< units, as RayTally::cutOff
  };
  Candidates countCandidates(Segment segment);
  std::uint32_t compactShadow(Segment segment, std::uint32_t found);
  void occlude(std::uint32_t count);
  std::uint32_t compactImpulse(const Buffer& queue, Segment segment, std::uint32_t found, Buffer& next);
  void accumulate(const Buffer& queue, Segment segment);
  void film();

  std::uint32_t chunksOf(Segment segment) const;
  std::vector<Segment> cut(const Buffer& queue, std::uint32_t count, std::uint32_t bounce);
  bool mayHaveLongRuns(std::uint32_t count, std::uint32_t bounce) const;
  bool hasLongRuns(const Buffer& queue, std::uint32_t count, std::uint32_t bounce);
  /// Work items of a kernel whose items handle LANES entries each.
  std::uint32_t laneItems(std::uint32_t entries) const;
  std::uint32_t searchItems(std::uint32_t rays) const;

  Compute& compute_;
  StageRunner& stages_;
  RayQueues& queues_;
  WavefrontSetup setup_;
  const Buffer& pixelOrder_;
  const Buffer& film_;
  const Buffer& aovs_;
  Buffer counters_;
  device::Batch batch_{};
  std::uint32_t batchesDone_ = 0;
  const Buffer* radiance_ = nullptr;  ///< where the segment's entries put theirs
  RayTally tally_;
};

}  // namespace whittle
