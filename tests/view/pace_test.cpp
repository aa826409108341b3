// Which picture comes first, by the times that pictures took.
#include "view/pace.h"

#include <gtest/gtest.h>

namespace whittle::test {
namespace {

using view::Pace;

constexpr double kPixels = 1e5;
constexpr bool kAtRest = false, kMoving = true;

Pace paceOf(double fullSeconds, double coarseSeconds) {
  Pace pace;
  pace.tookFull(kPixels, fullSeconds);
  pace.tookCoarse(kPixels / 16, coarseSeconds);
  return pace;
}

TEST(Pace, OfAnUnknownSceneACoarsePictureComesFirst) {
  EXPECT_EQ(Pace().divisor(kPixels, kAtRest), 4);
  EXPECT_EQ(Pace().divisor(kPixels, kMoving), 4);
}

TEST(Pace, AFullPictureWithinATenthOfASecondComesFirst) {
  EXPECT_EQ(paceOf(0.06, 0.015).divisor(kPixels, kAtRest), 1);
  EXPECT_EQ(paceOf(0.2, 0.015).divisor(kPixels, kAtRest), 4);
  EXPECT_EQ(paceOf(0.02, 0.004).divisor(10 * kPixels, kAtRest), 4) << "ten times the pixels, 0.2 s";
}

/// Where moves follow each other faster than full pictures, each would end the one before and none be seen.
TEST(Pace, AfterOneThatWasCutShortACoarsePictureComesFirst) {
  EXPECT_EQ(paceOf(0.06, 0.015).divisor(kPixels, kMoving), 4);
  EXPECT_EQ(paceOf(0.02, 0.004).divisor(kPixels, kMoving), 4);
}

/// 1/4, 1/16 of the pixels in as much less time; more than 16 would show nothing.
TEST(Pace, ASlowCoarsePictureIsMadeCoarser) {
  EXPECT_EQ(paceOf(2, 0.04).divisor(kPixels, kAtRest), 4);
  EXPECT_EQ(paceOf(2, 0.15).divisor(kPixels, kAtRest), 8);
  EXPECT_EQ(paceOf(9, 0.60).divisor(kPixels, kAtRest), 16);
  EXPECT_EQ(paceOf(99, 9.0).divisor(kPixels, kAtRest), 16);
}

}  // namespace
}  // namespace whittle::test
