// Test kernels of the code in lanes (kernels/lib/lanes.cl), run with one lane and with eight: the two must
// give the same bits. A lane of eight is given an entry of its own, so that what it reads is gathered.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <string_view>
#include <type_traits>

#include "kernels/shared/features.h"
#include "support/kernel_bench.h"

namespace whittle::test {

/// entries: those of work item i of n; the last one in the lanes beyond. put: a value for each of them.
inline constexpr const char* kLaneHelpers = R"(
#define FOR_ENTRIES(i, n) \
  const uint i = get_global_id(0); \
  if (i * LANES >= n) return; \
  const Natural entry = min((Natural)(i * LANES) + LANE_NUMBERS, (Natural)(n - 1u));
void put(__global float* out, Natural at, Real value) {
  uint place[LANES];
  float own[LANES];
  STORE(at, place);
  STORE(value, own);
  for (uint k = 0; k < LANES; ++k) out[place[k]] = own[k];
}
void put3(__global float* out, Natural at, Real3 value) {
  put(out, at, value.x);
  put(out, at + 1u, value.y);
  put(out, at + 2u, value.z);
}
)";

class LaneBench {
 public:
  LaneBench(const std::vector<std::string>& files, const std::string& testKernels)
      : one_(files, kLaneHelpers + testKernels, kAllFeatures & ~kPackets),
        eight_(files, kLaneHelpers + testKernels, kAllFeatures) {}

  /// As KernelBench::map, but that vectors among the inputs are uploaded. Fails where the widths differ
  /// in a bit.
  template <typename T, typename... Args>
  std::vector<T> map(const std::string& kernel, std::uint32_t count, std::size_t perItem,
                     const Args&... inputs) {
    const auto one = on<T>(one_, kernel, count, perItem, inputs...),
               eight = on<T>(eight_, kernel, count, perItem, inputs...);
    std::size_t different = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
      different +=
          std::memcmp(&one[i], &eight[i], sizeof(T)) != 0 && (one[i] == one[i] || eight[i] == eight[i]);
    EXPECT_EQ(different, 0U) << kernel << ": values that one lane and eight disagree about";
    return one;
  }

 private:
  static constexpr std::uint64_t kPackets = 1;  // what decides the number of lanes
  static_assert(
#define WHITTLE_PACKETS(name, number, text) (std::string_view(#name) == "PACKETS" && (number) == 0) ||
      WHITTLE_FEATURES(WHITTLE_PACKETS) false);
#undef WHITTLE_PACKETS

  template <typename T>
  struct IsVector : std::false_type {};
  template <typename T>
  struct IsVector<std::vector<T>> : std::true_type {};

  template <typename Arg>
  static auto given(KernelBench& bench, const Arg& input) {
    if constexpr (IsVector<Arg>::value) {
      return bench.compute.upload("input", input);
    } else {
      return input;
    }
  }
  template <typename T, typename... Args>
  static std::vector<T> on(KernelBench& bench, const std::string& kernel, std::uint32_t count,
                           std::size_t perItem, const Args&... inputs) {
    return bench.map<T>(kernel, count, perItem, given(bench, inputs)...);
  }

  KernelBench one_, eight_;
};

}  // namespace whittle::test
