// Tone map: exact sRGB below the knee, monotone and hue-keeping above it, non-finite pixels
// shown and counted.
#include "image/tone_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "image/blue_noise.h"

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

/// Hue and chroma in OKLab (Ottosson 2020).
struct Hue {
  double angle, chroma;  ///< degrees
};
Hue hueOf(double r, double g, double b) {
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  const double along = 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s;
  const double across = 0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s;
  return {std::atan2(across, along) * 180 / std::numbers::pi, std::hypot(along, across)};
}
Hue hueOf(const Bytes& codes) {
  return hueOf(srgbDecode(codes[0] / 255.0), srgbDecode(codes[1] / 255.0), srgbDecode(codes[2] / 255.0));
}

/// Corners of sRGB and colours within, the largest channel 1.
constexpr std::array kHues{std::array{1.0F, 0.0F, 0.0F}, std::array{1.0F, 0.4F, 0.05F},
                           std::array{1.0F, 1.0F, 0.0F}, std::array{0.0F, 1.0F, 0.0F},
                           std::array{0.0F, 1.0F, 1.0F}, std::array{0.25F, 0.5F, 1.0F},
                           std::array{0.0F, 0.0F, 1.0F}, std::array{0.3F, 0.0F, 1.0F},
                           std::array{1.0F, 0.0F, 1.0F}, std::array{1.0F, 0.6F, 0.4F}};

TEST(ToneMap, HueStaysHoweverBright) {
  for (const auto& [r, g, b] : kHues) {
    const double hue = hueOf(static_cast<double>(r), static_cast<double>(g), static_cast<double>(b)).angle;
    double chroma = 1;
    for (float stop = -3; stop < 12; stop += 0.25F) {
      const Hue seen = hueOf(toneMap(onePixel(r, g, b), stop));
      // Half a code is 0.002 to 0.006 in a and b where colours are bright, and hue is that over the chroma;
      // what sRGB has no place for on the way to white adds a fifth of a degree.
      const double rounding = std::atan2(0.006, seen.chroma) * 180 / std::numbers::pi;
      if (seen.chroma > 0.03) {
        EXPECT_LT(std::abs(std::remainder(seen.angle - hue, 360)), 0.3 + rounding)
            << r << ", " << g << ", " << b << " at " << stop;
      }
      if (stop > 0) {
        EXPECT_LE(seen.chroma, chroma + 0.006) << "it pales";
      }
      chroma = seen.chroma;
    }
    const Bytes sun = toneMap(onePixel(r, g, b), 20);
    for (const int code : sun) EXPECT_GE(code, 252) << "as bright as a sun it is white";
  }
}

TEST(ToneMap, HueIsExactBelowTheKnee) {
  // The identity: channels keep their ratios, and OKLab's hue does not depend on a common factor.
  const double k = 0.37;
  const Hue one = hueOf(0.8, 0.3, 0.1), other = hueOf(0.8 * k, 0.3 * k, 0.1 * k);
  EXPECT_NEAR(one.angle, other.angle, 1e-9);
  EXPECT_EQ(toneMap(onePixel(0.8F, 0.3F, 0.1F), 0), toneMap(onePixel(0.8F, 0.3F, 0.1F), 0, nullptr, false));
}

