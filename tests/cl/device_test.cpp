// The device list never throws; a device is chosen by index, part of a name, or kind; errors have names.
#include "cl/device.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#include "cl/error.h"
#include "support/temporary_sources.h"
#include "support/text.h"

namespace whittle {
namespace {

DeviceInfo device(int index, const std::string& platform, const std::string& name, const std::string& kind,
                  bool usable = true) {
  DeviceInfo info;
  info.index = index;
  info.platform = platform;
  info.name = name;
  info.kind = kind;
  info.usable = usable;
  if (!usable) info.reason = "it has no kernel compiler";
  return info;
}

DeviceList someDevices() {
  DeviceList list;
  list.devices = {
      device(0, "Alpha Platform", "Old Card", "gpu", false), device(1, "Alpha Platform", "New Card", "gpu"),
      device(2, "Beta Platform", "Generic Processor", "cpu"), device(3, "Gamma", "Second Processor", "cpu")};
  return list;
}

std::string refusal(const DeviceList& list, const std::string& selector) {
  try {
    return "accepted " + selectDevice(list, selector).name;
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
}

using test::contains;

TEST(SelectDevice, ByIndexNameKindOrNothing) {
  const DeviceList list = someDevices();
  EXPECT_EQ(selectDevice(list, "1").index, 1);
  EXPECT_EQ(selectDevice(list, "3").index, 3);
  EXPECT_EQ(selectDevice(list, "second").index, 3) << "part of a name, any case";
  EXPECT_EQ(selectDevice(list, "BETA").index, 2) << "part of a platform's name";
  EXPECT_EQ(selectDevice(list, "card").index, 1) << "the first usable one that matches";
  EXPECT_EQ(selectDevice(list, "gpu").index, 1);
  EXPECT_EQ(selectDevice(list, "cpu").index, 2);
  EXPECT_EQ(selectDevice(list, "").index, 2) << "a CPU first";
  DeviceList gpus;
  gpus.devices = {list.devices[0], list.devices[1]};
  EXPECT_EQ(selectDevice(gpus, "").index, 1) << "without a CPU the first usable one";
}

TEST(DeviceInfo, PacketsSuitProcessorsWithVectors) {
  DeviceInfo info = device(0, "Beta Platform", "Generic Processor", "cpu");
  EXPECT_FALSE(info.suitsPackets()) << "vectors of one float";
  info.floatLanes = 4;
  EXPECT_TRUE(info.suitsPackets());
  info.kind = "gpu";
  EXPECT_FALSE(info.suitsPackets());
}

TEST(SelectDevice, RefusalsSayWhy) {
  const DeviceList list = someDevices();
  for (const char* selector : {"4", "99999999999999999999", "-1", "toaster", "accelerator"}) {
    const std::string message = refusal(list, selector);
    EXPECT_TRUE(contains(message, "--device") && contains(message, selector) &&
                contains(message, "whittle devices"))
        << message;
    EXPECT_FALSE(contains(message, "\n"));
  }
  EXPECT_TRUE(contains(refusal(list, "old"), "it has no kernel compiler")) << refusal(list, "old");
  EXPECT_TRUE(contains(refusal(list, "0"), "Old Card")) << refusal(list, "0");
  EXPECT_TRUE(contains(refusal({}, ""), "no OpenCL device")) << refusal({}, "");
  EXPECT_TRUE(contains(refusal({}, "0"), "'0'")) << refusal({}, "0");
}

TEST(ListDevices, TellsTheTruthAboutThisMachine) {
  const DeviceList list = listDevices();
  ASSERT_FALSE(list.devices.empty()) << "the tests need an OpenCL device, for instance PoCL";
  for (std::size_t i = 0; i < list.devices.size(); ++i) {
    const DeviceInfo& d = list.devices[i];
    EXPECT_EQ(d.index, static_cast<int>(i));
    EXPECT_EQ(d.usable, d.reason.empty());
    EXPECT_FALSE(d.name.empty() || d.platform.empty() || d.kind.empty());
    EXPECT_GT(d.computeUnits, 0U);
    EXPECT_GT(d.largestBuffer, 0U);
    EXPECT_LE(d.largestBuffer, d.globalMemory);
  }
  EXPECT_TRUE(selectDevice(list, "").usable);
}

/// Lists devices as a fresh process sees them with the drivers of `folder`; exit status 0 if that
/// went as promised.
[[noreturn]] void listWithDriversOf(const std::filesystem::path& folder) {
  setenv("OCL_ICD_VENDORS", folder.c_str(), 1);
  unsetenv("OCL_ICD_FILENAMES");
  int status = 1;
  try {
    const DeviceList list = listDevices();
    for (const auto& problem : list.problems) std::cerr << problem << '\n';
    if (list.devices.empty() && !list.problems.empty()) status = 0;
    std::cerr << refusal(list, "") << '\n';
  } catch (const std::exception& e) {
    std::cerr << "thrown: " << e.what() << '\n';
  }
  std::_Exit(status);
}

TEST(ListDevicesDeathTest, NoDriverAtAllIsAProblemNotAnException) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a new process: the loader reads its folder once
  const test::TemporarySources empty;
  EXPECT_EXIT(listWithDriversOf(empty.folder()), testing::ExitedWithCode(0),
              "no OpenCL platform.*no OpenCL device");
}

TEST(ListDevicesDeathTest, BrokenDriversAreProblemsNotExceptions) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const test::TemporarySources broken;
  broken.write("absent.icd", "/nonexistent/libnothing.so\n");
  broken.write("not_a_library.icd", (broken.folder() / "text.so").string() + "\n");
  broken.write("text.so", "this is no library\n");
  broken.write("empty.icd", "");
  EXPECT_EXIT(listWithDriversOf(broken.folder()), testing::ExitedWithCode(0), "no OpenCL platform");
}

TEST(ClErrorName, NamesAndNumbers) {
  EXPECT_EQ(clErrorName(CL_OUT_OF_RESOURCES), "CL_OUT_OF_RESOURCES (-5)");
  EXPECT_EQ(clErrorName(CL_INVALID_KERNEL_ARGS), "CL_INVALID_KERNEL_ARGS (-52)");
  EXPECT_EQ(clErrorName(CL_INVALID_GLOBAL_WORK_SIZE), "CL_INVALID_GLOBAL_WORK_SIZE (-63)");
  EXPECT_EQ(clErrorName(-1001), "CL_PLATFORM_NOT_FOUND_KHR (-1001)");
  EXPECT_EQ(clErrorName(-9999), "error -9999");
}

TEST(ClTry, SaysWhatWasBeingDoneAndPassesTheRestThrough) {
  try {
    clTry("doing something", []() -> int { throw cl::Error(CL_INVALID_VALUE, "clSomeCall"); });
    FAIL() << "nothing was thrown";
  } catch (const ClError& e) {
    EXPECT_EQ(std::string(e.what()), "doing something: clSomeCall failed with CL_INVALID_VALUE (-30)");
  }
  EXPECT_THROW(clTry("x", []() -> int { throw std::logic_error("mine"); }), std::logic_error);
  EXPECT_EQ(clTry("x", [] { return 7; }), 7);
}

}  // namespace
}  // namespace whittle
