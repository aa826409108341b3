// Intervals of medians against tables and by how often they hold.
#include "measure/interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace whittle {
namespace {

std::vector<double> numbersTo(int n) {
  std::vector<double> values(static_cast<std::size_t>(n));
  std::iota(values.begin(), values.end(), 1.0);
  return values;
}

/// Which values bound the median: e.g. Hahn and Meeker, Statistical Intervals, table A.15 (the closest pair
/// of at least 95 %).
TEST(MedianInterval, TakesTheOrderStatisticsOfTheTables) {
  const std::tuple<int, double, double> table[]{{6, 1, 6},   {8, 1, 8},   {9, 2, 8},    {10, 2, 9},
                                                {15, 4, 12}, {20, 6, 15}, {50, 18, 33}, {100, 40, 61}};
  for (const auto& [n, low, high] : table) {
    const Interval interval = medianInterval(numbersTo(n));
    EXPECT_TRUE(interval.isKnown) << n;
    EXPECT_EQ(interval.middle, (n + 1) / 2.0) << n;
    EXPECT_EQ(interval.low, low) << n;
    EXPECT_EQ(interval.high, high) << n;
  }
}

TEST(MedianInterval, OfFewerThanSixValuesIsNotKnown) {
  for (int n = 1; n < kLeastForInterval; ++n) {
    const Interval interval = medianInterval(numbersTo(n));
    EXPECT_FALSE(interval.isKnown) << n;
    EXPECT_EQ(interval.low, 1.0);
    EXPECT_EQ(interval.high, n);
    EXPECT_TRUE(std::isinf(interval.relativeHalfWidth()));
  }
}

TEST(MedianInterval, SortsAndSaysTheWiderSide) {
  const Interval interval = medianInterval({5, 1, 4, 2, 3, 9});
  EXPECT_EQ(interval.middle, 3.5);
  EXPECT_DOUBLE_EQ(interval.relativeHalfWidth(), 5.5 / 3.5);
}

/// Times have a long tail; the median of exp(N(0, 1)) is 1.
TEST(MedianInterval, HoldsTheMedianOfASkewDistributionNineteenTimesOfTwenty) {
  std::mt19937 dice(7);
  std::lognormal_distribution<double> times(0.0, 1.0);
  constexpr int kTrials = 4000;
  int held = 0;
  for (int i = 0; i < kTrials; ++i) {
    std::vector<double> values(17);
    for (double& v : values) v = times(dice);
    held += medianInterval(values).contains(1.0) ? 1 : 0;
  }
  // Between 0.95 and the 0.951 of 17 values' own pair; four standard errors of the count below.
  EXPECT_GT(held, 0.95 * kTrials - 4.0 * std::sqrt(kTrials * 0.95 * 0.05));
  EXPECT_LT(held, 0.97 * kTrials);
}

/// 2^-n is 0 in double precision from 1075 on.
TEST(MedianInterval, OfThousandsOfValuesIsNarrow) {
  const Interval interval = medianInterval(numbersTo(10001));
  // 1.96 standard deviations of a binomial count, sqrt(n)/2.
  EXPECT_NEAR(interval.low, 5001 - 0.98 * std::sqrt(10001.0), 2.0);
  EXPECT_NEAR(interval.high, 5001 + 0.98 * std::sqrt(10001.0), 2.0);
}

}  // namespace
}  // namespace whittle
