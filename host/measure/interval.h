// What repeated measurements say of the thing measured: a median and how far it may be off.
#pragma once

#include <vector>

namespace whittle {

/// A median, and where that of ever more measurements lies with 95 % confidence, whatever their distribution.
struct Interval {
  double middle = 0.0, low = 0.0, high = 0.0;
  bool isKnown = false;  ///< false: fewer values than tell anything; low and high are their extremes

  /// The larger side, as a share of the median; infinite where nothing is known.
  double relativeHalfWidth() const;
  bool contains(double value) const { return low <= value && value <= high; }
};

/// The fewest values that have such an interval: of six the median lies between the extremes with 1 - 2/2^6.
inline constexpr int kLeastForInterval = 6;

/// The interval between two order statistics (Conover, Practical Nonparametric Statistics, 3rd ed., section
/// 3.2): the narrowest symmetric pair that misses the median with a probability of at most 5 %. `values`: at
/// least one.
Interval medianInterval(std::vector<double> values);

}  // namespace whittle
