// `whittle check`: proves that a device computes what it should. Each line is one thing that was tried,
// against the host's own answer: the driver (loops, arithmetic, times, memory), single kernels, and small
// whole pictures.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cl/device_facts.h"
#include "cl/program.h"

namespace whittle {

struct CheckLine {
  Finding finding;
  double seconds = 0.0;  ///< 0: came with the line before
};

struct CheckReport {
  DeviceInfo device;  ///< with its facts
  std::vector<CheckLine> lines;
  double seconds = 0.0;

  /// Whether nothing is wrong; what is worked round counts as right.
  bool isRight() const;
};

/// Tries everything. A check whose calls fail is a line that is wrong; `progress` hears each one's name
/// before it begins, and may be empty. Throws ClError where the device cannot even be opened.
CheckReport checkDevice(const DeviceInfo& device, const std::function<void(const std::string&)>& progress);

// The parts, each a line or a few; they throw ClError.
std::vector<Finding> checkMemory(Compute& compute);
std::vector<Finding> checkTwoQueues(Compute& compute);
std::vector<Finding> checkCompaction(Compute& compute);
std::vector<Finding> checkSums(Compute& compute);
std::vector<Finding> checkSearches(Compute& compute);
std::vector<Finding> checkShading(Compute& compute);

/// A line that is right where `different` of `all` are 0.
Finding comparedFinding(const std::string& name, std::size_t different, std::size_t all,
                        const std::string& with, const std::string& consequence);

}  // namespace whittle
