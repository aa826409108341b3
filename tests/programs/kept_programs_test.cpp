// Programs that stay compiled: as many as there is room for, those used last.
#include "programs/kept_programs.h"

#include <gtest/gtest.h>

#include "programs/kernel_programs.h"
#include "support/test_device.h"

namespace whittle::test {
namespace {

TEST(KeptPrograms, TheOneUsedLongestAgoMakesRoom) {
  KeptPrograms kept(3);
  for (const char* key : {"a", "b", "c"}) kept.keep(key, {});
  ASSERT_TRUE(kept.find("a"));
  kept.keep("d", {});
  EXPECT_EQ(kept.size(), 3U);
  EXPECT_EQ(kept.total(), 4U);
  EXPECT_FALSE(kept.find("b")) << "used longest ago";
  for (const char* key : {"a", "c", "d"}) EXPECT_TRUE(kept.find(key)) << key;
}

TEST(KeptPrograms, AThousandKeysAreNoMoreThanItsRoom) {
  KeptPrograms kept;
  std::size_t most = 0;
  for (int i = 0; i < 1000; ++i) {
    kept.keep(fmt::format("{}", i), {});
    most = std::max(most, kept.size());
  }
  EXPECT_LT(most, 100U);
  EXPECT_TRUE(kept.find("999"));
  EXPECT_FALSE(kept.find("0"));
}

/// Room for one alone: the others of the same render drop out while it holds them.
TEST(KeptPrograms, WhatDropsOutIsStillGoodForWhoeverHoldsIt) {
  const std::vector<KernelProgram> programs{
      {"first", "__kernel void one(__global int* a) { a[0] = 1; }", 0, {}, false},
      {"second", "__kernel void two(__global int* a) { a[0] = 2; }", 0, {}, false}};
  OpenDevice device{openTestDevice(), KeptPrograms(1)};
  const CompileTarget target{64, 1, false};
  const auto held = compileOnce(device, programs, target);
  ASSERT_EQ(held.size(), 2U);
  EXPECT_EQ(device.programs.size(), 1U);
  const auto again = compileOnce(device, programs, target);
  EXPECT_EQ(device.programs.total(), 3U) << "the second was still there";
  const Buffer out = device.compute.allocate("out", sizeof(int));
  for (const auto& [program, name, expected] :
       {std::tuple(held[0], "one", 1), std::tuple(held[1], "two", 2), std::tuple(again[1], "two", 2)}) {
    cl::Kernel kernel(program, name);
    kernel.setArg(0, out.handle);
    device.compute.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(1), cl::NDRange(1));
    int found = 0;
    device.compute.read(out, 0, sizeof(found), &found);
    EXPECT_EQ(found, expected) << name;
  }
}

}  // namespace
}  // namespace whittle::test
