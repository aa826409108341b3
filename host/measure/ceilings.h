// What the machine itself gives to N threads: the ceiling that any program's speed-up is held against.
#pragma once

namespace whittle {

/// Rates of N threads together.
struct Ceilings {
  int threads = 1;
  double integer = 0.0;      ///< operations/s in registers: threads that share one core show here
  double multiplyAdd = 0.0;  ///< flop/s on whole vectors: so do clocks that fall under wide vectors
  double triad = 0.0;        ///< bytes/s of McCalpin's STREAM triad, as STREAM counts them: memory bounds it
};

/// Three loops, each for `seconds` on all threads at once. `bytes`: of each of the triad's three arrays, far
/// more than the caches hold.
Ceilings measureCeilings(int threads, double seconds, double bytes);

}  // namespace whittle
