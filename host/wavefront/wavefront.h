// The wavefront loop: batches of samples through the stages, bounce by bounce. The only file
// that launches kernels.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "analysis/light_groups.h"
#include "analysis/radiance_bound.h"
#include "analysis/scene_features.h"
#include "cl/program.h"
#include "kernels/shared/layout.h"
#include "wavefront/device_scene.h"
#include "wavefront/ray_queues.h"
#include "wavefront/stage_runner.h"
#include "wavefront/wavefront_observer.h"

namespace whittle {

struct RayTally {
  std::uint64_t primary = 0, impulse = 0, shadow = 0;
  std::uint64_t produced = 0;  ///< rays put into a queue
  std::uint64_t finished = 0;  ///< rays intersected and shaded
  EndedUnits ended{};
};

/// What every launch needs besides the queues; owned by the Renderer.
struct WavefrontSetup {
  const SceneFeatures& features;
  const DeviceScene& scene;
  const std::vector<LightGroup>& lights;
  device::DeviceCamera camera;
  device::RenderConstants constants;
  std::uint32_t bounces;
  std::uint32_t rounds;  ///< of the loop, see mostHits
  std::uint32_t compactChunk;
  std::uint32_t pixels;  ///< of the film
  /// Of a pixel in a batch, and whether walks have a budget (loopLimits, LOOP_BUDGET).
  std::uint32_t mostSamples = LoopLimits::kNone;
  bool hasLoopBudget = false;
};

/// Samples [firstSample, firstSample + samples) of `pixels` pixels. Without `blocks` pixel i is i of the
/// film's order, and `order` is that; with them they are whole film blocks (layout.h), `order` their
/// pixels only.
struct TracePass {
  const Buffer& order;
  const Buffer& blocks;
  std::uint32_t pixels = 0, firstSample = 0, samples = 0;
};

/// Asked between segments and batches; false: stop.
struct KeepGoing {
  /// Samples of the pass that are finished, in parts: a batch under way counts as far as its rays have come.
  /// `betweenBatches`: nothing is lost by stopping here.
  std::function<bool(double samplesDone, bool betweenBatches)> ask;
};

class Wavefront {
 public:
  /// `film`, `aovs`: of all pixels of the setup, in the film's order. `aovs` may be empty.
  Wavefront(Compute& compute, StageRunner& stages, RayQueues& queues, const WavefrontSetup& setup,
            const Buffer& film, const Buffer& aovs);

  /// Traces a pass and adds it to the film; returns how many of its pixels have all their samples: all of
  /// them, or, where it was told to stop, whole film blocks. The picture's bits do not depend on how samples
  /// are split into passes.
  std::uint32_t trace(const TracePass& pass, const KeepGoing& keepGoing);

  /// Tells it what becomes of every ray, which takes long; null: nobody.
  void observe(WavefrontObserver* observer) { observer_ = observer; }

  /// Called before each batch, with its number in the render, when nothing is under way: kernels may be
  /// changed for others then.
  void beforeEachBatch(std::function<void(std::uint32_t batch)> visit) { beforeBatch_ = std::move(visit); }

  const RayTally& tally() const { return tally_; }
  std::uint32_t nonFinite();
  /// Counts on from what an earlier wavefront had counted.
  void countOn(const RayTally& tally, std::uint32_t nonFinite);

 private:
  /// The part of a pass that a queue's rays stand for, for progress.
  struct Share {
    double from = 0.0, to = 0.0;
  };
  /// False: stopped, and the film is as before.
  bool traceBatch(const TracePass& pass, const device::Batch& batch, Share share);
  bool traceQueue(Buffer queue, std::uint32_t count, std::uint32_t bounce, Share share);
  std::uint32_t traceSegment(const Buffer& queue, Segment segment, std::uint32_t bounce, Buffer& next);

  void raygen(const Buffer& queue, std::uint32_t count);
  void intersect(const Buffer& queue, Segment segment, std::uint32_t bounce);
  void shade(const Buffer& queue, Segment segment, std::uint32_t bounce);
  void shadeLight(const Buffer& queue, Segment segment, std::uint32_t bounce, const LightGroup& lights);
  /// What shading asked for in a segment.
  struct Candidates {
    std::uint32_t shadow = 0, impulse = 0;
    EndedUnits ended{};
  };
  /// Of a set of shadow candidates; impulses come with the first one.
  Candidates countCandidates(Segment segment, bool mayEnd, std::uint32_t set);
  /// Whether an impulse of this bounce's hits may not be followed though it carries something.
  bool mayEnd(std::uint32_t bounce) const;
  /// The turns of a group's lights, shaded by stage S; returns what came with the first one.
  template <typename S>
  Candidates takeTurns(const ObservedSegment& segment, const LightGroup& lights);
  /// Of light i of a group that waits.
  LightTurn turnOf(const LightGroup& lights, std::uint32_t i) const;
  std::uint32_t compactShadow(Segment segment, std::uint32_t found, std::uint32_t set);
  void occlude(std::uint32_t count, std::uint32_t set);
  void addLight(Segment segment, std::uint32_t set);
  std::uint32_t compactImpulse(const Buffer& queue, Segment segment, std::uint32_t bounce,
                               std::uint32_t found, Buffer& next);
  void accumulate(const Buffer& queue, Segment segment);
  void film(const Buffer& blocks);

  /// Throws ClError where a walk of the batch was longer than the device lets loops be.
  void checkWalks();
  std::uint32_t chunksOf(Segment segment) const;
  std::vector<Segment> cut(const Buffer& queue, std::uint32_t count, std::uint32_t bounce);
  bool mayHaveLongRuns(std::uint32_t count, std::uint32_t bounce) const;
  bool hasLongRuns(const Buffer& queue, std::uint32_t count, std::uint32_t bounce);

  Compute& compute_;
  StageRunner& stages_;
  RayQueues& queues_;
  WavefrontSetup setup_;
  const Buffer* pixelOrder_ = nullptr;  ///< of the pass
  const Buffer& film_;
  const Buffer& aovs_;
  Buffer counters_;
  device::Batch batch_{};
  const KeepGoing* keepGoing_ = nullptr;
  bool mayStop_ = false;
  std::uint32_t batchesDone_ = 0;
  const Buffer* radiance_ = nullptr;  ///< where the segment's entries put theirs
  RayTally tally_;
  WavefrontObserver* observer_ = nullptr;
  std::function<void(std::uint32_t)> beforeBatch_;
};

}  // namespace whittle
