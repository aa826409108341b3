// Which picture comes first, by the times that pictures took.
#include "view/pace.h"

#include <gtest/gtest.h>

namespace whittle::test {
namespace {

using view::Pace;

constexpr double kPixels = 1e5, kLongAgo = 10, kJustNow = 0.01;

Pace paceOf(double fullSeconds, double coarseSeconds) {
  Pace pace;
  pace.tookFull(kPixels, fullSeconds);
  pace.tookCoarse(kPixels / 16, coarseSeconds);
  return pace;
}

TEST(Pace, OfAnUnknownSceneACoarsePictureComesFirst) {
  EXPECT_EQ(Pace().divisor(kPixels, kLongAgo), 4);
  EXPECT_EQ(Pace().divisor(kPixels, kJustNow), 4);
}

/// Thirty pictures a second need no coarse ones.
TEST(Pace, AFullPictureThatIsQuickComesFirst) {
  EXPECT_EQ(paceOf(0.02, 0.004).divisor(kPixels, kLongAgo), 1);
  EXPECT_EQ(paceOf(0.02, 0.004).divisor(10 * kPixels, kLongAgo), 4) << "ten times the pixels, 0.2 s";
}

/// The eye has had a picture of the move: the full one of where it ends need not wait for another.
TEST(Pace, AFullPictureWithinATenthOfASecondComesFirstWhereSomethingWasJustShown) {
  EXPECT_EQ(paceOf(0.06, 0.015).divisor(kPixels, kJustNow), 1);
  EXPECT_EQ(paceOf(0.06, 0.015).divisor(kPixels, kLongAgo), 4);
  EXPECT_EQ(paceOf(0.2, 0.015).divisor(kPixels, kJustNow), 4);
}

/// 1/4, 1/16 of the pixels in as much less time; more than 16 would show nothing.
TEST(Pace, ASlowCoarsePictureIsMadeCoarser) {
  EXPECT_EQ(paceOf(2, 0.04).divisor(kPixels, kLongAgo), 4);
  EXPECT_EQ(paceOf(2, 0.15).divisor(kPixels, kLongAgo), 8);
  EXPECT_EQ(paceOf(9, 0.60).divisor(kPixels, kLongAgo), 16);
  EXPECT_EQ(paceOf(99, 9.0).divisor(kPixels, kLongAgo), 16);
}

}  // namespace
}  // namespace whittle::test
