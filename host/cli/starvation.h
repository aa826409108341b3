// A process that has come to the end of its memory may wait for ever: an error leaves a library while it
// holds a lock, and what tidies up after the error waits for that lock.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>

namespace whittle::cli {

/// Looks at one process from time to time, by what /proc says of it.
class Starvation {
 public:
  /// Whether `process` has been close to its limit of `limit` bytes, and since then it and the processes that
  /// it started have done nothing at all for a second. Called several times a second.
  bool isStarved(pid_t process, std::uint64_t limit);

 private:
  std::uint64_t ticks_ = 0;
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
};

}  // namespace whittle::cli
