// Reads /proc; where that has nothing to say (another system, another user's process), nothing is starved.
#include "cli/starvation.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace whittle::cli {
namespace {

namespace fs = std::filesystem;

fs::path folderOf(pid_t process) { return fs::path("/proc") / std::to_string(process); }

/// Folders of the threads of `process`, as far as they can be had while it comes and goes.
std::vector<fs::path> threadsOf(pid_t process) {
  std::vector<fs::path> threads;
  std::error_code error;
  fs::directory_iterator thread(folderOf(process) / "task", error);
  for (; !error && thread != fs::directory_iterator(); thread.increment(error))
    threads.push_back(thread->path());
  return threads;
}

/// `process` and those that it has started: our compiler process and what a driver runs.
std::vector<pid_t> withChildren(pid_t process) {
  std::vector<pid_t> all{process};
  for (const fs::path& thread : threadsOf(process)) {
    std::ifstream in(thread / "children");
    for (pid_t child = 0; in >> child;) all.push_back(child);
  }
  return all;
}

struct Activity {
  bool mayWork = false;     ///< runs, waits for a disk, or was stopped: no waiting for ever
  std::uint64_t ticks = 0;  ///< of the processor, so far
  std::uint64_t peak = 0;   ///< most addresses it had, bytes
};

/// Of all threads; a process that is gone has none.
Activity activityOf(pid_t process) {
  Activity a;
  for (const fs::path& thread : threadsOf(process)) {
    std::ifstream in(thread / "stat");
    std::string line;
    std::getline(in, line);
    const std::size_t name = line.rfind(')');  // the name may hold anything, spaces too
    if (name == std::string::npos) continue;
    std::istringstream fields(line.substr(name + 1));
    char state = 0;
    fields >> state;
    constexpr std::string_view kIdle = "SZX";  // asleep, or ended
    a.mayWork = a.mayWork || kIdle.find(state) == std::string_view::npos;
    // Fields 4 to 13 are of no use here; 14 and 15 are the time in user and in system mode.
    std::string skipped;
    for (int i = 4; i <= 13; ++i) fields >> skipped;
    std::uint64_t user = 0, system = 0;
    fields >> user >> system;
    a.ticks += user + system;
  }
  std::ifstream in(folderOf(process) / "status");
  for (std::string word; in >> word;)
    if (word == "VmPeak:") {
      in >> a.peak;
      a.peak *= 1024;
      break;
    }
  return a;
}

}  // namespace

bool Starvation::isStarved(pid_t process, std::uint64_t limit) {
  constexpr auto kLong = std::chrono::seconds(1);
  constexpr double kClose = 0.5;  // of the limit; the allocation that failed may have been a large one
  Activity all;
  for (const pid_t p : withChildren(process)) {
    const Activity a = activityOf(p);
    all.mayWork = all.mayWork || a.mayWork;
    all.ticks += a.ticks;
    all.peak = std::max(all.peak, a.peak);
  }
  const auto now = std::chrono::steady_clock::now();
  if (all.mayWork || all.ticks != ticks_ ||
      static_cast<double>(all.peak) < kClose * static_cast<double>(limit)) {
    ticks_ = all.ticks;
    since_ = now;
    return false;
  }
  return now - since_ >= kLong;
}

}  // namespace whittle::cli
