// See program_choice.h.
#include "render/program_choice.h"

#include "analysis/general_features.h"
#include "cl/device_facts.h"
#include "cl/kernel_cache.h"
#include "programs/general_programs.h"
#include "scene/input_error.h"
#include "wavefront/stages.h"

namespace whittle {
namespace {

ProgramCache ownCache() { return ProgramCache(programCacheFolder()); }

/// Whether the scene's own programs need no compiler.
bool needsNoCompiler(const DeviceInfo& device, KeptPrograms& kept, const ProgramChoice& choice) {
  return !keptPrograms(kept, choice.own, choice.target).empty() ||
         wereCompiled(device, choice.own, choice.target);
}

}  // namespace

ProgramChoice choosePrograms(const DeviceInfo& device, KeptPrograms& kept, const Settings& settings,
                             const Decisions& decisions, const RenderHooks& hooks) {
  const auto stages = plannedStages({decisions.features, decisions.lights.size(),
                                     mostHits(decisions.features, settings), decisions.hasLateLight});
  ProgramChoice choice;
  choice.target = {decisions.compactChunk, decisions.workGroup, settings.relaxedArithmetic,
                   loopBudget(device)};
  choice.own = kernelPrograms(decisions.features, stages, hooks.kernelFolder);
  choice.job = {device.index, decisions.features.bits(), choice.target, hooks.kernelFolder, stages};
  if (hooks.tier == Tier::Specialised) return choice;
  const auto general = generalProgramFor(decisions.features, settings);
  // Whoever looks into the queues knows the planes of the scene's own features.
  if (!general || settings.bounceAov) {
    if (hooks.tier == Tier::General)
      throw InputError("--tier: no general program does what the other options ask for; take auto");
    return choice;
  }
  choice.generalName = general->name;
  choice.isOwnThere = hooks.tier == Tier::Auto && needsNoCompiler(device, kept, choice);
  if (choice.isOwnThere) return choice;
  auto kernels = generalKernels(*general, hooks.kernelFolder);
  if (hooks.tier == Tier::Auto && keptPrograms(kept, kernels, choice.target).empty() &&
      !haveBinaries(ownCache(), device, kernels, choice.target))
    return choice;
  choice.general = std::move(kernels);
  choice.mayCompileBeside = keepsCompiled(device) && !hooks.compiler.empty();
  choice.bufferFeatures = generalBufferFeatures(*general);
  return choice;
}

StartingPrograms startPrograms(OpenDevice& device, const ProgramChoice& choice, const RenderHooks& hooks,
                               std::chrono::steady_clock::time_point start) {
  StartingPrograms started;
  if (!choice.general.empty()) {
    started.programs = loadBinaries(ownCache(), device, choice.general, choice.target);
    if (started.programs.empty() && hooks.tier == Tier::General)
      started.programs = compileOnce(device, choice.general, choice.target);
  }
  started.areGeneral = !started.programs.empty();
  if (!started.areGeneral) {
    CompileBeside beside;
    if (!hooks.compiler.empty()) beside = [&] { return startCompilerProcess(hooks.compiler, choice.job); };
    started.programs = compileOnce(device, choice.own, choice.target, beside);
  }
  started.seconds = PhaseLog::secondsSince(start);
  if (hooks.trace)
    hooks.trace->phase(started.areGeneral ? "load general kernels" : "compile kernels", start,
                       Trace::Track::Compiler);
  return started;
}

}  // namespace whittle
