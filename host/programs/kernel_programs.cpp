// Programs by stage, and their compilation ahead of the first launch.
#include "programs/kernel_programs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <future>
#include <map>

#include "cl/kernel_source.h"
#include "kernels/shared/layout.h"
#include "programs/referenced_features.h"

namespace whittle {
namespace {

struct Part {
  const char* name;
  std::vector<std::string> files;
  std::vector<std::string> kernels;
  bool mayRelax = false;  ///< see CompileTarget::relaxedArithmetic
};

/// Every stage in one of them; the one that takes longest to compile first.
const std::vector<Part>& parts() {
  static const std::vector<Part> all{
      {"searches", {"intersect.cl", "occlude.cl"}, {"intersect", "occlude"}},
      {"shading", {"shade.cl"}, {"shade", "shade_light"}, true},
      {"queues",
       {"raygen.cl", "compact.cl", "accumulate.cl", "film.cl"},
       {"raygen", "compact_count", "scan_chunks", "compact_shadow", "compact_impulse", "find_long_runs",
        "accumulate", "film"}},
  };
  return all;
}

/// Bytes of a kernel argument passed by value, by its type; 0: unknown.
std::size_t valueBytes(const std::string& type) {
  static const std::map<std::string, std::size_t> sizes{{"uint", sizeof(cl_uint)},
                                                        {"Batch", sizeof(device::Batch)},
                                                        {"RenderConstants", sizeof(device::RenderConstants)},
                                                        {"DeviceCamera", sizeof(device::DeviceCamera)}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

/// Null buffers, zero counts, structs of zeros: a launch with these does nothing. False: some argument is of
/// another kind.
bool setZeroArguments(cl::Kernel& kernel) {
  static const std::array<char, 256> zeros{};
  const auto count = kernel.getInfo<CL_KERNEL_NUM_ARGS>();
  for (cl_uint i = 0; i < count; ++i) {
    const bool isBuffer =
        kernel.getArgInfo<CL_KERNEL_ARG_ADDRESS_QUALIFIER>(i) == CL_KERNEL_ARG_ADDRESS_GLOBAL;
    const std::size_t bytes =
        isBuffer ? sizeof(cl_mem) : valueBytes(kernel.getArgInfo<CL_KERNEL_ARG_TYPE_NAME>(i));
    if (bytes == 0 || clSetKernelArg(kernel(), i, bytes, isBuffer ? nullptr : zeros.data()) != CL_SUCCESS)
      return false;
  }
  return true;
}

/// Whether what one process compiled serves the next.
bool sharesWhatItCompiled(const DeviceInfo& device) {
  const char* const cache = std::getenv("POCL_KERNEL_CACHE");
  return device.platform.find("Portable Computing Language") != std::string::npos &&
         !(cache && std::string(cache) == "0");
}

}  // namespace

std::vector<KernelProgram> kernelPrograms(const SceneFeatures& features,
                                          const std::vector<std::string>& stages,
                                          const std::optional<std::filesystem::path>& folder) {
  std::vector<KernelProgram> programs;
  for (const Part& part : parts()) {
    KernelProgram program;
    for (const auto& stage : stages)
      if (std::find(part.kernels.begin(), part.kernels.end(), stage) != part.kernels.end())
        program.kernels.push_back(stage);
    if (program.kernels.empty()) continue;
    program.name = part.name;
    program.mayRelax = part.mayRelax;
    program.source = assembleKernelSource(part.files, folder);
    program.features = referencedFeatures(program.source, features.bits());
    programs.push_back(std::move(program));
  }
  return programs;
}

std::string buildOptions(const KernelProgram& program, const CompileTarget& target) {
  return fmt::format("-cl-std=CL1.2 -cl-kernel-arg-info -D SCENE_FEATURES=0x{:x} -D COMPACT_CHUNK={}{}",
                     program.features, target.compactChunk,
                     target.relaxedArithmetic && program.mayRelax ? " -cl-fast-relaxed-math" : "");
}

cl::Program compileProgram(Compute& compute, const KernelProgram& program, const CompileTarget& target) {
  cl::Program built = compute.build(program.source, buildOptions(program, target),
                                    fmt::format("{} ({})", program.name, fmt::join(program.kernels, ", ")));
  for (const auto& name : program.kernels)
    clTry("compiling kernel '" + name + "' for " + compute.device().name, [&] {
      cl::Kernel kernel(built, name.c_str());
      if (!setZeroArguments(kernel)) return;
      const cl::NDRange items(static_cast<std::size_t>(target.workGroup));
      compute.queue().enqueueNDRangeKernel(kernel, cl::NullRange, items, items);
      compute.queue().finish();
    });
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
  if (beside && programs.size() > 1 && sharesWhatItCompiled(compute.device()) &&
      first.wait_for(kFoundOnDisk) == std::future_status::timeout)
    waitForOthers = beside();
  built.push_back(first.get());
  if (waitForOthers) waitForOthers();
  for (std::size_t i = 1; i < programs.size(); ++i)
    built.push_back(compileProgram(compute, programs[i], target));
  return built;
}

std::vector<cl::Program> compileOnce(OpenDevice& device, const std::vector<KernelProgram>& programs,
                                     const CompileTarget& target, const CompileBeside& beside) {
  std::vector<std::string> keys, newKeys;
  std::vector<KernelProgram> newPrograms;
  for (const KernelProgram& p : programs) {
    keys.push_back(fmt::format("{}\n{}\n{}\n{}", target.workGroup, buildOptions(p, target),
                               fmt::join(p.kernels, " "), p.source));
    if (device.programs.contains(keys.back())) continue;
    newKeys.push_back(keys.back());
    newPrograms.push_back(p);
  }
  const auto built = compilePrograms(device.compute, newPrograms, target, beside);
  for (std::size_t i = 0; i < built.size(); ++i) device.programs.emplace(newKeys[i], built[i]);
  std::vector<cl::Program> all;
  for (const std::string& key : keys) all.push_back(device.programs.at(key));
  return all;
}

}  // namespace whittle
