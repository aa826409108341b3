// whittle bench: rays per second of every kind of ray, beside Embree's on the same rays in the same run.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace whittle {

struct BenchOptions {
  std::string device;                                 ///< selector, as in Settings
  int threads = 0;                                    ///< 0: all
  int rays = 1 << 20;                                 ///< of each kind, about
  int runs = 5;                                       ///< interleaved; medians count
  bool allKernels = false;                            ///< not only the one that the renderer would use
  bool robustOnly = false;                            ///< only Embree's robust modes compete
  std::optional<std::filesystem::path> kernelFolder;  ///< kernels from here instead of the binary
  std::function<void(const std::string&)> phase;      ///< what is being done; may be empty
};

struct BenchRow {
  std::string rays;    ///< kind
  std::string query;   ///< nearest or any
  std::string kernel;  ///< name of a QueryKernel
  std::size_t count = 0;
  double mraysPerSecond = 0;
  std::string embreeMode;  ///< the fastest for these rays; empty in a build without Embree
  double embreeMraysPerSecond = 0;
  double ratio = 0;
  std::size_t disagree = 0;  ///< rays for which Embree's robust mode says something else than this kernel
};

/// What one kernel reads of the scene while it searches, bytes for each triangle of the scene.
struct KernelMemory {
  std::string kernel;
  double nodes = 0;
  double triangles = 0;  ///< their corners
};

struct BenchResult {
  std::size_t triangles = 0;
  int threads = 0;
  std::string device;
  double buildSeconds = 0;
  double bytesPerTriangle = 0;        ///< tree and triangles as the searches read them
  double launchSeconds = 0;           ///< of a query of one ray: what a launch costs
  double embreeSeconds = 0;           ///< build in medium quality: fast, or robust where only that competes
  std::vector<KernelMemory> kernels;  ///< every kernel, whether it takes part or not
  std::vector<BenchRow> rows;
};

/// Throws ClError, std::invalid_argument (device) or InputError (a scene without triangles).
BenchResult runBench(const Scene& scene, const BenchOptions& options);

}  // namespace whittle
