// Every OpenCL device of the machine, usable or not and why, and the choice of one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cl/opencl.h"

namespace whittle {

/// What was found out by trying (cl/device_facts.h); before that, as OpenCL has it.
struct DeviceFacts {
  std::uint32_t loopLimit = 0;  ///< iterations after which the driver ends loops; 0: it does not
  bool givesTimes = true;       ///< of launches
};
/// A device that ends loops earlier is not drawn on: what the stages' chunks take would not fit.
inline constexpr std::uint32_t kLeastLoopLimit = 60000;

struct DeviceInfo {
  int index = 0;  ///< as listed by `whittle devices`
  std::string platform, name, vendor, version, driver;
  std::string kind;  ///< "cpu", "gpu", "accelerator" or "other"
  unsigned computeUnits = 0;
  std::uint64_t globalMemory = 0;   ///< bytes
  std::uint64_t largestBuffer = 0;  ///< bytes, the single-allocation limit
  std::uint64_t maxWorkGroup = 0;   ///< work items
  unsigned floatLanes = 1;          ///< floats of a native vector
  bool sharesMemory = false;        ///< a CPU whose buffers may lie in the host's own memory
  bool usable = false;
  std::string reason;  ///< why not, one line
  cl::Device device;
  DeviceFacts facts;

  /// Whether rays are searched for in packets: a CPU whose compiler keeps vectors in vector registers.
  /// (Mesa's rusticl, which spreads work items over them instead, takes minutes to compile the packets.)
  bool suitsPackets() const { return kind == "cpu" && floatLanes >= 4; }
};

struct DeviceList {
  std::vector<DeviceInfo> devices;
  std::vector<std::string> problems;  ///< platforms without devices, drivers that failed; one line each
};

/// Asks every platform; a broken one becomes a line in `problems`, never an exception.
DeviceList listDevices();

/// Chooses by index, part of a name (any case), or cpu|gpu; empty: the first usable CPU, else the first
/// usable. Throws InputError-like std::invalid_argument with one line if there is none.
DeviceInfo selectDevice(const DeviceList& list, const std::string& selector);

/// Of a CPU's device with more than `threads` (> 0) compute units a part that has as many, where its driver
/// divides it; else the device as it is. Throws ClError.
DeviceInfo withThreads(DeviceInfo device, int threads);

/// Processors that run the device's work at once, of a CPU: no more than the machine has, whatever the driver
/// says of compute units. Of other devices their compute units.
unsigned processorsOf(const DeviceInfo& device);

/// Whether a device opened for so many threads (> 0) has as many, as far as we can tell: its driver was told
/// in time, divides its device, or has no more.
bool keepsToThreads(const DeviceInfo& device, int threads);

/// Before the first OpenCL call of the process: limits PoCL and Mesa's llvmpipe to `threads` CPU threads (0:
/// no limit), which withThreads can lower later, and gives every thread that is started from now on a stack
/// on which work-groups of `workGroup` items (0: of the default size) find room.
void prepareCpuThreads(int threads, int workGroup);

}  // namespace whittle
