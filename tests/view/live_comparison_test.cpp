// Comparisons on their own thread: the figures of `whittle compare`, the newest picture's.
#include "view/live_comparison.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "image/tone_map.h"

namespace whittle::test {
namespace {

FloatImage noise(unsigned seed, float brightest = 1.5F) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0, brightest);
  FloatImage image{24, 16, 3, std::vector<float>(24 * 16 * 3)};
  for (float& v : image.pixels) v = value(random);
  return image;
}

std::vector<std::uint8_t> rgbaOf(const FloatImage& light) {
  const auto rgb = toneMap(light, 0);
  std::vector<std::uint8_t> rgba(rgb.size() / 3 * 4, 255);
  for (std::size_t i = 0; i < rgb.size(); ++i) rgba[i / 3 * 4 + i % 3] = rgb[i];
  return rgba;
}

view::Comparable pairOf(const FloatImage& picture, const FloatImage& reference, bool isRadiance) {
  auto result = std::make_shared<RenderResult>();
  result->radiance = picture;
  return {1, result, std::make_shared<const view::Reference>(view::Reference{reference, isRadiance, "r"}),
          rgbaOf, false};
}

/// The last that comes of it.
view::Compared compared(const view::Comparable& pair) {
  view::LiveComparison live([] {});
  live.compare(pair);
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - start < std::chrono::seconds(60)) {
    if (auto now = live.takeCompared(); now && now->figures) return *now;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ADD_FAILURE() << "no figures in a minute";
  return {};
}

TEST(LiveComparison, HasTheFiguresOfCompare) {
  const FloatImage a = noise(1), b = noise(2);
  const view::Compared c = compared(pairOf(a, b, true));
  const ImageMetrics expected = compareImages(a, b);
  ASSERT_TRUE(c.figures);
  EXPECT_EQ(c.figures->rmse, expected.rmse);
  EXPECT_EQ(c.figures->relMse, expected.relMse);
  EXPECT_EQ(c.figures->maxAbs, expected.maxAbs);
  EXPECT_EQ(c.figures->flip, expected.flip);
  EXPECT_EQ(c.figures->differingPixels, expected.differingPixels);
  EXPECT_EQ(c.referenceCodes, rgbaOf(b));
}

TEST(LiveComparison, APictureIsNowhereFromItself) {
  const FloatImage a = noise(3);
  for (const bool isRadiance : {true, false}) {
    FloatImage reference = a;
    if (!isRadiance) {  // as a reader makes the picture's own .png linear
      const auto codes = toneMap(a, 0);
      for (std::size_t i = 0; i < codes.size(); ++i)
        reference.pixels[i] = static_cast<float>(srgbDecode(codes[i] / 255.0));
    }
    const view::Compared c = compared(pairOf(a, reference, isRadiance));
    ASSERT_TRUE(c.figures);
    EXPECT_EQ(c.figures->rmse, 0);
    EXPECT_EQ(c.figures->flip, 0);
    EXPECT_EQ(c.figures->differingPixels, 0U);
    for (std::size_t i = 0; i < c.differenceCodes.size(); ++i)
      ASSERT_EQ(c.differenceCodes[i], i % 4 == 3 ? 255 : 0) << i;
    EXPECT_EQ(c.referenceCodes, rgbaOf(a));
  }
}

/// A code up is that code's share of white, whatever the exposure.
TEST(LiveComparison, OfCodesTheErrorIsOfTheirLight) {
  const FloatImage grey{2, 2, 3, std::vector<float>(12, 0.25F)};
  FloatImage reference = grey;
  const auto codes = toneMap(grey, 0);
  for (std::size_t i = 0; i < codes.size(); ++i)
    reference.pixels[i] = static_cast<float>(srgbDecode((codes[i] + 10) / 255.0));
  const view::Compared c = compared(pairOf(grey, reference, false));
  const double expected = srgbDecode((codes[0] + 10) / 255.0) - srgbDecode(codes[0] / 255.0);
  ASSERT_TRUE(c.figures);
  EXPECT_NEAR(c.figures->rmse, expected, 1e-6);
  EXPECT_NEAR(c.figures->maxAbs, expected, 1e-6);
}

TEST(LiveComparison, WhatCannotBeReadIsAProblem) {
  view::LiveComparison live([] {});
  live.open([]() -> view::Reference { throw std::runtime_error("no such file"); });
  std::optional<view::LiveComparison::Opened> opened;
  for (int i = 0; i < 5000 && !opened; ++i) {
    opened = live.takeOpened();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ASSERT_TRUE(opened);
  EXPECT_EQ(opened->problem, "no such file");
  EXPECT_FALSE(opened->reference);
}

}  // namespace
}  // namespace whittle::test
