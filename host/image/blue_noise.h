// A pattern of thresholds to round by, in which neighbours differ and no order shows.
#pragma once

namespace whittle {

inline constexpr int kThresholdSide = 64;  ///< the pattern repeats after so many pixels

/// Of pixel (x, y) ≥ 0: (rank + ½)/kThresholdSide², each rank once in a square of that side, so that the
/// pixels below any level are spread evenly. The same on every machine.
double orderedThreshold(int x, int y);

}  // namespace whittle
