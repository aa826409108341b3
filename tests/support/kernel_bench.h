// A program of kernel files plus test kernels, on the device under test, run as the renderer runs its stages.
// The test kernels are appended to the files' text, so that they call the functions that the renderer calls.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

#include "cl/kernel_source.h"
#include "support/test_device.h"
#include "wavefront/stage_runner.h"

namespace whittle::test {

inline constexpr std::uint64_t kAllFeatures = 0xffffffffffffffffU;
inline constexpr int kWorkGroup = 16;  ///< the renderer's on a CPU; not a divisor of most counts used here

inline std::string buildOptions(std::uint64_t features, int compactChunk) {
  return fmt::format("-cl-std=CL1.2 -D SCENE_FEATURES=0x{:x} -D COMPACT_CHUNK={}", features, compactChunk);
}

/// Launches a test's own kernel over `items` work items, arguments in its order.
template <typename... Args>
void launchTestKernel(Compute& compute, const cl::Program& program, const char* name, std::uint32_t items,
                      const Args&... args) {
  cl::Kernel kernel(program, name);
  KernelArguments arguments(kernel, name);
  (arguments.add(args), ...);
  const cl::NDRange global((items + kWorkGroup - 1) / kWorkGroup * kWorkGroup);
  clTry(name, [&] {
    compute.queue().enqueueNDRangeKernel(kernel, cl::NullRange, global, cl::NDRange(kWorkGroup));
  });
}

class KernelBench {
 public:
  explicit KernelBench(const std::vector<std::string>& files, const std::string& testKernels = {},
                       std::uint64_t features = kAllFeatures, int compactChunk = 1024)
      : compute(openTestDevice()),
        program(compute.build(
            assembleKernelSource(files, testKernelFolder()) + "#line 1 \"test kernels\"\n" + testKernels,
            buildOptions(features, compactChunk))),
        stages(compute, {program}, kWorkGroup,
               {SceneFeatures::ofBits(features).has(Feature::PACKETS),
                static_cast<std::uint32_t>(compactChunk)}) {}

  template <typename T>
  std::vector<T> read(const Buffer& buffer, std::size_t count) {
    std::vector<T> values(count);
    compute.read(buffer, 0, count * sizeof(T), values.data());
    return values;
  }
  /// Runs a test kernel of the form kernel(count, inputs…, out) and returns `perItem` values for each item.
  template <typename T, typename... Args>
  std::vector<T> map(const std::string& kernel, std::uint32_t count, std::size_t perItem,
                     const Args&... inputs) {
    const Buffer out = compute.allocate("out", count * perItem * sizeof(T));
    launchTestKernel(compute, program, kernel.c_str(), count, count, inputs..., out);
    return read<T>(out, count * perItem);
  }

  Compute compute;
  cl::Program program;
  StageRunner stages;
};

}  // namespace whittle::test
