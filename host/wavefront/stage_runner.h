// Launches stages and keeps their times.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "cl/program.h"
#include "report/stats.h"
#include "report/trace.h"
#include "wavefront/kernel_arguments.h"
#include "wavefront/stages.h"

namespace whittle {

/// Work items of a group where the user does not say: 64, as GPUs like them; with packets 8. PoCL hands a
/// thread up to 32 groups times the threads at once, and large ones would leave the other threads without
/// work at the end of every launch.
int defaultWorkGroup(const SceneFeatures& features);

/// What a device that ends loops (DeviceFacts::loopLimit) may be given at once, so that no loop of a stage
/// comes near that; without bounds on one that does not.
struct LoopLimits {
  static constexpr std::uint32_t kNone = 0xffffffffU;
  /// 1 024 entries with two impulses each, plane by plane, are too many.
  static constexpr std::uint32_t kCompactChunk = 128;

  std::uint32_t triangles = kNone;  ///< without a tree
  std::uint32_t entries = kNone;    ///< of a queue: a work item sums its chunks
  std::uint32_t samples = kNone;    ///< of a pixel in a batch
  std::uint32_t lights = kNone;     ///< of a launch of shade
};
LoopLimits loopLimits(const DeviceInfo& device);

/// Chunks of the compaction: long ones for few CPU threads, short ones for the many of a GPU.
std::uint32_t defaultCompactChunk(const DeviceInfo& device);

class StageRunner {
 public:
  /// `workGroup` work items at a time; every launch of a kernel uses the same, because PoCL
  /// compiles each anew.
  StageRunner(Compute& compute, const std::vector<cl::Program>& programs, int workGroup,
              const LaunchWidths& widths, const EntryBytes& entryBytes = {});

  /// Launches a stage unless it has no work items. `moreBytes`: what its arguments do not tell of the bytes
  /// that it moves.
  template <typename S>
  void run(const S& stage, Bytes moreBytes = 0) {
    const std::uint64_t workItems = workItemsOf(stage, widths_);
    if (workItems == 0) return;
    cl::Kernel& kernel = find(S::stage.facts.name);
    setArguments(kernel, stage);
    launch(S::stage, kernel, workItems, {stage.items(), stage.bytes(entryBytes_) + moreBytes});
  }

  /// Goes on with the kernels of other programs, of the same work-group and widths. Nothing may be under way.
  void use(const std::vector<cl::Program>& programs);

  /// Keeps every launch for `trace` (null: none, the usual case). Launches count as of a batch and a bounce
  /// until they are set anew.
  void record(Trace* trace) { trace_ = trace; }
  void setBatch(std::uint32_t batch) { batch_ = batch; }
  void setBounce(std::uint32_t bounce) { bounce_ = bounce; }

  /// Bytes of the stage's last launch in this bounce that only its result tells.
  template <typename S>
  void addBytes(Bytes bytes) {
    stages_[stageIndex(S::stage)].stats.bytes += bytes;
  }

  /// Work on the host from now to the end of the scope, for the trace.
  [[nodiscard]] HostWork hostWork(const char* name) const { return {trace_, name}; }

  /// Waits for all launches and adds their times to the statistics, where the queue keeps them. (A driver
  /// whose times are none has each launch waited for, and timed by the host's clock.)
  void collect();
  /// Over all bounces, in the order of the first launches.
  std::vector<StageStats> stats();
  /// Bounce by bounce, from 0.
  std::vector<BounceStats> statsByBounce();

 private:
  /// What a launch works on.
  struct Work {
    std::uint64_t items = 0;
    Bytes bytes = 0;
  };
  struct Launch {
    std::size_t stage;  ///< index in stages_
    cl::Event event;
    Work work;
    std::uint32_t batch = 0;
    double start = 0.0, enqueued = 0.0;  ///< seconds of the steady clock, before and right after the launch
  };
  struct StageOfBounce {
    std::uint32_t bounce = 0;
    StageStats stats;
  };

  cl::Kernel& find(const char* name);
  /// Of the present bounce.
  std::size_t stageIndex(const Stage& stage);
  void launch(const Stage& stage, cl::Kernel& kernel, std::uint64_t workItems, Work work);
  void finish();
  void timeByHost(Launch& launch);
  void recordLaunch(const Launch& launch, std::uint64_t start, std::uint64_t end);
  void record(const Launch& launch, double queued, double start, double end);

  Compute& compute_;
  std::size_t workGroup_;
  LaunchWidths widths_;
  EntryBytes entryBytes_;
  std::unordered_map<std::string, cl::Kernel> kernels_;  ///< of all programs
  std::vector<StageOfBounce> stages_;
  std::vector<Launch> launches_;
  Trace* trace_ = nullptr;
  std::uint32_t batch_ = 0, bounce_ = 0;
};

}  // namespace whittle
