// When the phases of a render began and how long they took: for the statistics, and for the trace where one
// is kept.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "report/stats.h"
#include "report/trace.h"

namespace whittle {

class PhaseLog {
 public:
  using Clock = std::chrono::steady_clock;

  explicit PhaseLog(Trace* trace) : trace_(trace) {}

  /// A phase of the host from `start` to now.
  void end(const char* name, Clock::time_point start) {
    add(name, start, secondsSince(start));
    if (trace_) trace_->phase(name, start);
  }
  /// One that ran beside others and was traced there.
  void add(const char* name, Clock::time_point start, double seconds) {
    phases_.push_back({name, steadySeconds(start), seconds});
  }
  /// What `work` returns, which is a phase of the host.
  template <typename F>
  auto time(const char* name, const F& work) {
    const auto start = Clock::now();
    auto result = work();
    end(name, start);
    return result;
  }

  /// Of a phase that ended; 0: there was none.
  double seconds(const std::string& name) const {
    for (const auto& phase : phases_)
      if (phase.name == name) return phase.seconds;
    return 0.0;
  }
  const std::vector<PhaseStats>& phases() const { return phases_; }

  static double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

 private:
  Trace* trace_;
  std::vector<PhaseStats> phases_;
};

}  // namespace whittle
