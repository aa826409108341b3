// exp, sin and their like are never asked about a vector: PoCL's exp of a vector is not that of a float, and
// one lane of its sin changes with what the lanes beside it hold. Here they take a float alone, so that a
// vector does not compile.
#include <gtest/gtest.h>

#include "cl/kernel_source.h"
#include "support/test_device.h"

namespace whittle {
namespace {

std::string restricted() {
  std::string text;
  for (const char* name : {"exp",    "exp2",   "exp10", "expm1", "log",   "log2", "log10", "log1p", "sin",
                           "cos",    "tan",    "sinpi", "cospi", "tanpi", "asin", "acos",  "atan",  "asinpi",
                           "acospi", "atanpi", "sinh",  "cosh",  "tanh",  "cbrt", "erf",   "tgamma"})
    text += "float only_" + std::string(name) + "(float x) { return " + name + "(x); }\n#define " + name +
            " only_" + name + "\n";
  for (const char* name : {"pow", "powr", "atan2", "atan2pi", "hypot"})
    text += "float only_" + std::string(name) + "(float x, float y) { return " + name +
            "(x, y); }\n#define " + name + " only_" + name + "\n";
  return text;
}

std::string failureOf(Compute& compute, const std::string& source) {
  try {
    compute.build(restricted() + source, "-cl-std=CL1.2" + std::string(test::kNotOptimised));
  } catch (const std::exception& e) {
    return e.what();
  }
  return {};
}

TEST(ScalarFunctions, NoKernelAsksAboutAVector) {
  Compute compute = test::openTestDevice();
  for (const std::vector<std::string>& stages :
       {std::vector<std::string>{"intersect.cl", "occlude.cl"},
        {"raygen.cl", "shade.cl", "compact.cl", "accumulate.cl", "film.cl"}})
    EXPECT_EQ(failureOf(compute, assembleKernelSource(stages, test::testKernelFolder())), "")
        << stages.front();
}

TEST(ScalarFunctions, AVectorWouldBeSeen) {
  Compute compute = test::openTestDevice();
  const auto kernel = [](const std::string& value) {
    return "__kernel void k(__global float8* p) { p[0] = " + value + "; }\n";
  };
  EXPECT_EQ(failureOf(compute, kernel("(float8)(exp(p[0].s0))")), "");
  EXPECT_NE(failureOf(compute, kernel("exp(p[0])")), "");
  EXPECT_NE(failureOf(compute, kernel("atan2(p[0], p[1])")), "");
}

}  // namespace
}  // namespace whittle
