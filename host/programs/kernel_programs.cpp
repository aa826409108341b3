// Programs by stage, and their compilation ahead of the first launch.
#include "programs/kernel_programs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <future>
#include <string_view>

#include "cl/compile_turn.h"
#include "cl/kernel_cache.h"
#include "cl/kernel_source.h"
#include "programs/referenced_features.h"
#include "wavefront/kernel_arguments.h"
#include "wavefront/stages.h"

namespace whittle {
namespace {

/// The programs; the one that takes longest to compile first. Which stages they hold: wavefront/stages.h.
struct Program {
  const char* name;
  bool mayRelax = false;  ///< see CompileTarget::relaxedArithmetic
};
constexpr std::array kPrograms{Program{"searches"}, Program{"shading", true}, Program{"queues"}};

/// Kernel files of a program, whatever of them will be launched.
std::vector<std::string> filesOf(std::string_view program) {
  std::vector<std::string> files;
  for (const Stage& stage : allStages())
    if (stage.facts.program == program &&
        std::find(files.begin(), files.end(), stage.facts.file) == files.end())
      files.emplace_back(stage.facts.file);
  return files;
}

/// A launch without rays, which does nothing.
void launchIdle(Compute& compute, const cl::Program& program, const std::string& name, int workGroup) {
  clTry("compiling kernel '" + name + "' for " + compute.device().name, [&] {
    cl::Kernel kernel(program, name.c_str());
    forEachStage([&]<typename S>(const S& nothing) {
      if (name == S::stage.facts.name) setArguments(kernel, nothing);
    });
    const cl::NDRange items(static_cast<std::size_t>(workGroup));
    compute.queue().enqueueNDRangeKernel(kernel, cl::NullRange, items, items);
    compute.queue().finish();
  });
}

/// The key with the device, for what lies on disk.
std::string keyOnDisk(const DeviceInfo& device, const KernelProgram& program, const CompileTarget& target) {
  return fmt::format("{}\n{}\n{}\n{}", device.name, device.version, device.driver,
                     programKey(program, target));
}

}  // namespace

std::string programKey(const KernelProgram& program, const CompileTarget& target) {
  return fmt::format("{}\n{}\n{}\n{}", target.workGroup, buildOptions(program, target),
                     fmt::join(program.kernels, " "), program.source);
}

bool keepsCompiled(const DeviceInfo& device) {
  const char* const cache = std::getenv("POCL_KERNEL_CACHE");
  return device.platform.find("Portable Computing Language") != std::string::npos &&
         !(cache && std::string(cache) == "0");
}

bool wereCompiled(const DeviceInfo& device, const std::vector<KernelProgram>& programs,
                  const CompileTarget& target) {
  return keepsCompiled(device) && std::all_of(programs.begin(), programs.end(), [&](const KernelProgram& p) {
           return wasCompiled(keyOnDisk(device, p, target));
         });
}

std::vector<KernelProgram> kernelPrograms(const SceneFeatures& features,
                                          const std::vector<std::string>& stages,
                                          const std::optional<std::filesystem::path>& folder) {
  std::vector<KernelProgram> programs;
  for (const auto& [name, mayRelax] : kPrograms) {
    KernelProgram program;
    for (const Stage& stage : allStages())
      if (stage.facts.program == std::string_view(name) &&
          std::find(stages.begin(), stages.end(), stage.facts.name) != stages.end())
        program.kernels.emplace_back(stage.facts.name);
    if (program.kernels.empty()) continue;
    program.name = name;
    program.mayRelax = mayRelax;
    program.source = assembleKernelSource(filesOf(name), folder);
    program.features = referencedFeatures(program.source, features.bits());
    programs.push_back(std::move(program));
  }
  return programs;
}

std::string buildOptions(const KernelProgram& program, const CompileTarget& target) {
  return fmt::format("-cl-std=CL1.2 -D SCENE_FEATURES=0x{:x} -D COMPACT_CHUNK={}{}{}", program.features,
                     target.compactChunk,
                     target.loopBudget > 0 ? fmt::format(" -D LOOP_BUDGET={}", target.loopBudget) : "",
                     target.relaxedArithmetic && program.mayRelax ? " -cl-fast-relaxed-math" : "");
}

cl::Program compileProgram(Compute& compute, const KernelProgram& program, const CompileTarget& target) {
  std::optional<CompileTurn> turn;
  const bool keeps = keepsCompiled(compute.device());
  const std::string key = keyOnDisk(compute.device(), program, target);
  if (keeps) turn.emplace(key);
  cl::Program built = compute.build(program.source, buildOptions(program, target),
                                    fmt::format("{} ({})", program.name, fmt::join(program.kernels, ", ")));
  for (const auto& name : program.kernels) launchIdle(compute, built, name, target.workGroup);
  if (turn) turn->done();
  if (keeps) noteCompiled(key);
  return built;
}

std::vector<cl::Program> compilePrograms(Compute& compute, const std::vector<KernelProgram>& programs,
                                         const CompileTarget& target, const CompileBeside& beside) {
  std::vector<cl::Program> built;
  if (programs.empty()) return built;
  auto first =
      std::async(std::launch::async, [&] { return compileProgram(compute, programs.front(), target); });
  std::function<void()> waitForOthers;
  // Found on disk it takes some 50 ms; a process more would then only be in the way.
  constexpr auto kFoundOnDisk = std::chrono::milliseconds(200);
  if (beside && programs.size() > 1 && keepsCompiled(compute.device()) &&
      first.wait_for(kFoundOnDisk) == std::future_status::timeout)
    waitForOthers = beside();
  built.push_back(first.get());
  if (waitForOthers) waitForOthers();
  for (std::size_t i = 1; i < programs.size(); ++i)
    built.push_back(compileProgram(compute, programs[i], target));
  return built;
}

std::vector<cl::Program> keptPrograms(KeptPrograms& kept, const std::vector<KernelProgram>& programs,
                                      const CompileTarget& target) {
  std::vector<cl::Program> all;
  for (const KernelProgram& program : programs) {
    const cl::Program* const found = kept.find(programKey(program, target));
    if (!found) return {};
    all.push_back(*found);
  }
  return all;
}

std::vector<cl::Program> compileOnce(OpenDevice& device, const std::vector<KernelProgram>& programs,
                                     const CompileTarget& target, const CompileBeside& beside) {
  std::vector<cl::Program> all(programs.size());
  std::vector<std::size_t> missing;
  std::vector<KernelProgram> missingPrograms;
  for (std::size_t i = 0; i < programs.size(); ++i) {
    if (const cl::Program* const kept = device.programs.find(programKey(programs[i], target))) {
      all[i] = *kept;
      continue;
    }
    missing.push_back(i);
    missingPrograms.push_back(programs[i]);
  }
  const auto built = compilePrograms(device.compute, missingPrograms, target, beside);
  for (std::size_t k = 0; k < built.size(); ++k) {
    all[missing[k]] = built[k];
    device.programs.keep(programKey(missingPrograms[k], target), built[k]);
  }
  return all;
}

}  // namespace whittle
