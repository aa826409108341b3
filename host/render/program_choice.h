// What a render's kernels come from: the scene's own programs, or general ones where those would have to be
// waited for.
#pragma once

#include <chrono>
#include <vector>

#include "programs/compiler_process.h"
#include "programs/kernel_programs.h"
#include "render/preparation.h"
#include "render/renderer.h"

namespace whittle {

struct ProgramChoice {
  std::vector<KernelProgram> own, general;  ///< the scene starts on `general` unless it is empty
  std::string generalName;                  ///< of the one that could draw it; empty: none, or nobody asked
  bool isOwnThere = false;                  ///< compiled before; looked for with Tier::Auto
  CompileTarget target;
  CompilerJob job;                   ///< that compiles its own, in another process
  bool mayCompileBeside = false;     ///< another process can, and this one finds what it made
  std::uint64_t bufferFeatures = 0;  ///< see Decisions::buffers; none for its own
};

/// By hooks.tier and what is compiled (`kept`: on the open device), or lies in the cache. Throws InputError
/// where Tier::General asks for what no general program can do.
ProgramChoice choosePrograms(const DeviceInfo& device, KeptPrograms& kept, const Settings& settings,
                             const Decisions& decisions, const RenderHooks& hooks);

struct StartingPrograms {
  std::vector<cl::Program> programs;
  bool areGeneral = false;
  double seconds = 0.0;  ///< since `start`
};

/// Loads or compiles them. General ones that turn out not to be in the cache are compiled for Tier::General;
/// else the scene waits for its own.
StartingPrograms startPrograms(OpenDevice& device, const ProgramChoice& choice, const RenderHooks& hooks,
                               std::chrono::steady_clock::time_point start);

}  // namespace whittle
