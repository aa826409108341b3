// Samples that go where the error is: what each pixel gets is what a plain render with as many
// samples gives it.
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "support/pictures.h"
#include "wavefront/sample_counts.h"

namespace whittle::test {
namespace {

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();
constexpr std::size_t kPixels = 64 * 5 + 10;  // six blocks, the last of ten pixels

SampleCounts countsOf(std::uint32_t samples) {
  SampleCounts counts(kPixels);
  for (std::size_t b = 0; b < counts.blocks(); ++b) counts.add(b, samples);
  return counts;
}

TEST(SampleCounts, TheLastBlockIsShorter) {
  SampleCounts counts = countsOf(16);
  EXPECT_EQ(counts.blocks(), 6U);
  EXPECT_EQ(counts.pixelsOf(0), 64U);
  EXPECT_EQ(counts.pixelsOf(5), 10U);
  counts.add(5, 16);
  EXPECT_EQ(counts.total(), 64U * 5 * 16 + 10 * 32);
  EXPECT_EQ(counts.least(), 16U);
  EXPECT_EQ(counts.most(), 32U);
  EXPECT_EQ(counts.ofPixel(319), 16U);
  EXPECT_EQ(counts.ofPixel(320), 32U);
}

TEST(AdaptivePasses, DoubleWhereASampleTakesMostOffTheError) {
  const SampleCounts counts = countsOf(16);
  // Block 5 is a sixth of the others' size: its gain for each sample is the largest though its
  // variance is not.
  const std::vector<double> variances{1.0, 4.0, 0.0, 2.0, 3.0, 1.0};
  const auto passes = adaptivePasses(counts, variances, 16 * (10 + 64 + 64), kNoLimit);
  ASSERT_EQ(passes.size(), 1U);
  EXPECT_EQ(passes[0].firstSample, 16U);
  EXPECT_EQ(passes[0].samples, 16U);
  EXPECT_EQ(passes[0].blocks, (std::vector<std::uint32_t>{1, 4, 5}));
}

TEST(AdaptivePasses, BlocksOfOtherCountsGetPassesOfTheirOwn) {
  SampleCounts counts = countsOf(16);
  counts.add(3, 16);
  const auto passes = adaptivePasses(counts, {1, 1, 1, 8, 1, 1}, 64 * 32 + 10 * 16 + 1, kNoLimit);
  ASSERT_EQ(passes.size(), 2U);
  EXPECT_EQ(passes[0].firstSample, 16U);
  EXPECT_EQ(passes[0].blocks, std::vector<std::uint32_t>{5});
  EXPECT_EQ(passes[1].firstSample, 32U);
  EXPECT_EQ(passes[1].samples, 32U);
  EXPECT_EQ(passes[1].blocks, std::vector<std::uint32_t>{3});
}

TEST(AdaptivePasses, NoBlockFallsBehindForGood) {
  SampleCounts counts = countsOf(16);
  for (std::size_t b = 1; b < 5; ++b) counts.add(b, 1008);
  // The mean is above 8 · 16: the two blocks without any variance come first.
  const auto passes = adaptivePasses(counts, {0, 5, 5, 5, 5, 0}, 74 * 16, kNoLimit);
  ASSERT_EQ(passes.size(), 1U);
  EXPECT_EQ(passes[0].blocks, (std::vector<std::uint32_t>{0, 5}));
}

TEST(AdaptivePasses, NothingWhereNothingVaries) {
  EXPECT_TRUE(adaptivePasses(countsOf(16), std::vector<double>(6, 0.0), 1 << 20, kNoLimit).empty());
}

TEST(AdaptivePasses, TheLastBlockGetsWhatIsLeftOfTheLimit) {
  const SampleCounts counts = countsOf(16);
  const std::uint64_t limit = 64 * 16 + 64 * 5 + 63;
  const auto passes = adaptivePasses(counts, {1, 4, 0, 2, 3, 0}, limit, limit);
  ASSERT_EQ(passes.size(), 2U);
  EXPECT_EQ(passes[0].samples, 5U);
  EXPECT_EQ(passes[0].blocks, std::vector<std::uint32_t>{4});
  EXPECT_EQ(passes[1].samples, 16U);
  EXPECT_EQ(passes[1].blocks, std::vector<std::uint32_t>{1});
  EXPECT_TRUE(adaptivePasses(counts, {1, 4, 0, 2, 3, 0}, 63, 63).empty())
      << "less than a sample for each pixel";
}

TEST(AdaptivePasses, OneBlockMayGoBeyondTheBudgetButNotBeyondTheLimit) {
  const SampleCounts counts = countsOf(16);
  const auto passes = adaptivePasses(counts, {1, 4, 0, 2, 3, 0}, 1, 64 * 9);
  ASSERT_EQ(passes.size(), 1U);
  EXPECT_EQ(passes[0].samples, 9U);
  EXPECT_EQ(passes[0].blocks, std::vector<std::uint32_t>{1});
}

TEST(Adaptive, EachPixelIsThatOfAPlainRenderWithItsSamples) {
  for (const Sampler sampler : {Sampler::Random, Sampler::Sobol}) {
    Settings settings = wholeSettings(4);
    settings.width = 100;  // 5,400 pixels: the last block is not whole
    settings.sampler = sampler;
    settings.raysPerPixel = 48;
    settings.adaptive = settings.aovs = true;
    const Scene scene = ownScene("cornell_box");
    const RenderResult adaptive = renderOnDevice(scene, settings);
    EXPECT_GE(adaptive.stats.samples.least, 16U);
    EXPECT_GT(adaptive.stats.samples.most, 32U);
    // What is left over is less than a sample for each pixel of one block.
    EXPECT_LE(adaptive.stats.samples.mean, 48.0);
    EXPECT_GT(adaptive.stats.samples.mean, 48.0 - 64.0 / 5400.0);
    EXPECT_EQ(adaptive.stats.dropped, 0U);
    const FloatImage& samples = adaptive.aovs.at("samples");
    settings.adaptive = settings.aovs = false;
    std::size_t compared = 0;
    for (const float n : std::set<float>(samples.pixels.begin(), samples.pixels.end())) {
      settings.raysPerPixel = static_cast<int>(n);
      const FloatImage plain = renderOnDevice(scene, settings).radiance;
      for (std::size_t p = 0; p < samples.pixels.size(); ++p) {
        if (samples.pixels[p] != n) continue;
        ++compared;
        ASSERT_EQ(std::memcmp(&plain.pixels[3 * p], &adaptive.radiance.pixels[3 * p], 12), 0)
            << "pixel " << p << " of " << n << " samples";
      }
    }
    EXPECT_EQ(compared, samples.pixels.size());
  }
}

TEST(Adaptive, TakesMoreOffTheTrueErrorThanTheSameRaysEverywhere) {
  const Scene scene = ownScene("anti_aliasing");
  Settings settings = wholeSettings(2);
  settings.raysPerPixel = 4096;
  settings.seed = 77;
  const FloatImage converged = renderOnDevice(scene, settings).radiance;
  settings.raysPerPixel = 64;
  settings.seed = 1;
  RenderHooks hooks;
  hooks.reference = &converged;
  const ErrorPoint plain = renderOnDevice(scene, settings, hooks).stats.error.back();
  settings.adaptive = true;
  const ErrorPoint adaptive = renderOnDevice(scene, settings, hooks).stats.error.back();
  EXPECT_LT(*adaptive.rmse, *plain.rmse);
  // An estimate over 5,184 pixels, of which a few hundred matter, with the reference's own error of an eighth
  // of it (or a quarter, where samples went) on top.
  EXPECT_NEAR(*plain.rmse / plain.estimate, 1.0, 0.1);
  EXPECT_NEAR(*adaptive.rmse / adaptive.estimate, 1.0, 0.2);
}

/// The film's squares are floats: what leaves their range must not pass for certainty.
TEST(ErrorEstimate, IsInfiniteWhereSquaresOverflow) {
  Scene scene = ownScene("cornell_box");
  for (Light& light : scene.lights) light.intensity *= 1e30F;
  Settings settings = wholeSettings(2);
  settings.raysPerPixel = 4;
  const RenderResult result = renderOnDevice(scene, settings);
  EXPECT_EQ(result.stats.nonFinite, 0U);
  EXPECT_TRUE(std::isinf(result.stats.error.back().estimate)) << result.stats.error.back().estimate;
}

/// Deep glass: each sample is thousands of rays, and the first pass takes longer than the limit.
TEST(TimeLimit, EveryPixelGetsOneRayAndNoMoreThanFit) {
  Settings settings = wholeSettings(10);
  settings.raysPerPixel = 1 << 16;
  settings.timeLimit = 0.05;
  const RenderResult result = renderOnDevice(ownScene("nested_glass"), settings);
  EXPECT_EQ(result.stats.samples.least, 1U);
  EXPECT_LE(result.stats.samples.most, 2U);
  EXPECT_EQ(result.stats.dropped, 0U);
  settings.timeLimit = 0.0;
  settings.raysPerPixel = 2;
  const FloatImage two = renderOnDevice(ownScene("nested_glass"), settings).radiance;
  EXPECT_GT(std::accumulate(two.pixels.begin(), two.pixels.end(), 0.0F), 0.0F);
  for (const float x : result.radiance.pixels) ASSERT_TRUE(std::isfinite(x));
}

TEST(TimeLimit, ABatchThatIsStoppedLeavesTheFilmAsItWas) {
  // Whatever the limit cuts, blocks have whole samples: each pixel is that of a plain render with its count.
  const Scene scene = ownScene("nested_glass");
  Settings settings = wholeSettings(6);
  settings.raysPerPixel = 1 << 16;
  settings.aovs = true;
  settings.wavefront = 2048;
  settings.timeLimit = 0.4;
  const RenderResult cut = renderOnDevice(scene, settings);
  ASSERT_LE(cut.stats.samples.most, 4096U) << "a machine that fast needs a deeper scene here";
  settings.timeLimit = 0.0;
  settings.aovs = false;
  const FloatImage& samples = cut.aovs.at("samples");
  for (const std::uint32_t n : {cut.stats.samples.least, cut.stats.samples.most}) {
    settings.raysPerPixel = static_cast<int>(std::max(2U, n));
    if (n < 2) continue;  // one ray alone goes through the centre
    const FloatImage plain = renderOnDevice(scene, settings).radiance;
    for (std::size_t p = 0; p < samples.pixels.size(); ++p) {
      if (samples.pixels[p] != static_cast<float>(n)) continue;
      ASSERT_EQ(std::memcmp(&plain.pixels[3 * p], &cut.radiance.pixels[3 * p], 12), 0) << "pixel " << p;
    }
  }
}

}  // namespace
}  // namespace whittle::test
