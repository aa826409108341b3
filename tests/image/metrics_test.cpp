// Error numbers against values computed by hand.
#include "image/metrics.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace whittle {
namespace {

FloatImage image(int width, int height, int channels, std::vector<float> pixels) {
  return {width, height, channels, std::move(pixels)};
}

TEST(Metrics, matchHandComputedValues) {
  // Differences 0, 0.5, -1 | 0, 0, 2 from references 1, 0.5, 2 | 0, 3, 0.
  const FloatImage a = image(2, 1, 3, {1, 1, 1, 0, 3, 2}), r = image(2, 1, 3, {1, 0.5F, 2, 0, 3, 0});
  const ImageMetrics m = compareImages(a, r);
  EXPECT_NEAR(m.rmse, std::sqrt((0.25 + 1 + 4) / 6), 1e-15);
  EXPECT_NEAR(m.relMse, (0.25 / 0.26 + 1 / 4.01 + 4 / 0.01) / 6, 1e-12);
  EXPECT_EQ(m.maxAbs, 2.0);
  EXPECT_EQ(m.differingPixels, 2U);
  EXPECT_EQ(m.nonFinite, 0U);
  EXPECT_GT(m.flip, 0.0);
}

TEST(Metrics, equalPicturesHaveNoError) {
  const FloatImage a = image(2, 2, 3, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
  const ImageMetrics m = compareImages(a, a);
  EXPECT_EQ(m.rmse, 0);
  EXPECT_EQ(m.relMse, 0);
  EXPECT_EQ(m.maxAbs, 0);
  EXPECT_EQ(m.flip, 0);
  EXPECT_EQ(m.differingPixels, 0U);
}

TEST(Metrics, flipOfCodesHasNoToneMapBeforeIt) {
  // Lightness 0 against 100: 0.96738 by the paper's formulas (flip_test.cpp), 0.9675 in the published tool.
  // The tone map rolls white off to 0.9 of its light.
  const FloatImage black = image(2, 1, 3, std::vector<float>(6, 0.0F)),
                   white = image(2, 1, 3, std::vector<float>(6, 1.0F));
  EXPECT_NEAR(compareImages(black, white, Shown::AsItIs, Shown::AsItIs).flip, 0.96738, 5e-6);
  EXPECT_LT(compareImages(black, white).flip, 0.967);
  EXPECT_EQ(compareImages(black, white, Shown::AsItIs, Shown::ToneMapped).flip,
            compareImages(black, white).flip);
}

TEST(Metrics, oneUlpIsADifference) {
  const FloatImage a = image(1, 2, 1, {1, 0.5F}), b = image(1, 2, 1, {std::nextafter(1.0F, 2.0F), 0.5F});
  EXPECT_EQ(compareImages(a, b).differingPixels, 1U);
  EXPECT_EQ(compareImages(a, b).maxAbs, 0x1p-23);
}

TEST(Metrics, nanIsNeverHidden) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int at = 0; at < 4; ++at) {
    std::vector<float> bad{1, 2, 3, 4};
    bad[at] = nan;
    const FloatImage a = image(2, 2, 1, bad), r = image(2, 2, 1, {1, 2, 3, 7});
    const ImageMetrics m = compareImages(a, r), swapped = compareImages(r, a);
    EXPECT_TRUE(std::isnan(m.rmse) && std::isnan(m.relMse) && std::isnan(m.maxAbs)) << at;
    EXPECT_TRUE(std::isnan(swapped.rmse) && std::isnan(swapped.maxAbs)) << at;
    EXPECT_EQ(m.nonFinite, 1U);
    EXPECT_EQ(m.nonFiniteReference, 0U);
    EXPECT_EQ(swapped.nonFiniteReference, 1U);
  }
}

TEST(Metrics, alphaIsLeftOut) {
  const FloatImage a = image(1, 1, 4, {1, 1, 1, 0}), r = image(1, 1, 3, {1, 1, 1});
  EXPECT_EQ(compareImages(a, r).rmse, 0);
  EXPECT_EQ(compareImages(a, r).differingPixels, 0U);
}

TEST(Metrics, differentShapesAreRefused) {
  EXPECT_THROW(compareImages(image(2, 1, 1, {0, 0}), image(1, 2, 1, {0, 0})), std::runtime_error);
  EXPECT_THROW(compareImages(image(1, 1, 3, {0, 0, 0}), image(1, 1, 1, {0})), std::runtime_error);
}

TEST(Metrics, theSameBitsForAnyNumberOfThreads) {
  FloatImage a{97, 61, 3, {}}, r = a;
  for (int i = 0; i < 97 * 61 * 3; ++i) {
    a.pixels.push_back(0.37F * static_cast<float>(i % 89));
    r.pixels.push_back(0.31F * static_cast<float>(i % 83));
  }
  const ImageMetrics all = compareImages(a, r);
  for (const std::size_t threads : {1, 2, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const ImageMetrics some = compareImages(a, r);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(all.rmse), std::bit_cast<std::uint64_t>(some.rmse));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(all.relMse), std::bit_cast<std::uint64_t>(some.relMse));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(all.flip), std::bit_cast<std::uint64_t>(some.flip));
  }
}

}  // namespace
}  // namespace whittle