TEST(ToneMap, GreyStaysGrey) {
  for (float v = 0.01F; v < 1e6F; v *= 1.3F) {
    const Bytes codes = toneMap(onePixel(v, v, v), 0);
    EXPECT_EQ(codes[0], codes[1]);
    EXPECT_EQ(codes[1], codes[2]);
  }
  EXPECT_EQ(toneMap(onePixel(0.18F, 0.18F, 0.18F), 0), Bytes(3, 118)) << "srgbEncode(0.18) · 255 = 117.6";
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

/// One ray in eight meets a lamp, another in each square; the mean of a square is what many rays would see.
TEST(ToneMap, ExposureByBlocksIsNotThatOfTheNoise) {
  constexpr float kMean = 20;
  FloatImage many{64, 32, 1, std::vector<float>(64 * 32, kMean)}, few{64, 32, 1, std::vector<float>(64 * 32)};
  for (int y = 0; y < few.height; ++y)
    for (int x = 0; x < few.width; ++x)
      few.pixels[static_cast<std::size_t>(y) * 64 + x] = x % 8 == y % 8 ? 7 * kMean : kMean / 7;
  // The mean is (7 + 7/7) / 8 = 1 times kMean; that of the logarithms is 6/8 · log2 7 = 2.1 stops lower.
  EXPECT_NEAR(fittingExposure(many, kNoisyBlock), std::log2(0.18 / kMean), 0.051);
  EXPECT_NEAR(fittingExposure(few, kNoisyBlock), fittingExposure(many, kNoisyBlock), 0.101);
  // Each pixel by itself: 2.1 stops more, but for the highlights, which stay within a stop above white.
  EXPECT_NEAR(fittingExposure(few), 1 - std::log2(7 * kMean), 0.051);
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

/// Mean code of a large flat picture.
double meanCode(float value, bool dithers) {
  constexpr int kSide = 2 * kThresholdSide;
  const auto codes = toneMap({kSide, kSide, 1, std::vector<float>(std::size_t{kSide} * kSide, value)}, 0,
                             nullptr, false, dithers);
  double sum = 0;
  for (std::size_t i = 0; i < codes.size(); i += 3) sum += codes[i];
  return sum / (kSide * kSide);
}

TEST(Dither, TheMeanIsTheValueAndNoPixelIsOffByACode) {
  for (const float value : {0.001F, 0.02F, 0.1234F, 0.5F, 0.77F, 0.99F}) {
    const double right = 255 * srgbEncode(static_cast<double>(value));
    // Every one of 64² thresholds comes equally often.
    EXPECT_NEAR(meanCode(value, true), right, 1.0 / (kThresholdSide * kThresholdSide));
    const auto codes = toneMap({64, 64, 1, std::vector<float>(64 * 64, value)}, 0, nullptr, false, true);
    for (const int code : codes) ASSERT_LT(std::abs(code - right), 1);
  }
}

TEST(Dither, WhatIsACodeStaysThatCode) {
  for (int code = 0; code < 256; ++code) {
    const float v = static_cast<float>(srgbDecode(code / 255.0));
    EXPECT_EQ(meanCode(v, true), code);
  }
}

TEST(Dither, GreyStaysGreyAndAlphaIsRounded) {
  const FloatImage image{64, 64, 3, std::vector<float>(64 * 64 * 3, 0.3F)};
  const auto codes = toneMap(image, 0, nullptr, true, true);
  for (std::size_t i = 0; i < codes.size(); i += 3)
    ASSERT_TRUE(codes[i] == codes[i + 1] && codes[i] == codes[i + 2]);
  const auto clear =
      toneMapWithAlpha(image, {64, 64, 1, std::vector<float>(64 * 64, 0.7501F)}, 0, true, true);
  for (std::size_t i = 3; i < clear.size(); i += 4) ASSERT_EQ(clear[i], 191);
  EXPECT_EQ(toneMap({1, 1, 3, {NAN, 0, 0}}, 0, nullptr, true, true), (Bytes{255, 0, 255}));
}

TEST(Dither, ARegionHasThePatternOfItsPlace) {
  FloatImage whole{50, 40, 1, {}};
  for (int i = 0; i < 50 * 40; ++i) whole.pixels.push_back(static_cast<float>(i) / 2000);
  const FloatImage part = cutOut(whole, {13, 7, 20, 11});
  const auto all = toneMap(whole, 0, nullptr, true, true), own = toneMap(part, 0, nullptr, true, true);
  for (std::size_t y = 0; y < 11; ++y)
    for (std::size_t x = 0; x < 20; ++x)
      ASSERT_EQ(own[3 * (y * 20 + x)], all[3 * ((y + 7) * 50 + x + 13)]) << x << ", " << y;
}

TEST(Dither, ThresholdsAreSpreadEvenly) {
  constexpr int kSide = kThresholdSide;
  std::vector<int> seen(std::size_t{kSide} * kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const double rank = orderedThreshold(x, y) * kSide * kSide - 0.5;
      ASSERT_NEAR(rank, std::round(rank), 1e-9);
      ++seen[static_cast<std::size_t>(std::lround(rank))];
    }
  for (const int times : seen) ASSERT_EQ(times, 1);
  // In squares of 8×8 the mean varies less than a third of what chance would leave: 1/√12/8 = 0.036.
  double squares = 0;
  for (int y = 0; y < kSide; y += 8)
    for (int x = 0; x < kSide; x += 8) {
      double mean = 0;
      for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 8; ++i) mean += orderedThreshold(x + i, y + j) / 64;
      squares += (mean - 0.5) * (mean - 0.5) / 64;
    }
  EXPECT_LT(std::sqrt(squares), 0.012);
}

}  // namespace
}  // namespace whittle
