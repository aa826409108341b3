// compact.cl and find_long_runs against serial twins on the host: which entries, in which order, for chunks
// that divide the count, that do not, and that are longer than it; how much throughput ended.
#include <gtest/gtest.h>

#include "analysis/scene_features.h"
#include "kernels/shared/features.h"
#include "kernels/shared/layout.h"
#include "support/kernel_bench.h"
#include "support/random_scenes.h"

namespace whittle {
namespace {

constexpr std::uint32_t kCapacity =
    4160;  // entries a queue has room for; of every chunk here none divides it but 1 and 32
/// With all features.
constexpr std::uint32_t kRayPlanes = RAY_PLANES_STRAIGHT + CONE_PLANES,
                        kImpulsePlanes = IMPULSE_PLANES + CONE_PLANES,
                        kAllImpulsePlanes = 2 * kImpulsePlanes + 2 * (SPLIT_PLANES + CONE_PLANES);
constexpr std::uint32_t kUntouched = 0xdeadbeefU;

enum class Pattern { None, All, Random, OnlyLast };

std::vector<std::uint32_t> makeFlags(Pattern pattern, std::uint32_t count) {
  test::Rng rng(count + 17);
  std::vector<std::uint32_t> flags(kCapacity + QUEUE_PADDING,
                                   ENTRY_SHADOW | ENTRY_IMPULSE0 | ENTRY_ENDED1);  // beyond count: rubbish
  for (std::uint32_t i = 0; i < count; ++i) {
    if (pattern == Pattern::None) flags[i] = 0;
    if (pattern == Pattern::Random) flags[i] = static_cast<std::uint32_t>(rng.bits() & 255U);
    if (pattern == Pattern::OnlyLast && i + 1 < count) flags[i] = 0;
  }
  return flags;
}

/// The compaction of one chunk length, launched as the wavefront launches it.
class Compaction {
 public:
  explicit Compaction(std::uint32_t chunk)
      : bench({"compact.cl"}, "", test::kAllFeatures, static_cast<int>(chunk)), chunk_(chunk) {
    totals_ = bench.compute.allocate("totals", SUMS * (kCapacity / chunk + 1) * sizeof(std::uint32_t));
    sums_ = bench.compute.allocate("sums", SUMS * sizeof(std::uint32_t));
  }

  /// Indices of the entries with a shadow ray; the whole buffer, so that writes beyond the end show.
  std::vector<std::uint32_t> shadow(const std::vector<std::uint32_t>& flags, std::uint32_t count) {
    const Buffer f = upload(flags);
    scan(f, count, 0);
    return shadowsOf(f, count, 0);
  }

  /// The same of set 1, whose flags come behind those of set 0, with the sums of that on the device; and the
  /// places of the impulses' chunks after it.
  std::vector<std::uint32_t> secondShadow(const std::vector<std::uint32_t>& first,
                                          const std::vector<std::uint32_t>& second, std::uint32_t count) {
    std::vector<std::uint32_t> flags = first;
    flags.resize(kCapacity, 0);
    flags.insert(flags.end(), second.begin(), second.end());
    const Buffer f = upload(flags);
    scan(f, count, 1);
    const auto before = bench.read<std::uint32_t>(totals_, 2 * std::size_t{chunks(count)});
    bench.stages.run(stages::CompactCount{
        .count = count, .capacity = kCapacity, .set = 1, .flags = f, .impulses = {}, .totals = totals_});
    bench.stages.run(
        stages::ScanChunks{.chunks = chunks(count), .kinds = SUM_IMPULSE, .totals = totals_, .sums = sums_});
    const auto after = bench.read<std::uint32_t>(totals_, 2 * std::size_t{chunks(count)});
    for (std::size_t i = chunks(count); i < after.size(); ++i) EXPECT_EQ(after[i], before[i]) << i;
    found = bench.read<std::uint32_t>(sums_, 1)[0];
    return shadowsOf(f, count, 1);
  }

  /// The next ray queue, bits of all its planes, room for all rays of each entry.
  std::vector<std::uint32_t> impulse(const std::vector<std::uint32_t>& flags, std::uint32_t first,
                                     std::uint32_t count, const std::vector<std::uint32_t>& impulses,
                                     const std::vector<std::uint32_t>& rays,
                                     const std::vector<std::uint32_t>& hits) {
    const Buffer f = upload(flags);
    const Buffer from = bench.compute.upload("impulses", impulses),
                 queue = bench.compute.upload("rays", rays);
    const Buffer next =
        bench.compute.upload("next", std::vector<std::uint32_t>(kRayPlanes * kCapacity, kUntouched));
    countAndScan(f, count, from);
    found = bench.read<std::uint32_t>(sums_, 2)[1];
    bench.stages.run(stages::CompactImpulse{.first = first,
                                            .count = count,
                                            .capacity = kCapacity,
                                            .bounce = 2,
                                            .flags = f,
                                            .offsets = totals_,
                                            .impulses = from,
                                            .rays = queue,
                                            .hits = bench.compute.upload("hits", hits),
                                            .next = next});
    return bench.read<std::uint32_t>(next, kRayPlanes * kCapacity);
  }

