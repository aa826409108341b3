// See load_watch.h. Pressure (/proc/pressure/cpu) is no use here: our own threads wait for each other where
// there are more of them than processors.
#include "measure/load_watch.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <sstream>

namespace whittle {
namespace {

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

double ownSeconds() {
  double sum = 0.0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    if (getrusage(who, &usage) == 0) sum += seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }
  return sum;
}

/// Of the slowest processor, Hz; 0: not told, as in most virtual machines.
double clockNow() {
  double least = 0.0;
  for (int cpu = 0;; ++cpu) {
    std::ifstream in(fmt::format("/sys/devices/system/cpu/cpu{}/cpufreq/scaling_cur_freq", cpu));
    double kilohertz = 0.0;
    if (!(in >> kilohertz)) return least;
    least = least > 0.0 ? std::min(least, 1e3 * kilohertz) : 1e3 * kilohertz;
  }
}

LoadReading readNow() {
  std::ifstream in("/proc/stat");
  std::string line;
  std::getline(in, line);
  return {parseProcessorTimes(line, static_cast<double>(sysconf(_SC_CLK_TCK))), ownSeconds(),
          std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count()};
}

}  // namespace

std::optional<ProcessorTimes> parseProcessorTimes(const std::string& text, double ticksPerSecond) {
  std::istringstream in(text);
  std::string name;
  // proc(5): user, nice, system, idle, iowait, irq, softirq, steal; guests are counted in user as well.
  std::array<double, 8> ticks{};
  in >> name;
  for (double& t : ticks) in >> t;
  if (!in || name != "cpu" || !(ticksPerSecond > 0.0)) return {};
  const auto& [user, nice, system, idle, waiting, irq, softirq, steal] = ticks;
  return ProcessorTimes{(user + nice + system + irq + softirq) / ticksPerSecond, steal / ticksPerSecond};
}

Load loadBetween(const LoadReading& before, const LoadReading& after) {
  Load load;
  load.seconds = after.wall - before.wall;
  load.isKnown = before.all && after.all && load.seconds > 0.0;
  if (!load.isKnown) return load;
  const double busy = after.all->busy - before.all->busy, own = after.own - before.own;
  load.others = std::max(0.0, (busy - own) / load.seconds);
  load.stolen = std::max(0.0, (after.all->stolen - before.all->stolen) / load.seconds);
  return load;
}

LoadWatch::LoadWatch() : last_(readNow()) {}

Load LoadWatch::look() {
  const LoadReading now = readNow();
  Load load = loadBetween(last_, now);
  load.clock = clockNow();
  last_ = now;
  return load;
}

std::string loadText(const Load& load) {
  if (load.isQuiet()) return "";
  std::string text;
  if (load.others >= 0.01) text = fmt::format("other work keeps {:.2f} processors busy", load.others);
  if (load.stolen >= 0.01)
    text += fmt::format("{}the host takes {:.2f} of them away", text.empty() ? "" : ", ", load.stolen);
  return text;
}

}  // namespace whittle
