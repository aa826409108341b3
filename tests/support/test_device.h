// The device that tests run on: the renderer's own choice, or what WHITTLE_TEST_DEVICE selects (as --device
// does), so that the same tests can be run on every device of a machine.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "cl/device.h"
#include "cl/program.h"

namespace whittle::test {

/// The device under test; throws with a message if there is none.
inline DeviceInfo testDevice() {
  const char* selector = std::getenv("WHITTLE_TEST_DEVICE");
  return selectDevice(listDevices(), selector ? selector : "");
}

inline Compute openTestDevice() { return Compute(testDevice()); }

/// Where the kernels under test come from; nothing: the binary.
inline std::optional<std::filesystem::path> testKernelFolder() {
  const char* folder = std::getenv("WHITTLE_TEST_KERNELS");
  return folder ? std::optional<std::filesystem::path>(folder) : std::nullopt;
}

/// Build option for programs that only have to compile.
inline constexpr const char* kNotOptimised = " -cl-opt-disable";

}  // namespace whittle::test
