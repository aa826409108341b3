// Launches the stages' kernels and keeps their times. A stage has one name: kernel, file, host method,
// profiler label.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <vector>

#include "cl/program.h"
#include "report/stats.h"
#include "report/trace.h"
#include "wavefront/device_scene.h"

namespace whittle {

/// Work items of a group where the user does not say: 64, as GPUs like them; with packets 8. PoCL hands a
/// thread up to 32 groups times the threads at once, and large ones would leave the other threads without
/// work at the end of every launch.
int defaultWorkGroup(const SceneFeatures& features);

/// What a launch works on: items as statistics count them, and the bytes of queues and film that it moves
/// (queue_traffic.h).
struct StageWork {
  StageWork(std::uint64_t itemCount, std::uint64_t byteCount = 0) : items(itemCount), bytes(byteCount) {}
  std::uint64_t items, bytes;
};

class StageRunner {
 public:
  /// `workGroup` work items at a time; every launch of a kernel uses the same, because PoCL compiles each
  /// anew.
  StageRunner(Compute& compute, const std::vector<cl::Program>& programs, int workGroup);

  /// Runs `kernel` over `workItems` work items. Arguments in the kernel's
  /// order: Buffers (empty ones become null pointers), a DeviceScene (expands to SCENE_PARAMS), or plain
  /// values.
  template <typename... Args>
  void run(const std::string& kernel, std::uint64_t workItems, StageWork work, const Args&... args) {
    if (workItems == 0) return;
    cl::Kernel& k = find(kernel);
    cl_uint index = 0;
    (set(k, kernel, index, args), ...);
    launch(kernel, k, workItems, work);
  }

  /// Keeps every launch for `trace` (null: none, the usual case). Launches count as of a batch and a bounce
  /// until they are set anew.
  void record(Trace* trace) { trace_ = trace; }
  void setBatch(std::uint32_t batch) { batch_ = batch; }
  void setBounce(std::uint32_t bounce) { bounce_ = bounce; }

  /// Bytes of the stage's last launch in this bounce that only its result tells.
  void addBytes(const std::string& name, std::uint64_t bytes) {
    stages_[stageIndex(name)].stage.bytes += bytes;
  }

  /// Work on the host from now to the end of the scope, for the trace.
  [[nodiscard]] HostWork hostWork(const char* name) const { return {trace_, name}; }

  /// Waits for all launches and adds their times to the statistics, where the queue keeps them.
  void collect();
  /// Over all bounces, in the order of the first launches.
  std::vector<StageStats> stats();
  /// Bounce by bounce, from 0.
  std::vector<BounceStats> statsByBounce();

 private:
  struct Launch {
    std::size_t stage;
    cl::Event event;
    StageWork work{0};
    std::uint32_t batch = 0;
    double enqueued = 0.0;  ///< seconds of the steady clock, right after the launch; only when recording
  };
  struct StageOfBounce {
    std::uint32_t bounce = 0;
    StageStats stage;
  };

  cl::Kernel& find(const std::string& name);
  /// Of the present bounce.
  std::size_t stageIndex(const std::string& name);
  void launch(const std::string& name, cl::Kernel& kernel, std::uint64_t workItems, StageWork work);
  void recordLaunch(const Launch& launch, std::uint64_t start, std::uint64_t end);
  void setBytes(cl::Kernel& kernel, const std::string& name, cl_uint index, std::size_t bytes,
                const void* value);
  void setBuffer(cl::Kernel& kernel, const std::string& name, cl_uint index, const Buffer& buffer);

  void set(cl::Kernel& k, const std::string& name, cl_uint& index, const Buffer& b) {
    setBuffer(k, name, index++, b);
  }
  void set(cl::Kernel& k, const std::string& name, cl_uint& index, const DeviceScene& scene) {
    for (const Buffer* b : scene.buffers()) setBuffer(k, name, index++, *b);
    setBytes(k, name, index++, sizeof(scene.triangleCount), &scene.triangleCount);
  }
  template <typename T>
  void set(cl::Kernel& k, const std::string& name, cl_uint& index, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    setBytes(k, name, index++, sizeof(T), &value);
  }

  Compute& compute_;
  std::size_t workGroup_;
  std::unordered_map<std::string, cl::Kernel> kernels_;  ///< of all programs
  std::vector<StageOfBounce> stages_;
  std::vector<Launch> launches_;
  Trace* trace_ = nullptr;
  std::uint32_t batch_ = 0, bounce_ = 0;
};

}  // namespace whittle
