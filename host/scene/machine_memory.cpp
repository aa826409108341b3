#include "scene/machine_memory.h"

#include <sys/resource.h>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace whittle {
namespace {

namespace fs = std::filesystem;

/// The number behind `key` in a file of lines "key number", times `unit`.
std::optional<std::uint64_t> entryOf(const fs::path& file, const std::string& key, std::uint64_t unit) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.rfind(key, 0) == 0) return std::strtoull(line.c_str() + key.size(), nullptr, 10) * unit;
  return std::nullopt;
}

/// The number that a file holds; nothing for "max", and for what version 1 writes for it.
std::optional<std::uint64_t> numberIn(const fs::path& file) {
  constexpr std::uint64_t kNone = std::uint64_t{1} << 60;
  std::ifstream in(file);
  std::uint64_t number = 0;
  if (!(in >> number) || number >= kNone) return std::nullopt;
  return number;
}

/// What one group leaves: its limit without what it holds, but for cached files, which give way.
std::optional<std::uint64_t> freeInGroup(const fs::path& group, const char* limitFile, const char* usedFile,
                                         const char* cacheKey) {
  const auto limit = numberIn(group / limitFile);
  if (!limit) return std::nullopt;
  const std::uint64_t used = numberIn(group / usedFile).value_or(0);
  const std::uint64_t cache = std::min(used, entryOf(group / "memory.stat", cacheKey, 1).value_or(0));
  return *limit - std::min(*limit, used - cache);
}

void lower(std::optional<std::uint64_t>& least, std::optional<std::uint64_t> other) {
  if (other && (!least || *other < *least)) least = other;
}

/// Of the group that /proc/self/cgroup names and of all above it. In a container the name may be one that
/// only the outside knows; the root stands for it then.
std::optional<std::uint64_t> freeInGroups(const fs::path& root) {
  std::optional<std::uint64_t> least;
  std::ifstream in(root / "proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool isSecond = controllers.empty();  // cgroups version 2
    if (!isSecond && ("," + controllers + ",").find(",memory,") == std::string::npos) continue;
    const fs::path base = root / (isSecond ? "sys/fs/cgroup" : "sys/fs/cgroup/memory");
    fs::path group = fs::path(line.substr(second + 1)).relative_path().lexically_normal();
    for (bool isLast = false; !isLast; group = group.parent_path()) {
      isLast = group.empty() || group == ".";
      lower(least, isSecond ? freeInGroup(base / group, "memory.max", "memory.current", "inactive_file ")
                            : freeInGroup(base / group, "memory.limit_in_bytes", "memory.usage_in_bytes",
                                          "total_inactive_file "));
    }
  }
  return least;
}

std::optional<std::uint64_t> ownLimit(decltype(RLIMIT_AS) resource) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  return limit.rlim_cur;
}

}  // namespace

std::optional<std::uint64_t> freeMemory(const fs::path& root) {
  std::optional<std::uint64_t> least = entryOf(root / "proc/meminfo", "MemAvailable:", 1024);
  lower(least, freeInGroups(root));
  return least;
}

std::optional<std::uint64_t> addressLimit() { return ownLimit(RLIMIT_AS); }

/// Of the addresses that a process may have, what programs and stacks of threads map and never touch.
/// Libraries that get less fail in ways of their own, and one waits for ever.
constexpr std::uint64_t kMappedBytes = 400'000'000;

void returnFreedMemory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

MemoryLimit memoryLimitOfMachine() {
  const std::optional<std::uint64_t> machine = freeMemory();
  std::optional<std::uint64_t> least = machine;
  if (const auto addresses = addressLimit()) lower(least, *addresses - std::min(*addresses, kMappedBytes));
  lower(least, ownLimit(RLIMIT_DATA));
  if (!least) return {std::numeric_limits<std::uint64_t>::max(), false};
  return {*least / 5 * 4, false, !machine || *least < *machine};
}

}  // namespace whittle
