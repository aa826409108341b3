// The film's compensated sums, and the sum of a sample's entries, against serial twins.
#include <gtest/gtest.h>

#include <cmath>

#include "kernels/shared/layout.h"
#include "support/kernel_bench.h"
#include "support/random_scenes.h"

namespace whittle {
namespace {

constexpr std::uint32_t kPixels = 7;  // of the picture

/// The film kernel on samples that the test makes up.
class FilmBench {
 public:
  FilmBench() : bench({"film.cl"}) {
    sums_ = bench.compute.upload("sums", std::vector<float>(FILM_PLANES_COVERAGE * kPixels, 0.0F));
    counters_ = bench.compute.upload("counters", std::vector<std::uint32_t>(COUNTERS, 0));
  }
  /// samples: [RADIANCE_PLANES_COVERAGE][capacity], as many slots as the batch has.
  void add(const device::Batch& batch, std::uint32_t capacity, const std::vector<float>& samples) {
    bench.stages.run(stages::Film{.batch = batch,
                                  .capacity = capacity,
                                  .pixels = kPixels,
                                  .blocks = {},
                                  .sampleRadiance = bench.compute.upload("samples", samples),
                                  .sums = sums_,
                                  .counters = counters_});
  }
  std::vector<float> sums() { return bench.read<float>(sums_, FILM_PLANES_COVERAGE * kPixels); }
  std::uint32_t nonFinite() { return bench.read<std::uint32_t>(counters_, COUNTERS)[COUNTER_NONFINITE]; }
  test::KernelBench bench;

 private:
  Buffer sums_, counters_;
};

TEST(Film, AMillionTimesATenth) {
  FilmBench film;
  constexpr std::uint32_t kSamples = 50000, kBatches = 20, kFirst = 2, kCount = 3;
  const std::uint32_t capacity = kSamples * kCount;
  std::vector<float> samples(RADIANCE_PLANES_COVERAGE * capacity, 0.1F);
  for (std::uint32_t i = 0; i < capacity; ++i) samples[2 * capacity + i] = 0.025F;  // blue
  float naive = 0.0F;
  for (std::uint32_t b = 0; b < kBatches; ++b) {
    film.add({kFirst, kCount, b * kSamples, kSamples}, capacity, samples);
    for (std::uint32_t s = 0; s < kSamples; ++s) naive += 0.1F;
  }
  const auto sums = film.sums();
  const double n = double{kBatches} * kSamples;
  const auto mean = [&](int sum, int compensation, std::uint32_t pixel) {
    return (static_cast<double>(sums[static_cast<std::uint32_t>(sum) * kPixels + pixel]) +
            static_cast<double>(sums[static_cast<std::uint32_t>(compensation) * kPixels + pixel])) /
           n;
  };
  const double square = (2 * 0.1 * 0.1 + 0.025 * 0.025) / 3;
  for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    const bool inside = pixel >= kFirst && pixel < kFirst + kCount;
    EXPECT_NEAR(mean(FILM_SUM, FILM_COMPENSATION, pixel), inside ? 0.1 : 0.0, 1e-7);
    EXPECT_NEAR(mean(FILM_SUM + 1, FILM_COMPENSATION + 1, pixel), inside ? 0.1 : 0.0, 1e-7);
    EXPECT_NEAR(mean(FILM_SUM + 2, FILM_COMPENSATION + 2, pixel), inside ? 0.025 : 0.0, 1e-7);
    EXPECT_NEAR(mean(FILM_TRANSMITTANCE, FILM_TRANSMITTANCE_COMPENSATION, pixel), inside ? 0.1 : 0.0, 1e-7);
    EXPECT_NEAR(mean(FILM_SQUARES, FILM_SQUARES_COMPENSATION, pixel), inside ? square : 0.0, 1e-8);
  }
  EXPECT_GT(std::abs(static_cast<double>(naive) / n - 0.1), 5e-4) << "an uncompensated sum would not do";
  EXPECT_EQ(film.nonFinite(), 0U);
}

TEST(Film, SamplesThatAreNotFiniteAreCountedAndLeftOut) {
  FilmBench film;
  constexpr std::uint32_t kSamples = 4, kEntries = 64;
  std::vector<float> samples(RADIANCE_PLANES_COVERAGE * kEntries,
                             std::nanf(""));  // beyond the batch: rubbish that must not be read
  for (std::uint32_t slot = 0; slot < kPixels * kSamples; ++slot)
    for (std::uint32_t c = 0; c < RADIANCE_PLANES_COVERAGE; ++c)
      samples[c * kEntries + slot] = static_cast<float>(slot + 1 + c);
  samples[0 * kEntries + 5] = std::nanf("");
  samples[1 * kEntries + 10] = INFINITY;
  samples[2 * kEntries + 11] = -INFINITY;
  film.add({0, kPixels, 0, kSamples}, kEntries, samples);
  EXPECT_EQ(film.nonFinite(), 3U);
  const auto sums = film.sums();
  for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    for (std::uint32_t c = 0; c < RADIANCE_PLANES_COVERAGE; ++c) {
      const std::uint32_t plane = c == RADIANCE_TRANSMITTANCE ? FILM_TRANSMITTANCE : FILM_SUM + c;
      float expected = 0.0F;  // small integers: exact
      for (std::uint32_t slot = pixel * kSamples; slot < (pixel + 1) * kSamples; ++slot)
        if (slot != 5 && slot != 10 && slot != 11) expected += static_cast<float>(slot + 1 + c);
      EXPECT_EQ(sums[plane * kPixels + pixel], expected) << "pixel " << pixel << " channel " << c;
    }
  }
}