  EndedUnits ended(const std::vector<std::uint32_t>& flags, const std::vector<float>& impulses,
                   std::uint32_t count) {
    countAndScan(upload(flags), count, bench.compute.upload("impulses", impulses));
    const auto sums = bench.read<std::uint32_t>(sums_, SUMS);
    EndedUnits units{};
    for (std::size_t kind = 0; kind < ENDED_KINDS; ++kind)
      units[kind] = std::uint64_t{sums[SUM_ENDED + 2 * kind + 1]} << 32 | sums[SUM_ENDED + 2 * kind];
    return units;
  }

  std::uint32_t found = 0;  ///< of the last compaction
  test::KernelBench bench;

 private:
  std::vector<std::uint32_t> shadowsOf(const Buffer& flags, std::uint32_t count, std::uint32_t set) {
    const Buffer queue =
        bench.compute.upload("shadowQueue", std::vector<std::uint32_t>(kCapacity, kUntouched));
    bench.stages.run(stages::CompactShadow{.count = count,
                                           .capacity = kCapacity,
                                           .set = set,
                                           .flags = flags,
                                           .offsets = totals_,
                                           .shadowQueue = queue});
    return bench.read<std::uint32_t>(queue, kCapacity);
  }
  Buffer upload(const std::vector<std::uint32_t>& flags) {
    return bench.compute.upload("flags", std::vector<std::uint8_t>(flags.begin(), flags.end()));
  }
  std::uint32_t chunks(std::uint32_t count) const { return (count + chunk_ - 1) / chunk_; }
  void countAndScan(const Buffer& flags, std::uint32_t count, const Buffer& impulses) {
    bench.stages.run(stages::CompactCount{
        .count = count, .capacity = kCapacity, .flags = flags, .impulses = impulses, .totals = totals_});
    bench.stages.run(stages::ScanChunks{
        .chunks = chunks(count),
        .kinds = impulses ? std::uint32_t{SUM_ENDED + ENDED_KINDS} : std::uint32_t{SUM_ENDED},
        .totals = totals_,
        .sums = sums_});
  }
  /// kind: 0 shadow rays, 1 impulses.
  void scan(const Buffer& flags, std::uint32_t count, std::size_t kind) {
    countAndScan(flags, count, {});
    found = bench.read<std::uint32_t>(sums_, 2)[kind];
  }

