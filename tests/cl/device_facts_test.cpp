// What a driver does otherwise than it says is found by trying, and remembered for its version.
#include "cl/device_facts.h"

#include <gtest/gtest.h>

#include "cl/kernel_cache.h"
#include "support/temporary_sources.h"
#include "support/test_device.h"

namespace whittle {
namespace {

TEST(EventTimes, AreNoneWhereTheyDoNotGrowWithTheLaunches) {
  EXPECT_TRUE(areTimes(1, {{1000, 2000}, {2000, 9000}}));
  EXPECT_FALSE(areTimes(0, {{1000, 2000}, {2000, 9000}})) << "no resolution";
  EXPECT_FALSE(areTimes(1, {{2, 3}, {2, 3}})) << "what Mesa 22.3's rusticl has for every launch";
  EXPECT_FALSE(areTimes(1, {{1000, 1000}, {3000, 3000}})) << "launches that take no time";
  EXPECT_FALSE(areTimes(1, {{1000, 2000}, {1000, 2000}})) << "the same for both";
  EXPECT_FALSE(areTimes(1, {{5000, 9000}, {1000, 2000}})) << "backwards";
  EXPECT_FALSE(areTimes(1, {})) << "none at all";
}

TEST(DeviceProbe, TheDeviceUnderTestCanBeDrawnOn) {
  Compute compute = test::openTestDevice();
  const DeviceProbe probe = probeDevice(compute);
  for (const Finding& finding : probe.findings)
    EXPECT_NE(finding.verdict, Verdict::Wrong) << finding.name << ": " << finding.seen;
  const DeviceInfo& device = compute.device();
  const bool isRusticl22 = device.platform == "rusticl" && device.driver.starts_with("22.");
  EXPECT_EQ(probe.facts.loopLimit > 0, isRusticl22) << device.name << " " << device.driver;
  EXPECT_EQ(probe.facts.givesTimes, !isRusticl22) << device.name << " " << device.driver;
}

TEST(DeviceFacts, AreFoundOutOnceForADriver) {
  const test::TemporarySources folder;
  const char* const before = std::getenv("WHITTLE_CACHE_DIR");
  const std::string kept = before ? before : "";
  setenv("WHITTLE_CACHE_DIR", folder.folder().c_str(), 1);
  const auto files = [&] {
    std::size_t count = 0;
    for (const auto& file : std::filesystem::recursive_directory_iterator(folder.folder()))
      count += file.is_regular_file();
    return count;
  };
  Compute compute = test::openTestDevice();
  learnFacts(compute);
  EXPECT_EQ(files(), 1U);
  const DeviceFacts first = compute.device().facts;
  compute.know({12345, !first.givesTimes});
  learnFacts(compute);
  EXPECT_EQ(compute.device().facts.loopLimit, first.loopLimit) << "as remembered";
  EXPECT_EQ(compute.device().facts.givesTimes, first.givesTimes);
  forgetFacts();
  EXPECT_EQ(files(), 0U);
  before ? setenv("WHITTLE_CACHE_DIR", kept.c_str(), 1) : unsetenv("WHITTLE_CACHE_DIR");
}

TEST(LoopBudget, LeavesRoomForEightItemsAndAsMuchAgain) {
  DeviceInfo device;
  EXPECT_EQ(loopBudget(device), 0U) << "no limit";
  device.facts.loopLimit = 65535;
  EXPECT_LE(loopBudget(device) * 16, 65535U);
  EXPECT_GT(loopBudget(device), 4000U);
}

}  // namespace
}  // namespace whittle
