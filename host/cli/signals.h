// Ctrl-C, kill and a closed terminal end the program at once, except while files are being written: then they
// wait until the files are whole. A write past a limit becomes an ordinary error.
#pragma once

namespace whittle::cli {

/// Called once, before anything else. `clearLine`: a progress line on standard error is wiped on the way out.
void installSignals(bool clearLine);

/// While one of these lives, signals wait; its end delivers the one that came.
class HoldSignals {
 public:
  HoldSignals();
  ~HoldSignals();
  HoldSignals(const HoldSignals&) = delete;
  HoldSignals& operator=(const HoldSignals&) = delete;
};

}  // namespace whittle::cli
