// What the host did and when, for whoever draws it (--trace).
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <utility>

namespace whittle {

/// Told of a piece of work as it ends, from the thread that did it, by several at once: what it was, in words
/// that JSON need not escape, and when it began. Empty: nobody asks.
using WorkLog = std::function<void(const std::string& what, std::chrono::steady_clock::time_point start)>;

/// Work from its making to the end of its scope.
class LoggedWork {
 public:
  LoggedWork(const WorkLog& log, std::string what) : log_(log), what_(std::move(what)) {
    if (log_) start_ = std::chrono::steady_clock::now();
  }
  ~LoggedWork() {
    if (log_) log_(what_, start_);
  }
  LoggedWork(const LoggedWork&) = delete;
  LoggedWork& operator=(const LoggedWork&) = delete;

 private:
  const WorkLog& log_;
  std::string what_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace whittle
