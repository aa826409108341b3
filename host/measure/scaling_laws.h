// Speed-up against threads as two laws describe it, fitted to measurements, with 95 % intervals.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace whittle {

/// A parameter and half its interval.
struct Estimate {
  double value = 0.0, half = 0.0;
  bool mayBeZero() const { return value - half <= 0.0; }
};

/// So many threads, the processors that they are worth by the machine's own ceiling, and frames/s.
struct ScalingPoint {
  double threads = 1.0, processors = 1.0, rate = 1.0;
};

/// X(N) = X1 c / (1 + serial (c - 1) + crosstalk N (N - 1)), with N threads that are worth c processors.
struct ScalingLaw {
  Estimate rate;          ///< X1: of one thread
  Estimate serial;        ///< Amdahl's share that is serial or waits its turn
  Estimate crosstalk;     ///< 0 in Amdahl's law
  double residual = 0.0;  ///< root mean square, as a share

  double at(double threads, double processors) const;
};

struct ScalingFit {
  std::optional<ScalingLaw> law;
  std::string whyNot;  ///< a line, where the measurements cannot tell
};

/// Amdahl's law (1967): at least three different numbers of threads.
ScalingFit fitAmdahl(const std::vector<ScalingPoint>& points);
/// Gunther's universal scalability law (Guerrilla Capacity Planning, 2007): at least four.
ScalingFit fitUniversal(const std::vector<ScalingPoint>& points);

/// The t for which Student's distribution has 95 % between -t and t.
double studentT(int freedom);

}  // namespace whittle
