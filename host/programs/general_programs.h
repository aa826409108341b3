// The general programs (analysis/general_features.h) as device binaries in our cache: compiled once for a
// machine, and loaded without a compiler.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/general_features.h"
#include "cl/program_cache.h"
#include "programs/kernel_programs.h"

namespace whittle {

/// The text of a general program, with the kernels of all stages. `folder`: see kernelPrograms.
std::vector<KernelProgram> generalKernels(const GeneralProgram& program,
                                          const std::optional<std::filesystem::path>& folder = {});

/// What the general programs are compiled for where nobody asks for other sizes.
CompileTarget usualTarget(const DeviceInfo& device);

/// Whether all of them are in the cache. One of them may yet turn out to be damaged.
bool haveBinaries(const ProgramCache& cache, const DeviceInfo& device,
                  const std::vector<KernelProgram>& programs, const CompileTarget& target);

/// The programs: those that the device kept, else from the cache, and kept from then on. Empty where one is
/// missing, or the driver refuses it, which takes it out of the cache.
std::vector<cl::Program> loadBinaries(const ProgramCache& cache, OpenDevice& device,
                                      const std::vector<KernelProgram>& programs,
                                      const CompileTarget& target);

/// One program of those that the cache should have, for progress.
struct WarmingStep {
  std::string what;  ///< as the cache's entry says
  bool isThere = false;
};
/// Compiles what the cache lacks of the general programs, one after the other; of several processes each
/// compiles what no other is at. `isBackwards`: from the last to the first, for the second of two. `step`:
/// before each of them. Throws ClError, BuildError and UnwritableFile, and ClError for a device whose driver
/// gives no machine code (keepsCompiled).
void warmCache(const ProgramCache& cache, Compute& compute, bool isBackwards,
               const std::function<void(const WarmingStep&)>& step);

}  // namespace whittle
