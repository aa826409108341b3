// See interval.h.
#include "measure/interval.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace whittle {
namespace {

constexpr double kMiss = 0.05;

/// How many of n sorted values may be left out at each end.
std::size_t leftOut(std::size_t n) {
  // The chance that fewer than k of n values lie below the median, in steps of k, from the binomial
  // distribution with 1/2: in logarithms, since 2^-n is 0 for large n.
  const double halves = -static_cast<double>(n) * std::log(2.0);
  double below = 0.0, ways = 0.0;  // the logarithm of n over k
  std::size_t k = 0;
  while (2 * k < n) {
    below += std::exp(ways + halves);
    if (2.0 * below > kMiss) break;
    ways += std::log(static_cast<double>(n - k)) - std::log(static_cast<double>(k + 1));
    ++k;
  }
  return k;  // the k-th value from each end, counted from 1; 0: there is none
}

}  // namespace

double Interval::relativeHalfWidth() const {
  if (!isKnown || !(middle > 0.0)) return std::numeric_limits<double>::infinity();
  return std::max(high - middle, middle - low) / middle;
}

Interval medianInterval(std::vector<double> values) {
  assert(!values.empty());
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size(), k = leftOut(n);
  Interval result;
  result.middle = n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2.0;
  result.isKnown = k > 0;
  result.low = values[k > 0 ? k - 1 : 0];
  result.high = values[k > 0 ? n - k : n - 1];
  return result;
}

}  // namespace whittle
