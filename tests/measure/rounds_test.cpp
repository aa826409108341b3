// Measurements in turns, on clocks and machines made up so that the answer is known.
#include "measure/rounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace whittle {
namespace {

/// A machine whose frames take as long as a test says; its clock is the sum of them.
class MadeUp {
 public:
  std::function<double(std::size_t point, double now)> seconds;  ///< of a frame
  std::function<bool(double now)> isBusy = [](double) { return false; };
  std::vector<int> count = std::vector<int>(8, 0);
  std::vector<std::size_t> order;
  int mostFrames = std::numeric_limits<int>::max();  ///< until somebody ends it
  double clock = 1000.0;

  RoundsWork work() {
    return {[this](std::size_t p) {
              const double value = seconds(p, clock);
              wasBusy_ |= isBusy(clock);
              if (!std::isnan(value)) clock += value;
              wasBusy_ |= isBusy(clock);
              ++count[p];
              order.push_back(p);
              return value;
            },
            [this] { return clock; },
            [this] {
              const bool wasQuiet = !wasBusy_;
              wasBusy_ = false;
              return wasQuiet;
            },
            [this] { return static_cast<int>(order.size()) < mostFrames; }};
  }

 private:
  bool wasBusy_ = false;
};

TEST(Rounds, SteadyFramesAreMeasuredAsOftenAsAnIntervalTakes) {
  MadeUp machine;
  machine.seconds = [](std::size_t p, double) { return p == 0 ? 0.2 : 0.1; };
  const auto samples = measureRounds(2, {}, machine.work());
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_EQ(machine.count[1], kLeastForInterval);
  EXPECT_DOUBLE_EQ(intervalOf(samples[1]).middle, 0.1);
  const Interval speedUp = ratioOf(samples[0], samples[1]);
  EXPECT_TRUE(speedUp.isKnown);
  EXPECT_DOUBLE_EQ(speedUp.low, 2.0);
  EXPECT_DOUBLE_EQ(speedUp.high, 2.0);
}

TEST(Rounds, WhatScattersIsMeasuredUntilItIsKnownWellEnoughAndNoLonger) {
  MadeUp machine;
  std::mt19937 dice(3);
  std::normal_distribution<double> scatter(1.0, 0.05);
  machine.seconds = [&](std::size_t p, double) { return p == 2 ? 0.1 * scatter(dice) : 0.1; };
  RoundsPlan plan;
  plan.within = 0.02;
  plan.seconds = 1e9;
  const auto samples = measureRounds(3, plan, machine.work());
  EXPECT_LE(intervalOf(samples[2]).relativeHalfWidth(), plan.within);
  EXPECT_NEAR(intervalOf(samples[2]).middle, 0.1, 0.1 * 2 * plan.within);
  EXPECT_EQ(machine.count[1], kLeastForInterval) << "steady: sits out";
  EXPECT_EQ(machine.count[0], machine.count[2]) << "the first is there in every round, to compare with";
  // The median of n normal values scatters by 1.25 sigma / sqrt(n): 1.96 of that is 2 % for 38.
  EXPECT_GT(machine.count[2], 10);
  EXPECT_LT(machine.count[2], 200);
}

TEST(Rounds, EndWithTheTimeButMeasureEverythingOnce) {
  MadeUp machine;
  machine.seconds = [](std::size_t, double) { return 10.0; };
  RoundsPlan plan;
  plan.seconds = 15.0;
  const auto samples = measureRounds(4, plan, machine.work());
  for (const auto& s : samples) EXPECT_EQ(s.size(), 1U);
  EXPECT_FALSE(ratioOf(samples[0], samples[1]).isKnown);
  EXPECT_FALSE(intervalOf(samples[0]).isKnown);
}

TEST(Rounds, AMachineThatGetsSlowerChangesNoRatio) {
  MadeUp machine;
  // Half as fast after 100 s; a frame is short beside that.
  machine.seconds = [](std::size_t p, double now) {
    return (p == 0 ? 0.3 : 0.1) * (1.0 + (now - 1000.0) / 100.0);
  };
  RoundsPlan plan;
  plan.within = 0.001;
  plan.seconds = 100.0;
  const auto samples = measureRounds(2, plan, machine.work());
  EXPECT_GT(intervalOf(samples[1]).relativeHalfWidth(), 0.05) << "its own times drift";
  // One frame lies after the other, in random order: the speed changes by 0.3 s of 100 s between them.
  const Interval ratio = ratioOf(samples[0], samples[1]);
  EXPECT_NEAR(ratio.middle, 3.0, 3.0 * 0.004);
  // Of either sign: the interval is at most twice as wide. Of two medians it would be as wide as their drift.
  EXPECT_LT(ratio.relativeHalfWidth(), 2 * 0.004);
}

TEST(Rounds, FramesBesideOtherWorkAreMeasuredAgain) {
  MadeUp machine;
  machine.isBusy = [](double now) { return now < 1003.0; };
  machine.seconds = [&](std::size_t p, double now) {
    return (p == 0 ? 0.2 : 0.1) * (machine.isBusy(now) ? 3.0 : 1.0);
  };
  const auto samples = measureRounds(2, {}, machine.work());
  for (std::size_t p = 0; p < 2; ++p) {
    EXPECT_FALSE(samples[p].front().isQuiet);
    EXPECT_GE(counted(samples[p]).size(), std::size_t{kLeastForInterval});
    for (const Sample& s : counted(samples[p])) EXPECT_DOUBLE_EQ(s.value, p == 0 ? 0.2 : 0.1);
    EXPECT_GT(samples[p].size(), counted(samples[p]).size()) << "what was measured is kept";
  }
}

TEST(Rounds, OnAMachineThatIsNeverQuietEverythingCountsAndTheTimeEndsIt) {
  MadeUp machine;
  machine.isBusy = [](double) { return true; };
  machine.seconds = [](std::size_t, double) { return 0.1; };
  RoundsPlan plan;
  plan.seconds = 5.0;
  const auto samples = measureRounds(1, plan, machine.work());
  EXPECT_NEAR(static_cast<double>(samples[0].size()), 50.0, 1.0);
  EXPECT_EQ(counted(samples[0]).size(), samples[0].size());
}

TEST(Rounds, APointThatCannotBeHadIsTriedOnce) {
  MadeUp machine;
  machine.seconds = [](std::size_t p, double) { return p == 1 ? std::nan("") : 0.1; };
  const auto samples = measureRounds(3, {}, machine.work());
  EXPECT_EQ(machine.count[1], 1);
  EXPECT_TRUE(samples[1].empty());
  EXPECT_EQ(machine.count[2], kLeastForInterval);
}

TEST(Rounds, WhoEndsThemKeepsWhatThereIsButTheFrameThatWasCutShort) {
  MadeUp machine;
  machine.seconds = [](std::size_t, double) { return 0.1; };
  machine.mostFrames = 5;
  const auto samples = measureRounds(2, {}, machine.work());
  EXPECT_EQ(samples[0].size() + samples[1].size(), 4U);
}

TEST(Rounds, TheOrderChangesFromRoundToRound) {
  MadeUp machine;
  machine.seconds = [](std::size_t, double) { return 0.1; };
  (void)measureRounds(4, {}, machine.work());
  ASSERT_EQ(machine.order.size(), 4U * kLeastForInterval);
  std::set<std::vector<std::size_t>> orders;
  for (auto at = machine.order.begin(); at != machine.order.end(); at += 4) orders.insert({at, at + 4});
  EXPECT_GT(orders.size(), 2U);
}

}  // namespace
}  // namespace whittle
