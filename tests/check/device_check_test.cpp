// `whittle check` finds nothing wrong on a device that draws right, and has a line that is wrong where an
// answer differs or a call fails.
#include "check/device_check.h"

#include <gtest/gtest.h>

#include "support/test_device.h"

namespace whittle {
namespace {

TEST(DeviceCheck, TheDeviceUnderTestIsRight) {
  std::vector<std::string> names;
  const CheckReport report =
      checkDevice(test::testDevice(), [&](const std::string& name) { names.push_back(name); });
  for (const CheckLine& line : report.lines)
    EXPECT_NE(line.finding.verdict, Verdict::Wrong) << line.finding.name << ": " << line.finding.seen;
  EXPECT_TRUE(report.isRight());
  EXPECT_EQ(names.size(), 7U) << "every part was run";
  EXPECT_GE(report.lines.size(), 26U) << "sixteen of the driver, ten of kernels and pictures";
}

TEST(DeviceCheck, WhatDiffersIsWrongAndCounted) {
  const Finding right = comparedFinding("sums", 0, 12, "the host", "off");
  EXPECT_EQ(right.verdict, Verdict::Right);
  EXPECT_EQ(right.consequence, "");
  const Finding wrong = comparedFinding("sums", 3, 12, "the host", "off");
  EXPECT_EQ(wrong.verdict, Verdict::Wrong);
  EXPECT_EQ(wrong.seen, "3 of 12 not as the host");
  EXPECT_EQ(wrong.consequence, "off");
  CheckReport report;
  report.lines.push_back({right, 0.0});
  EXPECT_TRUE(report.isRight());
  report.lines.push_back({{"loops", Verdict::WorkedRound, "", ""}, 0.0});
  EXPECT_TRUE(report.isRight()) << "what we do about it is in force";
  report.lines.push_back({wrong, 0.0});
  EXPECT_FALSE(report.isRight());
}

/// A device that cannot allocate what a check needs is not passed over.
TEST(DeviceCheck, ACheckThatFailsIsALineThatIsWrong) {
  DeviceInfo device = test::testDevice();
  device.largestBuffer = 64;  // as though the driver had said so
  const CheckReport report = checkDevice(device, {});
  EXPECT_FALSE(report.isRight());
  for (const CheckLine& line : report.lines) EXPECT_NE(line.finding.seen, "") << line.finding.name;
}

}  // namespace
}  // namespace whittle
