// Whether the machine did anything else while something was measured. Reads /proc and /sys; on a system
// without them nothing is known, and says so.
#pragma once

#include <optional>
#include <string>

namespace whittle {

/// Sums since the machine started, seconds of one processor.
struct ProcessorTimes {
  double busy = 0.0;    ///< of all processes, and of interrupts
  double stolen = 0.0;  ///< by other guests of the same host
};
/// The first line of /proc/stat; none if it is not one.
std::optional<ProcessorTimes> parseProcessorTimes(const std::string& text, double ticksPerSecond);

/// What went on between two looks.
struct Load {
  bool isKnown = false;
  double seconds = 0.0;
  double others = 0.0;  ///< processors that other processes kept busy, on average
  double stolen = 0.0;  ///< processors that the host gave to other guests
  double clock = 0.0;   ///< of the processors, Hz, where it can be read; 0: it cannot

  /// Less than disturbs a measurement by a per cent or so: what a machine does by itself is below it.
  bool isQuiet() const { return !isKnown || (others < 0.08 && stolen < 0.04); }
};

/// What is read at one look.
struct LoadReading {
  std::optional<ProcessorTimes> all;
  double own = 0.0;   ///< of this process and its ended children, seconds of one processor
  double wall = 0.0;  ///< seconds
};
Load loadBetween(const LoadReading& before, const LoadReading& after);

class LoadWatch {
 public:
  LoadWatch();
  /// Since the last call, or since it was made.
  Load look();

 private:
  LoadReading last_;
};

/// "other work keeps 0.98 processors busy", with what was stolen; empty where it is quiet.
std::string loadText(const Load& load);

}  // namespace whittle
