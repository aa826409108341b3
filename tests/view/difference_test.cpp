// Errors of pixels, their scale and its colours.
#include "view/difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "image/metrics.h"
#include "image/tone_map.h"

namespace whittle::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

FloatImage ofPixels(const std::vector<float>& values) {
  return {static_cast<int>(values.size()) / 3, 1, 3, values};
}

TEST(PixelErrors, AreRootMeanSquaresOverChannels) {
  const FloatImage a = ofPixels({0.3F, 0.4F, 0, 1, 1, 1}), b = ofPixels({0, 0, 0, 1, 1, 1});
  const auto absolute = view::pixelErrors(a, b, false), relative = view::pixelErrors(a, b, true);
  EXPECT_NEAR(absolute[0], std::sqrt(0.25 / 3), 1e-7);
  EXPECT_EQ(absolute[1], 0);
  EXPECT_NEAR(relative[0], std::sqrt(0.25 / 3 / 0.01), 1e-6);
  EXPECT_EQ(relative[1], 0);
}

TEST(PixelErrors, TheirMeanSquaresAreTheFiguresOfCompare) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> value(0, 2);
  FloatImage a{16, 16, 3, std::vector<float>(768)}, b = a;
  for (FloatImage* image : {&a, &b})
    for (float& v : image->pixels) v = value(random);
  const ImageMetrics metrics = compareImages(a, b);
  const auto meanSquare = [&](bool isRelative) {
    double sum = 0;
    for (const float e : view::pixelErrors(a, b, isRelative))
      sum += static_cast<double>(e) * static_cast<double>(e);
    return sum / 256;
  };
  EXPECT_NEAR(std::sqrt(meanSquare(false)), metrics.rmse, 1e-6 * metrics.rmse);
  EXPECT_NEAR(meanSquare(true), metrics.relMse, 1e-6 * metrics.relMse);
}

TEST(ErrorScale, EndsAtThePowerOfTenAboveTheLargest) {
  for (const auto& [most, high] :
       {std::pair(0.3F, 1.0), std::pair(1.0F, 1.0), std::pair(1.5F, 10.0), std::pair(2e-6F, 1e-5)}) {
    const view::ErrorScale scale = view::scaleOf({0, most, kInfinity, NAN});
    EXPECT_NEAR(scale.high / high, 1, 1e-12) << most;
    EXPECT_NEAR(scale.high / scale.low, 1e4, 1e-6) << most;
  }
  EXPECT_EQ(view::scaleOf({0, 0}).high, view::ErrorScale().high);
}

/// By the definition, from linear sRGB.
std::array<double, 3> okLabOf(const std::array<std::uint8_t, 3>& code) {
  std::array<double, 3> v{};
  for (std::size_t i = 0; i < 3; ++i) v[i] = srgbDecode(code[i] / 255.0);
  const double l = std::cbrt(0.4122214708 * v[0] + 0.5363325363 * v[1] + 0.0514459929 * v[2]),
               m = std::cbrt(0.2119034982 * v[0] + 0.6806995451 * v[1] + 0.1073969566 * v[2]),
               s = std::cbrt(0.0883024619 * v[0] + 0.2817188376 * v[1] + 0.6299787005 * v[2]);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

TEST(ErrorColors, GrowLighterInEqualSteps) {
  const auto& colors = view::errorColors();
  constexpr std::size_t kSteps = 15;
  std::vector<double> steps;
  for (std::size_t i = 0; i < kSteps; ++i) {
    const auto a = okLabOf(colors[i * 17]), b = okLabOf(colors[(i + 1) * 17]);
    EXPECT_GT(b[0], a[0]) << i;
    steps.push_back(std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]));
  }
  const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
  EXPECT_LT(*most / *least, 1.1) << "codes round";
}

TEST(ErrorCodes, HaveTheScalesColours) {
  const view::ErrorScale scale{1e-3, 10};
  const auto codes = view::errorCodes({0, 1e-3F, 10, 1e-9F, 1e9F, NAN, kInfinity, 0.1F}, scale);
  const auto at = [&](std::size_t p) {
    EXPECT_EQ(codes[4 * p + 3], 255);
    return std::array<std::uint8_t, 3>{codes[4 * p], codes[4 * p + 1], codes[4 * p + 2]};
  };
  using Code = std::array<std::uint8_t, 3>;
  const auto& colors = view::errorColors();
  EXPECT_EQ(at(0), (Code{0, 0, 0}));
  EXPECT_EQ(at(1), colors.front());
  EXPECT_EQ(at(2), colors.back());
  EXPECT_EQ(at(3), colors.front());
  EXPECT_EQ(at(4), colors.back());
  EXPECT_EQ(at(5), (Code{255, 0, 255}));
  EXPECT_EQ(at(6), (Code{255, 0, 255}));
  EXPECT_EQ(at(7), colors[128]) << "two of four decades";
}

}  // namespace
}  // namespace whittle::test
