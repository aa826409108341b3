// Colours of layers: the ends of their scales, and what is nothing.
#include "view/false_colors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace whittle::test {
namespace {

using Codes = std::vector<std::uint8_t>;

Codes colorsOf(const std::string& layer, int channels, const std::vector<float>& pixels) {
  RenderResult result;
  result.aovs[layer] = {static_cast<int>(pixels.size()) / channels, 1, channels, pixels};
  return view::falseColors(result, layer).codes;
}

TEST(FalseColors, NearIsWhiteAndFarIsBlackOnALogarithmicScale) {
  const Codes codes = colorsOf("depth", 1, {1, 10, 100, INFINITY});
  EXPECT_EQ(codes[0], 255);
  EXPECT_EQ(codes[4], 140) << "1 - 0.9 / 2, half way";
  EXPECT_NEAR(codes[8], 25.5, 0.5) << "0.1";
  EXPECT_EQ(Codes(codes.begin() + 12, codes.end()), (Codes{20, 40, 90, 255}));
  EXPECT_EQ(colorsOf("depth", 1, {INFINITY, INFINITY})[2], 90) << "nothing at all";
  EXPECT_EQ(colorsOf("depth", 1, {3, 3})[0], 255) << "one depth";
}

TEST(FalseColors, NormalsAreCenteredAndNothingIsBlack) {
  EXPECT_EQ(colorsOf("normal", 3, {0, 0, 1, -1, 0, 0, 0, 0, 0}),
            (Codes{128, 128, 255, 255, 0, 128, 128, 255, 0, 0, 0, 255}));
}

TEST(FalseColors, NeighbouringTrianglesDiffer) {
  const Codes codes = colorsOf("primitive", 1, {0, 1, 2, -1});
  int apart = 0;
  for (std::size_t c = 0; c < 3; ++c) apart += std::abs(codes[c] - codes[4 + c]);
  EXPECT_GT(apart, 100);
  EXPECT_EQ(codes[12], 0);
}

TEST(FalseColors, SamplesAreSharesOfTheMost) {
  EXPECT_EQ(colorsOf("samples", 1, {16, 64})[0], 64);
  EXPECT_EQ(colorsOf("samples", 1, {0, 0})[0], 0);
}

TEST(FalseColors, AlbedoIsSrgb) { EXPECT_EQ(colorsOf("albedo", 3, {0.5F, 1, 0}), (Codes{188, 255, 0, 255})); }

/// From dark to bright without a step back, so that it reads in grey as well.
TEST(ColorScale, MoreIsBrighter) {
  double before = -1;
  for (int i = 0; i <= 200; ++i) {
    const view::Code code = view::rampAt(i / 200.0);
    const double luma = 0.299 * code[0] + 0.587 * code[1] + 0.114 * code[2];
    EXPECT_GE(luma, before) << i;
    before = luma;
  }
  EXPECT_EQ(view::rampAt(-1), view::rampAt(0));
  EXPECT_EQ(view::rampAt(2), view::rampAt(1));
  EXPECT_EQ(view::rampAt(NAN), view::rampAt(0));
}

TEST(ColorScale, LogarithmicOverSomeDecadesAtMost) {
  const auto scale = view::logarithmicScale(1e-9, 100, 4, "W");
  EXPECT_NEAR(scale.low, 0.01, 1e-12);
  EXPECT_NEAR(scale.shareOf(1), 0.5, 1e-12);
  EXPECT_NEAR(scale.valueAt(0.5), 1, 1e-12);
  EXPECT_EQ(view::logarithmicScale(5, 5, 4, "").valueAt(1), 5) << "one value";
  EXPECT_EQ(view::logarithmicScale(0, 0, 4, "").shareOf(0), 0) << "none";
}

TEST(FalseColors, CostAndErrorAreOnRampsAndNothingIsBlack) {
  const Codes cost = colorsOf("cost", 2, {0, 0, 30, 70, 4, 6});
  EXPECT_EQ(Codes(cost.begin(), cost.begin() + 4), (Codes{0, 0, 0, 255}));
  EXPECT_EQ(cost[4], view::rampAt(1)[0]) << "100: the most";
  EXPECT_EQ(cost[8], view::rampAt(0)[0]) << "10: the least";
  const Codes bounce = colorsOf("bounce", 1, {1, 3, 0});
  EXPECT_EQ(bounce[2], view::rampAt(0)[2]);
  EXPECT_EQ(bounce[6], view::rampAt(1)[2]);
  EXPECT_EQ(bounce[8], 0);
}

}  // namespace
}  // namespace whittle::test
