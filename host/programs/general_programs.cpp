// PoCL 3.1 puts into a binary what it has compiled by then: each kernel for those work-group sizes that it
// was launched with, and once for any size, which it does not take while it can compile. So each kernel is
// launched before (compileProgram) with the size of all launches; loaded with an empty $POCL_CACHE_DIR the
// program then compiles nothing. Without those launches every first one compiles as though there were no
// binary.
#include "programs/general_programs.h"

#include <fmt/format.h>

#include <algorithm>

#include "cl/compile_turn.h"
#include "cl/device_facts.h"
#include "wavefront/stage_runner.h"
#include "wavefront/stages.h"

namespace whittle {
namespace {

/// With all that decides on a binary; the cache's own format has its version in its files.
std::string cacheKey(const DeviceInfo& device, const KernelProgram& program, const CompileTarget& target) {
  return fmt::format("{}\n{}\n{}\n{}\n{}", device.platform, device.name, device.version, device.driver,
                     programKey(program, target));
}

struct Wanted {
  KernelProgram program;
  std::string what;
};

/// Searches of both general programs are mostly the same.
std::vector<Wanted> wantedFor(const DeviceInfo& device, const CompileTarget& target) {
  std::vector<Wanted> all;
  std::vector<std::string> keys;
  for (const GeneralProgram& general : generalPrograms(device.suitsPackets()))
    for (KernelProgram& program : generalKernels(general)) {
      const std::string key = programKey(program, target);
      if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
      keys.push_back(key);
      std::string what = fmt::format("{}, {}, for {}", program.name, general.name, device.name);
      all.push_back({std::move(program), std::move(what)});
    }
  return all;
}

}  // namespace

std::vector<KernelProgram> generalKernels(const GeneralProgram& program,
                                          const std::optional<std::filesystem::path>& folder) {
  std::vector<std::string> stages;
  for (const Stage& stage : allStages()) stages.emplace_back(stage.facts.name);
  return kernelPrograms(SceneFeatures::ofBits(program.features), stages, folder);
}

CompileTarget usualTarget(const DeviceInfo& device) {
  const std::uint64_t packets = device.suitsPackets() ? bitOf(Feature::PACKETS) : 0;
  return {defaultCompactChunk(device), defaultWorkGroup(SceneFeatures::ofBits(packets)), false,
          loopBudget(device)};
}

bool haveBinaries(const ProgramCache& cache, const DeviceInfo& device,
                  const std::vector<KernelProgram>& programs, const CompileTarget& target) {
  return std::all_of(programs.begin(), programs.end(),
                     [&](const KernelProgram& p) { return cache.has(cacheKey(device, p, target)); });
}

std::vector<cl::Program> loadBinaries(const ProgramCache& cache, OpenDevice& device,
                                      const std::vector<KernelProgram>& programs,
                                      const CompileTarget& target) {
  std::vector<cl::Program> all;
  for (const KernelProgram& program : programs) {
    const std::string name = programKey(program, target);
    if (const cl::Program* const kept = device.programs.find(name)) {
      all.push_back(*kept);
      continue;
    }
    const std::string key = cacheKey(device.compute.device(), program, target);
    const auto binary = cache.load(key);
    const auto loaded = binary ? device.compute.fromBinary(*binary) : std::nullopt;
    if (!loaded) {
      cache.remove(key);
      return {};
    }
    device.programs.keep(name, *loaded);
    all.push_back(*loaded);
  }
  return all;
}

void warmCache(const ProgramCache& cache, Compute& compute, bool isBackwards,
               const std::function<void(const WarmingStep&)>& step) {
  const DeviceInfo& device = compute.device();
  if (!keepsCompiled(device))
    throw ClError(
        fmt::format("{}: its driver ({}) gives no machine code to keep; scenes compile their own "
                    "programs there",
                    device.name, device.platform));
  const CompileTarget target = usualTarget(device);
  std::vector<Wanted> wanted = wantedFor(device, target);
  if (isBackwards) std::reverse(wanted.begin(), wanted.end());
  std::error_code error;
  std::filesystem::create_directories(cache.folder(), error);
  for (const auto& [program, what] : wanted) {
    const std::string key = cacheKey(device, program, target);
    step({what, cache.has(key)});
    if (cache.has(key)) continue;
    CompileTurn turn(key, cache.folder());
    if (cache.has(key)) continue;  // by now
    const cl::Program built = compileProgram(compute, program, target);
    cache.store(key, what, compute.binaryOf(built));
    turn.done();
  }
}

}  // namespace whittle
