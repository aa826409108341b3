// Sample positions: evenly spread where they promise it, unbiased everywhere.
#include "reference/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace whittle::test {
namespace {

using reference::samplePosition;
using reference::Vec2;

TEST(Sampler, OneRayGoesThroughTheCentre) {
  for (const Sampler s : {Sampler::Random, Sampler::Stratified, Sampler::Sobol}) {
    EXPECT_EQ(samplePosition(s, 77, 0, 1, 5), Vec2(0.5));
  }
}

TEST(Sampler, EveryPositionIsInsideThePixel) {
  for (const Sampler s : {Sampler::Random, Sampler::Stratified, Sampler::Sobol}) {
    for (std::uint32_t i = 0; i < 4000; ++i) {
      const Vec2 p = samplePosition(s, i / 40, i % 40, 40, 1);
      EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
    }
  }
}

TEST(Sampler, StratifiedPutsOneSampleInEachCell) {
  for (const std::uint32_t n : {2U, 9U, 16U, 30U}) {
    const auto m = static_cast<std::uint32_t>(std::sqrt(n));
    std::set<std::pair<int, int>> cells;
    for (std::uint32_t s = 0; s < m * m; ++s) {
      const Vec2 p = samplePosition(Sampler::Stratified, 1234, s, n, 9) * static_cast<double>(m);
      cells.emplace(static_cast<int>(p.x), static_cast<int>(p.y));
    }
    EXPECT_EQ(cells.size(), m * m) << n;
  }
}

/// Whether each elementary interval of area 1/2^bits holds one of the samples first … first + 2^bits − 1.
void expectNet(std::uint32_t pixel, std::uint32_t seed, std::uint32_t first, int bits) {
  for (int columnBits = 0; columnBits <= bits; ++columnBits) {
    const double columns = std::exp2(columnBits), rows = std::exp2(bits - columnBits);
    std::set<std::pair<int, int>> intervals;
    for (std::uint32_t s = 0; s < (1U << bits); ++s) {
      const Vec2 p = samplePosition(Sampler::Sobol, pixel, first + s, 64, seed);
      intervals.emplace(static_cast<int>(p.x * columns), static_cast<int>(p.y * rows));
    }
    ASSERT_EQ(intervals.size(), 1U << bits)
        << "pixel " << pixel << " seed " << seed << " columns " << columns;
  }
}

TEST(Sampler, SobolPointsAreNets) {
  for (std::uint32_t pixel = 0; pixel < 50; ++pixel) {
    for (const std::uint32_t seed : {0U, 1U, 0xffffffffU}) {
      expectNet(pixel, seed, 0, 4);
      expectNet(pixel, seed, 16, 4);  // and so is every aligned block
      expectNet(pixel, seed, 0, 6);
    }
  }
}

TEST(Sampler, SobolPixelsDiffer) {
  std::set<std::pair<double, double>> firsts;
  for (std::uint32_t pixel = 0; pixel < 1000; ++pixel) {
    const Vec2 p = samplePosition(Sampler::Sobol, pixel, 0, 16, 3);
    firsts.emplace(p.x, p.y);
  }
  EXPECT_GT(firsts.size(), 990U);
}

/// The mean of N uniform numbers is off by more than 4.5 σ, σ² = 1/(12 N), once in 150 000 tries.
TEST(Sampler, MeansAreOneHalf) {
  constexpr int kCount = 100000;
  for (const Sampler s : {Sampler::Random, Sampler::Stratified, Sampler::Sobol}) {
    Vec2 sum(0);
    double product = 0;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const Vec2 p = samplePosition(s, i / 5, i % 5, 5, 17);
      sum += p;
      product += p.x * p.y;
    }
    const double bound = 4.5 / std::sqrt(12.0 * kCount);
    EXPECT_NEAR(sum.x / kCount, 0.5, bound);
    EXPECT_NEAR(sum.y / kCount, 0.5, bound);
    // xy has the variance 1/9 − 1/16 where x and y are independent.
    if (s != Sampler::Random) continue;
    EXPECT_NEAR(product / kCount, 0.25, 4.5 * std::sqrt((1 / 9.0 - 1 / 16.0) / kCount));
  }
}

TEST(Sampler, HashesAreUniformOverBytes) {
  // χ² of 255 degrees of freedom: mean 255, σ = √510; within 5 σ.
  for (std::uint32_t dimension = 0; dimension < 20; ++dimension) {
    std::vector<int> bins(256);
    constexpr int kCount = 1 << 16;
    for (std::uint32_t i = 0; i < kCount; ++i) ++bins[reference::hash(i, 0, dimension, 0) >> 24];
    double chiSquared = 0;
    for (const int n : bins) chiSquared += (n - 256.0) * (n - 256.0) / 256.0;
    EXPECT_NEAR(chiSquared, 255, 5 * std::sqrt(510.0)) << dimension;
  }
}

}  // namespace
}  // namespace whittle::test
