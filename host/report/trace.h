// What ran when, for `--trace`: one record for each kernel launch and for each phase on the host, all on the
// host's steady clock. Written in the Trace Event Format (JSON object form) that chrome://tracing and
// Perfetto read.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace whittle {

class Trace {
 public:
  using Clock = std::chrono::steady_clock;
  /// The rows of the picture. The compiler runs beside the tree builder, so it has a row of its own; other
  /// threads of the host have theirs below (work).
  enum class Track { Host = 1, Compiler = 2, Device = 3, Helpers = 4 };

  struct Launch {
    const char* stage = "";
    const char* queue = "";    ///< whose entries its items are
    std::uint32_t batch = 0;   ///< of the render, from 0
    std::uint32_t bounce = 0;  ///< 1 = what the eye sees; 0: a stage outside the bounces
    std::uint64_t items = 0;
    std::uint64_t bytes = 0;        ///< known at the launch (wavefront/stages.h)
    double enqueued = 0.0;          ///< seconds of the steady clock, right after it was given to the queue
    double start = 0.0, end = 0.0;  ///< seconds of the device's clock
  };

  /// `queued`: when the launch reached the queue, in seconds of the device's clock. That clock is its own;
  /// the launch that both saw within the shortest time ties it to the host's.
  void launch(const Launch& record, double queued) {
    hostMinusDevice_ = std::min(hostMinusDevice_, record.enqueued - queued);
    launches_.push_back(record);
  }
  /// Launches were timed by the host, each waited for: their row says so.
  void launchesAreHosts() { areLaunchesHosts_ = true; }
  /// From `start` to now, on a row of its own kind. `name` is one that JSON need not escape. May be called
  /// from several threads.
  void phase(const std::string& name, Clock::time_point start, Track track = Track::Host);
  /// The same on the row of the thread that calls: the host's for the one that made the trace.
  void work(const std::string& name, Clock::time_point start);

  /// The file's text: JSON, an event to a line. Times count from the first record.
  std::string toText() const;

 private:
  struct Phase {
    std::string name;
    int row;
    double start, end;
  };

  double firstSecond() const;

  std::vector<Launch> launches_;
  bool areLaunchesHosts_ = false;
  double hostMinusDevice_ = std::numeric_limits<double>::infinity();  ///< seconds
  std::vector<Phase> phases_;
  std::vector<std::thread::id> helpers_;  ///< in the order of their rows
  std::thread::id maker_ = std::this_thread::get_id();
  std::mutex phasesMutex_;
};

/// Host work on a trace from its making to the end of its scope; nothing without a trace.
class HostWork {
 public:
  HostWork(Trace* trace, const char* name) : trace_(trace), name_(name) {
    if (trace_) start_ = Trace::Clock::now();
  }
  ~HostWork() {
    if (trace_) trace_->phase(name_, start_);
  }
  HostWork(const HostWork&) = delete;
  HostWork& operator=(const HostWork&) = delete;

 private:
  Trace* trace_;
  const char* name_;
  Trace::Clock::time_point start_;
};

/// The steady clock in seconds, as Trace::Launch wants it.
double steadySeconds(Trace::Clock::time_point time);

}  // namespace whittle
