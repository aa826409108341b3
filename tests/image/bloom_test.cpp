// Glare: no light lost or made, the same in all directions, and the running sums against plain convolution.
#include "image/bloom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace whittle {
namespace {

double sumOf(const FloatImage& image, std::size_t channel = 0) {
  double sum = 0;
  for (std::size_t i = channel; i < image.pixels.size(); i += static_cast<std::size_t>(image.channels))
    sum += static_cast<double>(image.pixels[i]);
  return sum;
}

FloatImage blackPicture(int width, int height) {
  return {width, height, 3, std::vector<float>(static_cast<std::size_t>(width) * height * 3)};
}

/// One bright pixel, as bright as a sun, in the middle of an odd square.
FloatImage oneSun(int side) {
  FloatImage image = blackPicture(side, side);
  const std::size_t middle = static_cast<std::size_t>(side) * side / 2;
  for (std::size_t c = 0; c < 3; ++c) image.pixels[3 * middle + c] = 1e6F * static_cast<float>(c + 1);
  return image;
}

FloatImage exponentialNoise(int width, int height) {
  std::mt19937 random(3);
  std::exponential_distribution<float> light(1);
  FloatImage image = blackPicture(width, height);
  for (float& v : image.pixels) v = light(random);
  return image;
}

TEST(Bloom, KeepsTheSumOfAllLight) {
  for (const float radius : {0.01F, 0.1F, 0.7F})
    for (const FloatImage& image : {oneSun(61), exponentialNoise(40, 23)}) {
      const FloatImage after = withBloom(image, {0.5F, radius});
      // Each float is rounded twice, by 6e-8 of itself at most.
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sumOf(after, c) / sumOf(image, c), 1, 1e-6) << radius;
    }
}

TEST(Bloom, ASunSpreadsAlikeInAllDirections) {
  constexpr int kSide = 61, kMiddle = kSide / 2;
  const FloatImage after = withBloom(oneSun(kSide), {1, 0.1F});
  const auto at = [&](int dx, int dy) {
    return static_cast<double>(
        after.pixels[3 * (static_cast<std::size_t>(kMiddle + dy) * kSide + kMiddle + dx)]);
  };
  const double most = at(0, 0);
  for (int y = 0; y <= kMiddle; ++y)
    for (int x = 0; x <= kMiddle; ++x) {
      for (const double other : {at(-x, y), at(x, -y), at(-x, -y), at(y, x)})
        EXPECT_NEAR(other, at(x, y), 2e-7 * most) << x << ", " << y;
      const double inner = at(std::max(0, x - 1), y);
      EXPECT_LE(at(x, y), inner + 2e-7 * most) << x << ", " << y;
    }
  // Circles: as far away along (3, 4) as along the axes, 1.6 and 2.5 deviations of the widest.
  EXPECT_NEAR(at(6, 8) / at(10, 0), 1, 0.08) << "six boxes are no Gaussian, but near";
  EXPECT_NEAR(at(9, 12) / at(15, 0), 1, 0.2);
}

/// A line of weights: a box of this variance at each of six turns, each spread by plain convolution.
std::vector<double> sixBoxes(double variance) {
  const double r = std::floor((std::sqrt(12 * variance + 1) - 1) / 2);
  // The weight e of both ends follows from the variance: 2 Σ k² + 2 e (r+1)² = v (2r + 1 + 2e).
  const double full = r * (r + 1) * (2 * r + 1) / 3;
  const double e = (variance * (2 * r + 1) - full) / (2 * ((r + 1) * (r + 1) - variance));
  std::vector<double> box(static_cast<std::size_t>(2 * r + 3), 1 / (2 * r + 1 + 2 * e));
  box.front() *= e, box.back() *= e;
  std::vector<double> line{1};
  for (int k = 0; k < 6; ++k) {
    std::vector<double> wider(line.size() + box.size() - 1);
    for (std::size_t i = 0; i < line.size(); ++i)
      for (std::size_t j = 0; j < box.size(); ++j) wider[i + j] += line[i] * box[j];
    line = wider;
  }
  return line;
}

/// Of a line that goes on mirrored, however far.
int mirroredAt(int i, int length) {
  while (i < 0 || i >= length) i = i < 0 ? -1 - i : 2 * length - 1 - i;
  return i;
}

