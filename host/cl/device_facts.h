// What a device does that its driver does not say, or says otherwise: tried once for each driver version, and
// remembered.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cl/program.h"

namespace whittle {

enum class Verdict : std::uint8_t {
  Right,
  Wrong,       ///< pictures would be, too
  WorkedRound  ///< not as OpenCL says, and what we do about it is in force
};

/// One thing that was tried.
struct Finding {
  std::string name;  ///< what
  Verdict verdict = Verdict::Right;
  std::string seen;         ///< in a few words
  std::string consequence;  ///< for pictures and times; empty where there is none
};

struct DeviceProbe {
  DeviceFacts facts;
  std::vector<Finding> findings;
};

/// Tries loops, arithmetic and event times, in some milliseconds once the probes are compiled. Throws ClError
/// where the device cannot even do that.
DeviceProbe probeDevice(Compute& compute);

/// Whether the start and end of some launches, in ns, are times: they take some, and follow one another.
/// `resolution`: as the driver says, in ns.
struct LaunchTimes {
  std::uint64_t start = 0, end = 0;
};
bool areTimes(std::uint64_t resolution, const std::vector<LaunchTimes>& launches);

/// Tells the compute what its device does: what was found out before with this driver version, else what
/// probeDevice finds now, which is remembered. Throws ClError, in one line, for a device that computes
/// wrongly, or ends loops too early: nothing may be drawn on it.
void learnFacts(Compute& compute);

/// Forgets what is remembered of all devices.
void forgetFacts();

/// Of a device that ends loops: the iterations that one work item may take, all its loops together. The
/// driver counts over the items of a vector, of which there are at most eight where that was seen (Mesa's
/// llvmpipe), and loops that its compiler does not unroll count as well: half is left to those. 0: no limit.
std::uint32_t loopBudget(const DeviceInfo& device);

}  // namespace whittle
