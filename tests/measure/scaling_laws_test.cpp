// Laws of speed-up fitted to numbers that follow them.
#include "measure/scaling_laws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace whittle {
namespace {

std::vector<ScalingPoint> following(double serial, double crosstalk, const std::vector<int>& threads,
                                    int times, double scatter, unsigned seed) {
  std::mt19937 dice(seed);
  std::normal_distribution<double> noise(0.0, scatter);
  std::vector<ScalingPoint> points;
  for (const int n : threads)
    for (int i = 0; i < times; ++i)
      points.push_back(
          {double(n), double(n),
           12.0 * n / (1.0 + serial * (n - 1) + crosstalk * n * (n - 1.0)) * (1.0 + noise(dice))});
  return points;
}

TEST(ScalingLaws, FindTheParametersOfNumbersThatFollowThem) {
  const auto amdahl = fitAmdahl(following(0.07, 0.0, {1, 2, 4, 8}, 1, 0.0, 1));
  ASSERT_TRUE(amdahl.law);
  EXPECT_NEAR(amdahl.law->rate.value, 12.0, 1e-8);
  EXPECT_NEAR(amdahl.law->serial.value, 0.07, 1e-9);
  EXPECT_LT(amdahl.law->residual, 1e-9);
  EXPECT_NEAR(amdahl.law->at(16, 16), 12.0 * 16 / (1.0 + 0.07 * 15), 1e-6);
  const auto universal = fitUniversal(following(0.03, 0.002, {1, 2, 4, 8, 16}, 1, 0.0, 1));
  ASSERT_TRUE(universal.law);
  EXPECT_NEAR(universal.law->serial.value, 0.03, 1e-8);
  EXPECT_NEAR(universal.law->crosstalk.value, 0.002, 1e-9);
}

/// Threads that share a core are worth less than a processor: the machine's part of the loss is no part of
/// the program's.
TEST(ScalingLaws, HoldTheProgramAgainstTheMachinesOwnCeiling) {
  std::vector<ScalingPoint> points;
  for (const double n : {1.0, 2.0, 3.0, 4.0})
    points.push_back({n, 1.0 + 0.6 * (n - 1.0), 5.0 * (1.0 + 0.6 * (n - 1.0))});
  const auto fit = fitAmdahl(points);
  ASSERT_TRUE(fit.law);
  EXPECT_NEAR(fit.law->serial.value, 0.0, 1e-9);
  EXPECT_TRUE(fit.law->serial.mayBeZero());
}

TEST(ScalingLaws, TheirIntervalsHoldTheTruthNineteenTimesOfTwenty) {
  int serial = 0, crosstalk = 0;
  constexpr int kTrials = 600;
  for (int i = 0; i < kTrials; ++i) {
    const auto fit = fitUniversal(following(0.05, 0.004, {1, 2, 3, 4, 6, 8}, 5, 0.01, 100U + unsigned(i)));
    ASSERT_TRUE(fit.law);
    serial += std::abs(fit.law->serial.value - 0.05) <= fit.law->serial.half ? 1 : 0;
    crosstalk += std::abs(fit.law->crosstalk.value - 0.004) <= fit.law->crosstalk.half ? 1 : 0;
  }
  // Four standard errors of the count.
  const double allowed = 4.0 * std::sqrt(kTrials * 0.95 * 0.05);
  EXPECT_NEAR(serial, 0.95 * kTrials, allowed);
  EXPECT_NEAR(crosstalk, 0.95 * kTrials, allowed);
}

TEST(ScalingLaws, SayWhenTheyCannotTell) {
  EXPECT_EQ(fitAmdahl(following(0.1, 0, {1, 2}, 10, 0.01, 1)).whyNot, "2 numbers of threads; it takes 3");
  EXPECT_EQ(fitUniversal(following(0.1, 0, {1, 2, 4}, 10, 0.01, 1)).whyNot,
            "3 numbers of threads; it takes 4");
  EXPECT_FALSE(fitAmdahl(following(0.1, 0, {1, 2, 3}, 1, 1.5, 3)).law) << "scatter of 150 %";
}

/// Student (1908): tables of t for 95 %, two-sided.
TEST(ScalingLaws, StudentsTIsThatOfTheTables) {
  EXPECT_NEAR(studentT(1), 12.706, 5e-4);
  EXPECT_NEAR(studentT(2), 4.303, 5e-4);
  EXPECT_NEAR(studentT(5), 2.571, 5e-4);
  EXPECT_NEAR(studentT(30), 2.042, 5e-4);
  EXPECT_NEAR(studentT(1000), 1.962, 5e-4);
}

}  // namespace
}  // namespace whittle