/// Slow twin: every pixel gathers from all around it, in double.
std::vector<double> gathered(const FloatImage& image, const Bloom& bloom) {
  std::vector<double> sum(image.pixels.begin(), image.pixels.end());
  for (double& v : sum) v *= 1 - static_cast<double>(bloom.strength);
  double deviation = static_cast<double>(bloom.radius) * image.height;
  for (int octave = 0; octave < 5; ++octave, deviation /= 2) {
    const auto line = sixBoxes(deviation * deviation / 6);
    const int reach = static_cast<int>(line.size()) / 2;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        for (int j = -reach; j <= reach; ++j)
          for (int i = -reach; i <= reach; ++i) {
            const double weight = line[static_cast<std::size_t>(j + reach)] *
                                  line[static_cast<std::size_t>(i + reach)] *
                                  static_cast<double>(bloom.strength) / 5;
            const std::size_t to = 3 * (static_cast<std::size_t>(y) * image.width + x);
            const std::size_t from =
                3 * (static_cast<std::size_t>(mirroredAt(y + j, image.height)) * image.width +
                     mirroredAt(x + i, image.width));
            for (std::size_t c = 0; c < 3; ++c)
              sum[to + c] += weight * static_cast<double>(image.pixels[from + c]);
          }
  }
  return sum;
}

TEST(Bloom, RunningSumsGiveWhatPlainConvolutionDoes) {
  for (const float radius : {0.003F, 0.08F, 0.5F}) {
    const FloatImage image = exponentialNoise(27, 18);
    const Bloom bloom{0.3F, radius};
    const auto right = gathered(image, bloom);
    const FloatImage fast = withBloom(image, bloom);
    for (std::size_t i = 0; i < right.size(); ++i)
      ASSERT_NEAR(static_cast<double>(fast.pixels[i]), right[i], 1e-6 * (1 + right[i]))
          << radius << ", " << i;
  }
}

TEST(Bloom, SpreadsAsFarAsItsRadiusSays) {
  // Variance of the sum: each Gaussian's, σ² at both sides, a fifth of the light each. Mirroring cuts nothing
  // off as long as σ is a small part of the image.
  constexpr int kSide = 401;
  constexpr double kRadius = 0.03;
  const FloatImage after = withBloom(oneSun(kSide), {1, static_cast<float>(kRadius)});
  double variance = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      variance += std::pow(x - kSide / 2, 2) *
                  static_cast<double>(after.pixels[3 * (static_cast<std::size_t>(y) * kSide + x)]);
  variance /= sumOf(after);
  double right = 0;
  for (int octave = 0; octave < 5; ++octave) right += std::pow(kRadius * kSide / std::exp2(octave), 2) / 5;
  EXPECT_NEAR(variance / right, 1, 1e-4);
}

TEST(Bloom, NothingIsChangedWhereNothingIsAsked) {
  const FloatImage image = exponentialNoise(9, 7);
  EXPECT_EQ(withBloom(image, {0, 0.1F}).pixels, image.pixels);
  // A constant picture has nothing to spread.
  FloatImage flat = blackPicture(33, 20);
  std::fill(flat.pixels.begin(), flat.pixels.end(), 0.25F);
  for (const float v : withBloom(flat, {0.4F, 0.2F}).pixels) EXPECT_NEAR(v, 0.25F, 1e-7F);
}

TEST(Bloom, WhatIsNotFiniteStaysAndSpreadsNothing) {
  FloatImage image = oneSun(21);
  image.pixels[0] = NAN;
  const FloatImage after = withBloom(image, {0.5F, 0.1F});
  EXPECT_TRUE(std::isnan(after.pixels[0]));
  for (std::size_t i = 3; i < after.pixels.size(); ++i) ASSERT_TRUE(std::isfinite(after.pixels[i])) << i;
}

TEST(Bloom, GreyAndAlphaHaveTheirPlace) {
  const FloatImage oneChannel{3, 1, 1, {0, 9, 0}};
  const FloatImage after = withBloom(oneChannel, {1, 1});
  EXPECT_EQ(after.channels, 1);
  EXPECT_NEAR(sumOf(after), 9, 1e-6);
  FloatImage four{1, 1, 4, {1, 2, 3, 0.5F}};
  EXPECT_EQ(withBloom(four, {0.5F, 0.1F}).pixels[3], 0.5F);
}

TEST(Bloom, ARegionsRadiusIsThatOfThePicture) {
  FloatImage part = oneSun(31);
  const FloatImage whole = withBloom(part, {1, 0.2F});
  part.frame = {31, 62, 0, 31};
  EXPECT_EQ(withBloom(part, {1, 0.1F}).pixels, whole.pixels);
}

}  // namespace
}  // namespace whittle
