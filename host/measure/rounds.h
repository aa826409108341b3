// Measurements that take turns: whatever slows the machine for a while slows all of them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "measure/interval.h"

namespace whittle {

struct RoundsPlan {
  double within = 0.03;    ///< half an interval, as a share of the median, that is good enough
  double seconds = 60.0;   ///< after that no measurement begins, but those of the first round
  int most = 1000;         ///< rounds
  double lookEvery = 0.5;  ///< seconds, about, between two looks at what else the machine does
  std::uint32_t seed = 1;  ///< of the order within each round
};

/// One measurement of one point.
struct Sample {
  int round = 0;
  double value = 0.0;
  bool isQuiet = true;  ///< nothing else ran on the machine meanwhile, as far as is known
};

/// What is measured, and the machine it is measured on. Tests put other ones in their place.
struct RoundsWork {
  std::function<double(std::size_t point)>
      measure;                      ///< positive; NaN: the point cannot be measured, never again
  std::function<double()> now;      ///< seconds
  std::function<bool()> wasQuiet;   ///< since it was last asked
  std::function<bool()> keepGoing;  ///< false: what there is has to do
};

/// Measures each of `points` points once a round, in random order, until the interval of each is narrow
/// enough. Points that are done sit out, but for the first, which the others are compared with round by
/// round. Samples that were not quiet are kept, but do not count before there are no others: the point is
/// measured again while time lasts.
std::vector<std::vector<Sample>> measureRounds(std::size_t points, const RoundsPlan& plan,
                                               const RoundsWork& work);

/// The samples that count: the quiet ones, or all, where fewer than have an interval are quiet.
std::vector<Sample> counted(const std::vector<Sample>& samples);
/// Of a point's samples that count; there must be one.
Interval intervalOf(const std::vector<Sample>& samples);
/// first/second of the rounds in which both were measured: a machine that gets slower from round to round
/// does not show. Of those that count; without a round in common of the medians, and not known.
Interval ratioOf(const std::vector<Sample>& first, const std::vector<Sample>& second);

}  // namespace whittle
