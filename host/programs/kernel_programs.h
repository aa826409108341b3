// The programs that a set of features compiles to. Three, not one, and each cut down by the features its own
// text asks for: two scenes that shade differently share their searches, and what one render compiled serves
// the next.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/scene_features.h"
#include "cl/program.h"
#include "programs/kept_programs.h"

namespace whittle {

/// One program before it is compiled.
struct KernelProgram {
  std::string name;                  ///< "searches", "shading", "queues"
  std::string source;                ///< includes resolved
  std::uint64_t features = 0;        ///< those of the scene's that the source asks for
  std::vector<std::string> kernels;  ///< that will be launched, in the order of their first launch
  bool mayRelax = false;             ///< see CompileTarget::relaxedArithmetic
};

/// The programs for `features`, without those of which no kernel is among `stages`. `folder`: kernels from
/// there instead of the binary. The one that takes longest to compile comes first.
std::vector<KernelProgram> kernelPrograms(const SceneFeatures& features,
                                          const std::vector<std::string>& stages,
                                          const std::optional<std::filesystem::path>& folder = {});

/// What besides the programs' text decides on the code that comes out.
struct CompileTarget {
  std::uint32_t compactChunk = 0;  ///< see COMPACT_CHUNK
  int workGroup = 0;               ///< work items of every launch
  /// Shading is built with -cl-fast-relaxed-math: no value is NaN or infinite, sums may be reordered,
  /// divisions and roots lose a bit or two. Never the others: the searches would no longer agree with each
  /// other, and the film's compensated sums would be folded into plain ones.
  bool relaxedArithmetic = false;
  std::uint32_t loopBudget = 0;  ///< see LOOP_BUDGET
};

/// What the compiler is told besides the program's text.
std::string buildOptions(const KernelProgram& program, const CompileTarget& target);

/// All that decides on the code that comes out, but for the device.
std::string programKey(const KernelProgram& program, const CompileTarget& target);

/// Whether what one process compiles on the device serves the next: so does PoCL, unless it is told not to.
bool keepsCompiled(const DeviceInfo& device);
/// Whether all of them were compiled there before, as far as is known (wasCompiled).
bool wereCompiled(const DeviceInfo& device, const std::vector<KernelProgram>& programs,
                  const CompileTarget& target);

/// Compiles down to the device's code, which many platforms, PoCL among them, put off to a kernel's first
/// launch. Throws ClError with the build log.
cl::Program compileProgram(Compute& compute, const KernelProgram& program, const CompileTarget& target);

/// Called once if compiling the first of the programs takes a while: starts on all others elsewhere, and
/// returns what waits for that to end. Empty: nobody does.
using CompileBeside = std::function<std::function<void()>()>;

/// compileProgram for each. `beside` is asked only where what another process compiled is found again on
/// disk: PoCL compiles one kernel at a time in each process, whatever the threads.
std::vector<cl::Program> compilePrograms(Compute& compute, const std::vector<KernelProgram>& programs,
                                         const CompileTarget& target, const CompileBeside& beside = {});

/// A device that stays open from one render to the next, and the programs compiled on it: even those found on
/// disk take 0.2 s to load.
struct OpenDevice {
  Compute compute;
  KeptPrograms programs = KeptPrograms();  ///< by all that decides on their code
};

/// Those that are kept; empty where one is missing.
std::vector<cl::Program> keptPrograms(KeptPrograms& kept, const std::vector<KernelProgram>& programs,
                                      const CompileTarget& target);

/// compilePrograms for those that are not kept.
std::vector<cl::Program> compileOnce(OpenDevice& device, const std::vector<KernelProgram>& programs,
                                     const CompileTarget& target, const CompileBeside& beside = {});

}  // namespace whittle
