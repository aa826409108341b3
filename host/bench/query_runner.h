// The renderer's own intersect and occlude kernels on rays of one's choice, timed.
#pragma once

#include <filesystem>
#include <optional>

#include "bench/ray_sets.h"
#include "bvh/tri_tree.h"
#include "wavefront/device_scene.h"
#include "wavefront/stage_runner.h"

namespace whittle {

/// How the kernels search; the names stand in reports.
struct QueryKernel {
  const char* name;
  std::uint64_t features;  ///< bits of kernels/shared/features.h
};

/// Every kernel there is; first the one that the renderer uses on a CPU, for rays of any kind.
const std::vector<QueryKernel>& queryKernels();

/// One kernel, compiled, with its scene on the device. Opaque triangles only: neither textures nor
/// masks take part.
class QueryRunner {
 public:
  /// Throws ClError.
  QueryRunner(Compute& compute, const Scene& scene, const TriTree& tree, const QueryKernel& kernel,
              const std::optional<std::filesystem::path>& kernelFolder = {});

  /// Uploads the rays; the queries below work on them.
  void load(const RaySet& rays);
  /// Seconds that one query of all rays takes, from the first launch to the last result on the device.
  double nearest();
  double any();
  /// Results of the last nearest() and any(). Shadow rays end before their length. Throw ClError where a walk
  /// was longer than the device lets loops be.
  std::vector<QueryHit> hits();
  std::vector<bool> blocked();

  const QueryKernel& kernel() const { return kernel_; }
  std::size_t sceneBytes() const;
  /// Of those, what the search of opaque triangles reads: nodes and corners.
  std::size_t nodeBytes() const;
  std::size_t triangleBytes() const;

 private:
  void checkWalks();

  Compute& compute_;
  const TriTree& tree_;
  QueryKernel kernel_;
  DeviceScene scene_;
  std::optional<StageRunner> stages_;
  std::uint32_t count_ = 0, capacity_ = 0;
  Buffer rays_, hits_, shadows_, queue_, radiance_;
  Buffer counters_;  ///< where walks have a budget
};

}  // namespace whittle