  std::uint32_t chunk_;
  Buffer totals_, sums_;
};

std::vector<std::uint32_t> distinctWords(std::size_t count, std::uint32_t first) {
  std::vector<std::uint32_t> words(count);
  for (std::size_t i = 0; i < count; ++i) words[i] = first + static_cast<std::uint32_t>(i);
  return words;
}

void checkShadow(Compaction& compaction, Pattern pattern, std::uint32_t count) {
  const auto flags = makeFlags(pattern, count);
  std::vector<std::uint32_t> expected;
  for (std::uint32_t i = 0; i < count; ++i)
    if (flags[i] & ENTRY_SHADOW) expected.push_back(i);
  const auto wanted = expected.size();
  expected.resize(kCapacity, kUntouched);
  const auto queue = compaction.shadow(flags, count);
  EXPECT_EQ(compaction.found, wanted);
  EXPECT_EQ(queue, expected);
}

/// Of two impulse candidates and the ways of two more colours. The second's throughput is below 0 here and
/// there.
std::vector<std::uint32_t> manyImpulses() {
  auto words = distinctWords(kAllImpulsePlanes * kCapacity, 0x3f000000U);
  for (std::uint32_t channel = 0; channel < 3; ++channel)
    for (std::uint32_t i = channel; i < kCapacity; i += 2 + channel)
      words[(kImpulsePlanes + IMPULSE_THROUGHPUT + channel) * kCapacity + i] |= 1U << 31;
  return words;
}

bool isSplit(std::uint32_t flags) { return (flags & ENTRY_IMPULSE1) && (flags & ENTRY_ENDED1); }

/// The planes of a ray: of the first impulse (0), of the second (1), or of the second in one colour.
struct ExpectedRay {
  std::uint32_t impulse = 0;
  int channel = -1;
};

std::vector<ExpectedRay> raysOf(const std::vector<std::uint32_t>& impulses, std::uint32_t flags,
                                std::uint32_t i) {
  std::vector<ExpectedRay> rays;
  if (flags & ENTRY_IMPULSE0) rays.push_back({0});
  if ((flags & ENTRY_IMPULSE1) && !isSplit(flags)) rays.push_back({1});
  for (std::uint32_t c = 0; c < 3 && isSplit(flags); ++c)
    if (!(impulses[(kImpulsePlanes + IMPULSE_THROUGHPUT + c) * kCapacity + i] >> 31))
      rays.push_back({1, static_cast<int>(c)});
  return rays;
}

void checkImpulse(Compaction& compaction, Pattern pattern, std::uint32_t count) {
  static const auto impulses = manyImpulses();
  static const auto rays = distinctWords(kRayPlanes * kCapacity, 1U << 24);
  static const auto hits = distinctWords(HIT_PLANES_STRAIGHT * kCapacity, 1U << 23);
  const std::uint32_t fitting =
      std::min(count, kCapacity / 4);  // four of each must fit, as the wavefront's segments see to
  const std::uint32_t first = kCapacity - fitting;
  const auto flags = makeFlags(pattern, fitting);
  std::vector<std::uint32_t> expected(kRayPlanes * kCapacity, kUntouched);
  std::uint32_t out = 0;
  for (std::uint32_t i = 0; i < fitting; ++i) {
    for (const auto& [k, channel] : raysOf(impulses, flags[i], i)) {
      // Origin, direction, throughput: planes alike in both queues.
      std::uint32_t way = k * kImpulsePlanes + IMPULSE_D, cone = k * kImpulsePlanes + IMPULSE_PLANES;
      if (channel > 0) {
        way = 2 * kImpulsePlanes + (static_cast<std::uint32_t>(channel) - 1) * (3 + CONE_PLANES);
        cone = way + 3;
      }
      for (std::uint32_t a = 0; a < 3; ++a) {
        const std::uint32_t own = k * kImpulsePlanes;
        const bool carries = channel < 0 || channel == static_cast<int>(a);
        expected[(RAY_O + a) * kCapacity + out] = impulses[(own + IMPULSE_O + a) * kCapacity + i];
        expected[(RAY_D + a) * kCapacity + out] = impulses[(way + a) * kCapacity + i];
        expected[(RAY_THROUGHPUT + a) * kCapacity + out] =
            carries ? impulses[(own + IMPULSE_THROUGHPUT + a) * kCapacity + i] : 0;
      }
      for (std::uint32_t plane = 0; plane < CONE_PLANES; ++plane)
        expected[(RAY_PLANES_STRAIGHT + plane) * kCapacity + out] = impulses[(cone + plane) * kCapacity + i];
      expected[RAY_SLOT * kCapacity + out] = rays[RAY_SLOT * kCapacity + first + i];
      const bool straight = channel < 0 && (flags[i] & (k == 0 ? ENTRY_STRAIGHT0 : ENTRY_STRAIGHT1));
      const std::uint32_t steps = rays[RAY_STEPS * kCapacity + first + i];
      const bool branched = (flags[i] & ENTRY_BRANCHED) && steps >> 26 < 63;
      expected[RAY_AFTER_ORDER * kCapacity + out] = straight ? hits[HIT_ORDER * kCapacity + i] : 0;
      expected[RAY_AFTER_TRIANGLE * kCapacity + out] = straight ? hits[HIT_TRIANGLE * kCapacity + i] : NO_HIT;
      expected[RAY_STEPS * kCapacity + out] =
          steps + (straight ? STEP_STRAIGHT + (branched ? STEP_BRANCHED : 0) : STEP_BOUNCE);
      ++out;
    }
  }
  const auto next = compaction.impulse(flags, first, fitting, impulses, rays, hits);
  EXPECT_EQ(compaction.found, out);
  EXPECT_EQ(next, expected);
}

/// Every pattern in counts around the length of a chunk.
void checkChunk(Compaction& compaction, std::uint32_t chunk) {
  for (const std::uint32_t count : {0U, 1U, 333U, chunk, chunk + 1, 2 * chunk + 1, kCapacity}) {
    for (const Pattern pattern : {Pattern::None, Pattern::All, Pattern::Random, Pattern::OnlyLast}) {
      SCOPED_TRACE(fmt::format("chunk {}, {} entries, pattern {}", chunk, count, static_cast<int>(pattern)));
      checkShadow(compaction, pattern, count);
      checkImpulse(compaction, pattern, count);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(Compact, KeepsWhatIsWantedInOrder) {
  for (const std::uint32_t chunk : {1U, 7U, 32U, 1024U}) {
    Compaction compaction(chunk);
    checkChunk(compaction, chunk);
  }
}

/// The candidates of a second light are its own, and what the first set has of impulses stands.
TEST(Compact, SecondSetOfCandidates) {
  constexpr std::uint32_t kCount = 2049;
  Compaction compaction(1024);
  for (const Pattern pattern : {Pattern::None, Pattern::All, Pattern::OnlyLast}) {
    const auto second = makeFlags(pattern, kCount);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < kCount; ++i)
      if (second[i] & ENTRY_SHADOW) expected.push_back(i);
    const std::size_t wanted = expected.size();
    expected.resize(kCapacity, kUntouched);
    EXPECT_EQ(compaction.secondShadow(makeFlags(Pattern::Random, kCount), second, kCount), expected);
    EXPECT_EQ(compaction.found, wanted);
  }
}

/// Shares that are sums of powers of two down to 2^-20, so that the expected units need no rounding of ours;
/// some above the most that counts.
TEST(Compact, SumsWhatEndedWhateverTheChunk) {
  for (const std::uint32_t chunk : {1U, 7U, 32U, 1024U}) {
    Compaction compaction(chunk);
    for (const std::uint32_t count : {1U, chunk + 1, kCapacity}) {
      SCOPED_TRACE(fmt::format("chunk {}, {} entries", chunk, count));
      test::Rng rng(count);
      const auto flags = makeFlags(Pattern::Random, count);
      std::vector<float> impulses(2 * kImpulsePlanes * kCapacity, NAN);
      EndedUnits expected{};
      for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t k = 0; k < 2; ++k) {
          if (!(flags[i] & (ENTRY_ENDED0 << k)) || (k == 1 && isSplit(flags[i]))) continue;
          const std::uint64_t millionths = rng.bits() % (std::uint64_t{1} << 20);
          const bool huge = i % 5 == 0, cutOff = rng.unit() < 0.4F;
          const float share = huge ? 3e9F : static_cast<float>(millionths) * 0x1p-20F;
          impulses[(k * kImpulsePlanes + IMPULSE_THROUGHPUT) * kCapacity + i] = cutOff ? -share : share;
          const bool straight = flags[i] & (ENTRY_STRAIGHT0 << k);
          // -0 is not below 0: what carries nothing is never written there.
          const std::size_t kind =
              cutOff && share > 0 ? ENDED_CUTOFF : (straight ? ENDED_STRAIGHT : ENDED_BOUNCES);
          expected[kind] += 1 + (huge ? std::uint64_t{1} << (13 + 26) : millionths << 6);
        }
      EXPECT_EQ(compaction.ended(flags, impulses, count), expected);
    }
  }
}

TEST(FindLongRuns, ReportsASampleLongerThanTheLimit) {
  Compaction compaction(1024);
  const auto reported = [&](std::uint32_t runBegin, std::uint32_t runLength, std::uint32_t count) {
    auto rays = distinctWords(kRayPlanes * kCapacity, 0);
    for (std::uint32_t i = 0; i < runLength; ++i) rays[RAY_SLOT * kCapacity + runBegin + i] = 7;
    const Buffer counters =
        compaction.bench.compute.upload("counters", std::vector<std::uint32_t>(COUNTERS, 0));
    compaction.bench.stages.run(stages::FindLongRuns{.count = count,
                                                     .capacity = kCapacity,
                                                     .rays = compaction.bench.compute.upload("rays", rays),
                                                     .counters = counters});
    return compaction.bench.read<std::uint32_t>(counters, COUNTERS)[COUNTER_LONG_RUN] != 0;
  };
  EXPECT_FALSE(reported(0, LONG_RUN, kCapacity));
  EXPECT_TRUE(reported(0, LONG_RUN + 1, kCapacity));
  EXPECT_FALSE(reported(1000, LONG_RUN, kCapacity));
  EXPECT_TRUE(reported(1000, LONG_RUN + 1, kCapacity));
  EXPECT_FALSE(reported(kCapacity - LONG_RUN, LONG_RUN, kCapacity));
  EXPECT_TRUE(reported(kCapacity - LONG_RUN - 1, LONG_RUN + 1, kCapacity));
  EXPECT_FALSE(reported(0, LONG_RUN + 1, LONG_RUN)) << "entries beyond the count do not count";
  EXPECT_TRUE(reported(0, LONG_RUN + 1, LONG_RUN + 1));
  EXPECT_FALSE(reported(0, 1, 1));
}

}  // namespace
}  // namespace whittle
