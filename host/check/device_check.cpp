// See device_check.h.
#include "check/device_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace whittle {
namespace {

struct Check {
  const char* name;  ///< of its line where it fails, and for progress
  std::vector<Finding> (*run)(Compute&);
};

constexpr Check kChecks[]{{"memory", checkMemory},         {"two queues", checkTwoQueues},
                          {"compaction", checkCompaction}, {"sums", checkSums},
                          {"searches", checkSearches},     {"shading", checkShading}};

}  // namespace

bool CheckReport::isRight() const {
  return std::none_of(lines.begin(), lines.end(),
                      [](const CheckLine& line) { return line.finding.verdict == Verdict::Wrong; });
}

Finding comparedFinding(const std::string& name, std::size_t different, std::size_t all,
                        const std::string& with, const std::string& consequence) {
  if (different == 0) return {name, Verdict::Right, fmt::format("{} as {}", all, with), ""};
  return {name, Verdict::Wrong, fmt::format("{} of {} not as {}", different, all, with), consequence};
}

CheckReport checkDevice(const DeviceInfo& device, const std::function<void(const std::string&)>& progress) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::time_point since) {
    return std::chrono::duration<double>(Clock::now() - since).count();
  };
  const auto begin = Clock::now();
  CheckReport report;
  const auto run = [&](const char* name, const std::function<std::vector<Finding>()>& work) {
    if (progress) progress(name);
    const auto start = Clock::now();
    std::vector<Finding> findings;
    try {
      findings = work();
    } catch (const std::exception& e) {
      findings = {{name, Verdict::Wrong, e.what(), "no picture can be drawn"}};
    }
    for (const Finding& finding : findings)
      report.lines.push_back({finding, &finding == findings.data() ? seconds(start) : 0.0});
  };
  Compute compute(device);
  run("driver", [&] {
    DeviceProbe probe = probeDevice(compute);
    compute.know(probe.facts);
    return std::move(probe.findings);
  });
  for (const Check& check : kChecks) run(check.name, [&] { return check.run(compute); });
  report.device = compute.device();
  report.seconds = seconds(begin);
  return report;
}

}  // namespace whittle
