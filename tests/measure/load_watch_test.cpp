// What else the machine does, from what /proc says.
#include "measure/load_watch.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace whittle {
namespace {

TEST(LoadWatch, ReadsTheFieldsThatProcDescribes) {
  // user nice system idle iowait irq softirq steal guest guest_nice, in ticks of 1/100 s
  const auto times = parseProcessorTimes("cpu  1000 200 300 99999 50 7 3 400 90 10", 100.0);
  ASSERT_TRUE(times);
  EXPECT_DOUBLE_EQ(times->busy, 15.10) << "guests are in user already, idle and waiting are not busy";
  EXPECT_DOUBLE_EQ(times->stolen, 4.00);
  EXPECT_FALSE(parseProcessorTimes("cpu0 1 2 3 4 5 6 7 8", 100.0)) << "one processor of several";
  EXPECT_FALSE(parseProcessorTimes("", 100.0));
  EXPECT_FALSE(parseProcessorTimes("cpu 1 2 3", 100.0));
}

LoadReading reading(double busy, double stolen, double own, double wall) {
  return {ProcessorTimes{busy, stolen}, own, wall};
}

TEST(LoadWatch, OthersAreWhatIsBusyBesideThisProcess) {
  const Load load = loadBetween(reading(100, 3, 40, 10), reading(103.5, 3.2, 41.5, 12));
  EXPECT_TRUE(load.isKnown);
  EXPECT_DOUBLE_EQ(load.others, 1.0);
  EXPECT_NEAR(load.stolen, 0.1, 1e-12);
  EXPECT_FALSE(load.isQuiet());
  EXPECT_EQ(loadText(load), "other work keeps 1.00 processors busy, the host takes 0.10 of them away");
}

TEST(LoadWatch, OurOwnWorkIsQuiet) {
  const Load load = loadBetween(reading(100, 3, 40, 10), reading(104, 3, 44, 12));
  EXPECT_DOUBLE_EQ(load.others, 0.0);
  EXPECT_TRUE(load.isQuiet());
  EXPECT_EQ(loadText(load), "");
}

/// The counters come from two places, a tick apart.
TEST(LoadWatch, NothingIsNegative) {
  EXPECT_EQ(loadBetween(reading(100, 3, 40, 10), reading(101, 3, 41.01, 11)).others, 0.0);
}

TEST(LoadWatch, WhatCannotBeReadIsNotKnownAndNobodyIsAccused) {
  const Load load = loadBetween({{}, 1, 10}, {{}, 2, 11});
  EXPECT_FALSE(load.isKnown);
  EXPECT_TRUE(load.isQuiet());
}

TEST(LoadWatch, SeesAnotherProcessAtWork) {
  LoadWatch watch;
  if (!watch.look().isKnown) GTEST_SKIP() << "no /proc/stat here";
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    volatile unsigned spin = 0;
    for (;;) spin = spin + 1;
  }
  watch.look();
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  const Load load = watch.look();
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  // It gets a processor, or its share of one that is wanted by others, who count as well.
  EXPECT_GT(load.others, 0.5);
}

}  // namespace
}  // namespace whittle
