// Tone map: exact sRGB below the knee, monotone and hue-keeping above it, non-finite pixels
// shown and counted.
#include "image/tone_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whittle {
namespace {

using Bytes = std::vector<std::uint8_t>;

FloatImage onePixel(float r, float g, float b) { return {1, 1, 3, {r, g, b}}; }

TEST(ToneMap, givesKnownSrgbCodes) {
  // IEC 61966-2-1: 0.0031308 is where the curve's two parts meet, linear 0.2140 is code 127.5, 0.5 is 187.5
  // (rounded up: 1.055·0.5^(1/2.4) − 0.055 = 0.735357, times 255 = 187.516).
  EXPECT_EQ(toneMap(onePixel(0.0F, 0.0031308F, 0.5F), 0), (Bytes{0, 10, 188}));
  EXPECT_EQ(toneMap(onePixel(0.2139F, 0.2142F, 0.8F), 0), (Bytes{127, 128, 231}));
  EXPECT_EQ(toneMap(onePixel(-3.0F, 0.0001F, 0.0002F), 0), (Bytes{0, 0, 1}));
}

TEST(ToneMap, returnsEveryCodeToItself) {
  for (int code = 0; code < 256; ++code) {
    const double linear = srgbDecode(code / 255.0);
    EXPECT_NEAR(srgbEncode(linear) * 255, code, 1e-4) << "the standard's two halves meet to about 1e-7";
    if (linear > kToneKnee) continue;
    const float v = static_cast<float>(linear);
    EXPECT_EQ(toneMap(onePixel(v, v, v), 0), Bytes(3, static_cast<std::uint8_t>(code)));
  }
}

TEST(ToneMap, exposureIsPowersOfTwo) {
  EXPECT_EQ(toneMap(onePixel(0.1F, 0.05F, 0.025F), 2), toneMap(onePixel(0.4F, 0.2F, 0.1F), 0));
  EXPECT_EQ(toneMap(onePixel(0.4F, 0.2F, 0.1F), -1), toneMap(onePixel(0.2F, 0.1F, 0.05F), 0));
}

TEST(ToneMap, rollOffIsSmoothMonotoneAndBelowOne) {
  EXPECT_EQ(rollOff(kToneKnee), kToneKnee);
  // Slope 1 on both sides of the knee: over a step h the curve bends by at most h²/d with d = 0.2.
  const double h = 1e-4;
  EXPECT_NEAR(rollOff(kToneKnee + h), kToneKnee + h, h * h / 0.2 * 1.001);
  EXPECT_NEAR(rollOff(1.0), 1 - 0.04 / 0.4, 1e-15);
  double last = 0;
  for (double v = 0; v < 1e4; v += v < 2 ? 0.001 : 0.1) {
    const double mapped = rollOff(v);
    EXPECT_GE(mapped, last);
    EXPECT_LT(mapped, 1.0);
    last = mapped;
  }
}

TEST(ToneMap, brighterIsNeverDarkerInAnyChannel) {
  for (const auto& color :
       {std::array{1.0F, 0.2F, 0.1F}, std::array{0.3F, 0.9F, 1.0F}, std::array{1.0F, 1.0F, 0.0F}}) {
    Bytes last(3, 0);
    for (float stop = -6; stop < 14; stop += 0.05F) {
      const Bytes now = toneMap(onePixel(color[0], color[1], color[2]), stop);
      for (int c = 0; c < 3; ++c) EXPECT_GE(now[c], last[c]) << "stop " << stop << " channel " << c;
      last = now;
    }
  }
}

TEST(ToneMap, keepsTheOrderOfChannelsInHighlights) {
  // Clipped one by one, (4, 2, 1) would be white; here orange stays orange.
  const Bytes orange = toneMap(onePixel(4, 2, 1), 0);
  EXPECT_GT(orange[0], orange[1] + 20);
  EXPECT_GT(orange[1], orange[2] + 20);
}

TEST(ToneMap, showsAndCountsWhatIsNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const FloatImage image{4, 1, 3, {0, nan, 0, inf, 0, 0, 0.5F, 0.5F, 0.5F, 3e38F, 3e38F, 3e38F}};
  std::uint64_t bad = 99;
  EXPECT_EQ(toneMap(image, 3, &bad), (Bytes{255, 0, 255, 255, 0, 255, 254, 254, 254, 255, 255, 255}));
  EXPECT_EQ(bad, 2U);
}

TEST(ToneMap, takesGreyAndLeavesAlphaOut) {
  EXPECT_EQ(toneMap({1, 1, 1, {0.5F}}, 0), Bytes(3, 188));
  EXPECT_EQ(toneMap({1, 1, 2, {0.5F, 0.1F}}, 0), Bytes(3, 188));
  EXPECT_EQ(toneMap({1, 2, 4, {0.5F, 0, 0.5F, 0.1F, 0, 0.5F, 0, 1}}, 0), (Bytes{188, 0, 188, 0, 188, 0}));
}

FloatImage grey(const std::vector<float>& values) { return {static_cast<int>(values.size()), 1, 1, values}; }

TEST(ToneMap, ExposureIsChosenOnlyWhereThePictureDoesNotFit) {
  EXPECT_EQ(fittingExposure(grey({0, 0.1F, 0.3F, 0.8F, 2})), 0);
  EXPECT_EQ(fittingExposure(grey({0, 0, 0})), 0);
  EXPECT_EQ(fittingExposure(grey({NAN, INFINITY, 0.2F})), 0);
  // All of one value: that becomes 18 %.
  EXPECT_NEAR(fittingExposure(grey({1000, 1000, 1000, 0})), std::log2(0.18 / 1000), 0.051);
  EXPECT_NEAR(fittingExposure(grey({1e-4F, 1e-4F})), std::log2(0.18 / 1e-4), 0.051);
  // Highlights are kept: half the picture is 1, half 1e5, which must not go beyond 2.
  const float stops = fittingExposure(grey({1, 1, 1e5F, 1e5F}));
  EXPECT_NEAR(stops, std::log2(2 / 1e5), 0.051);
}

TEST(ToneMap, WithoutRollOffEachCodeComesOutAsItWentIn) {
  std::vector<float> values;
  for (int i = 0; i < 256; ++i) values.push_back(static_cast<float>(srgbDecode(i / 255.0)));
  const auto bytes = toneMap(grey(values), 0, nullptr, false);
  for (int i = 0; i < 256; ++i) EXPECT_EQ(bytes[3 * static_cast<std::size_t>(i)], i);
  EXPECT_EQ(toneMap(grey({7}), 0, nullptr, false)[0], 255);
}

/// Beside every border between two codes, and at it: as many borders as are not above the value.
TEST(ToneMap, ACodeIsTheNumberOfBordersUpToTheValue) {
  std::vector<double> borders;
  for (int i = 0; i < 255; ++i) borders.push_back(srgbDecode((i + 0.5) / 255.0));
  FloatImage image{255 * 3, 1, 1, {}};
  for (const double border : borders) {
    const auto at = static_cast<float>(border);
    for (const float v : {std::nextafter(at, 0.0F), at, std::nextafter(at, 1.0F)}) image.pixels.push_back(v);
  }
  const auto codes = toneMap(image, 0, nullptr, false);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const auto expected = std::count_if(borders.begin(), borders.end(), [&](double border) {
      return border <= static_cast<double>(image.pixels[i]);
    });
    EXPECT_EQ(codes[3 * i], expected) << image.pixels[i];
  }
}

}  // namespace
}  // namespace whittle
