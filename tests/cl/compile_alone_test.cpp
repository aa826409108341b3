// Every kernel file compiles by itself with nothing defined, and with any one feature missing or alone: the
// switches of shared/features.h may be combined at will.
#include <gtest/gtest.h>

#include "cl/kernel_source.h"
#include "kernels/shared/features.h"
#include "support/test_device.h"

namespace whittle {
namespace {

std::string failureOf(Compute& compute, const std::string& source, const std::string& options) {
  try {
    compute.build(source, options + test::kNotOptimised);
  } catch (const std::exception& e) {
    return e.what();
  }
  return {};
}

TEST(CompileAlone, EveryKernelFile) {
  Compute compute = test::openTestDevice();
  int files = 0;
  for (const auto& [path, text] : embeddedKernelFiles()) {
    if (path.size() < 3 || path.substr(path.size() - 3) != ".cl") continue;
    EXPECT_EQ(failureOf(compute, assembleKernelSource({path}, test::testKernelFolder()), ""), "") << path;
    ++files;
  }
  EXPECT_GE(files, 7) << "at least the seven stages";
}

/// For any two features some set has the first without the second: bit k of the feature's number decides
/// membership in set k, and each set comes with its complement. Twelve builds in place of one for each pair,
/// of the searches and of the rest: the two count their lanes differently.
TEST(CompileAlone, AnyFeatureWithoutAnyOther) {
  Compute compute = test::openTestDevice();
  const std::string sources[] = {
      assembleKernelSource({"intersect.cl", "occlude.cl"}, test::testKernelFolder()),
      assembleKernelSource({"raygen.cl", "shade.cl", "compact.cl", "accumulate.cl", "film.cl"},
                           test::testKernelFolder())};
#define WHITTLE_BIT(name, bit, text) bit,
  const std::vector<int> features{WHITTLE_FEATURES(WHITTLE_BIT)};
#undef WHITTLE_BIT
  const auto failure = [&](std::uint64_t bits) {
    char options[64];
    std::snprintf(options, sizeof(options), "-cl-std=CL1.2 -D SCENE_FEATURES=0x%llx",
                  static_cast<unsigned long long>(bits));
    return failureOf(compute, sources[0], options) + failureOf(compute, sources[1], options);
  };
  EXPECT_EQ(failure(0), "") << "no feature";
  std::uint64_t all = 0;
  for (const int f : features) all |= std::uint64_t{1} << f;
  for (int k = 0; (features.size() - 1) >> k; ++k) {
    std::uint64_t set = 0;
    for (const int f : features) set |= std::uint64_t{(static_cast<unsigned>(f) >> k) & 1U} << f;
    EXPECT_EQ(failure(set), "") << "features with bit " << k << " of their number";
    EXPECT_EQ(failure(all & ~set), "") << "features without bit " << k << " of their number";
  }
}

}  // namespace
}  // namespace whittle