/// Runs of 1 to 300 entries, some across work-groups, a segment that begins and ends inside runs: the same
/// bits as a serial sum in queue order, added to what the samples had; everything else untouched.
TEST(Accumulate, SameBitsAsASerialSum) {
  test::KernelBench bench({"accumulate.cl"});
  constexpr std::uint32_t kEntries = 3000;
  test::Rng rng(51);
  const std::uint32_t lengths[] = {1, 2, 15, 16, 17, 1, 31, 33, 64, 100, 300};
  std::vector<std::uint32_t> slots;
  for (std::uint32_t run = 0; slots.size() < kEntries; ++run)
    slots.insert(slots.end(), lengths[run % std::size(lengths)],
                 (run * 7) % kEntries);  // not in order: any slot may follow
  slots.resize(kEntries);
  constexpr std::size_t kRadiance = std::size_t{RADIANCE_PLANES_COVERAGE} * kEntries;
  std::vector<float> rays(RAY_PLANES * kEntries), radiance(kRadiance), before(kRadiance);
  for (float& x : rays) x = rng.unit();
  for (float& x : radiance) x = rng.unit() * 10;
  for (float& x : before) x = rng.unit();
  std::memcpy(rays.data() + RAY_SLOT * kEntries, slots.data(), kEntries * sizeof(float));
  for (const auto& [first, count] :
       {std::pair{0U, kEntries}, {0U, 1U}, {20U, 1000U}, {3U, 17U}, {700U, 2300U}}) {
    auto expected = before;
    for (std::uint32_t k = 0; k < count; ++k)
      for (std::uint32_t c = 0; c < 3; ++c)
        expected[c * kEntries + slots[first + k]] +=
            rays[(RAY_THROUGHPUT + c) * kEntries + first + k] * radiance[c * kEntries + k];
    for (std::uint32_t k = 0; k < count; ++k) {
      const float* const throughput = &rays[RAY_THROUGHPUT * kEntries + first + k];
      expected[RADIANCE_TRANSMITTANCE * kEntries + slots[first + k]] +=
          (throughput[0] + throughput[kEntries] + throughput[2 * kEntries]) * (1.0F / 3.0F) *
          radiance[RADIANCE_TRANSMITTANCE * kEntries + k];
    }
    const Buffer samples = bench.compute.upload("sampleRadiance", before);
    bench.stages.run(stages::Accumulate{.first = first,
                                        .count = count,
                                        .capacity = kEntries,
                                        .rays = bench.compute.upload("rays", rays),
                                        .entryRadiance = bench.compute.upload("entryRadiance", radiance),
                                        .sampleRadiance = samples});
    EXPECT_EQ(bench.read<float>(samples, kRadiance), expected)
        << "entries " << first << " to " << first + count;
  }
}

}  // namespace
}  // namespace whittle
