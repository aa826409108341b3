// Queues and sums: the kernels of compaction, accumulation and film on made-up entries, against serial code
// here.
#include <array>
#include <bit>
#include <cmath>

#include "check/device_check.h"
#include "cl/kernel_source.h"
#include "kernels/shared/layout.h"
#include "wavefront/stage_runner.h"

namespace whittle {
namespace {

constexpr std::uint32_t kEntries = 20000, kChunk = 128;
constexpr const char* kOptions = "-cl-std=CL1.2 -D SCENE_FEATURES=0 -D COMPACT_CHUNK=128";

/// Hashes in a row.
class Dice {
 public:
  std::uint32_t next() {
    state_ = state_ * 747796405U + 2891336453U;
    return (state_ >> 9) ^ state_ >> 20;
  }
  float unit() { return static_cast<float>(next() & 0xffffU) * 0x1p-16F; }

 private:
  std::uint32_t state_ = 12345;
};

StageRunner runnerOf(Compute& compute, const char* file) {
  return {
      compute, {compute.build(assembleKernelSource({file}), kOptions, file)}, 8, LaunchWidths{false, kChunk}};
}

template <typename T>
std::vector<T> readAll(Compute& compute, const Buffer& buffer) {
  std::vector<T> values(buffer.bytes / sizeof(T));
  compute.read(buffer, 0, buffer.bytes, values.data());
  return values;
}

std::size_t differentBits(const std::vector<float>& a, const std::vector<float>& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < b.size(); ++i)
    count += std::bit_cast<std::uint32_t>(a[i]) != std::bit_cast<std::uint32_t>(b[i]);
  return count;
}

/// A sum and what it lacks, in floats that round as the kernel's (film.cl).
struct Sum {
  float sum = 0.0F, lacking = 0.0F;
  void add(float value) {
    const float result = sum + value;
    const float error = std::fabs(sum) >= std::fabs(value) ? (sum - result) + value : (value - result) + sum;
    const float rest = lacking + error;
    sum = result + rest;
    lacking = (result - sum) + rest;
  }
};

Finding checkFilm(Compute& compute, Dice& dice) {
  constexpr std::uint32_t kPixels = 64, kSamples = 50, kSlots = kPixels * kSamples;
  std::vector<float> samples(std::size_t{RADIANCE_PLANES} * kSlots);
  for (float& value : samples) value = std::ldexp(dice.unit(), static_cast<int>(dice.next() % 20));
  const Buffer in = compute.upload("samples", samples),
               out = compute.upload("film", std::vector<float>(std::size_t{FILM_PLANES} * kPixels, 0.0F)),
               counters = compute.upload("counters", std::vector<std::uint32_t>(COUNTERS, 0));
  StageRunner stages = runnerOf(compute, "film.cl");
  stages.run(stages::Film{.batch = {0, kPixels, 0, kSamples},
                          .capacity = kSlots,
                          .pixels = kPixels,
                          .blocks = {},
                          .sampleRadiance = in,
                          .sums = out,
                          .counters = counters});
  std::vector<float> right(std::size_t{FILM_PLANES} * kPixels);
  for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
    std::array<Sum, 3> colour;
    Sum squares;
    for (std::uint32_t s = 0; s < kSamples; ++s) {
      std::array<float, 3> value{};
      for (std::uint32_t c = 0; c < 3; ++c) {
        value[c] = samples[std::size_t{c} * kSlots + std::size_t{pixel} * kSamples + s];
        colour[c].add(value[c]);
      }
      squares.add((value[0] * value[0] + value[1] * value[1] + value[2] * value[2]) * (1.0F / 3.0F));
    }
    for (std::uint32_t c = 0; c < 3; ++c) {
      right[(FILM_SUM + c) * kPixels + pixel] = colour[c].sum;
      right[(FILM_COMPENSATION + c) * kPixels + pixel] = colour[c].lacking;
    }
    right[FILM_SQUARES * kPixels + pixel] = squares.sum;
    right[FILM_SQUARES_COMPENSATION * kPixels + pixel] = squares.lacking;
  }
  return comparedFinding("film", differentBits(readAll<float>(compute, out), right), right.size(), "the host",
                         "sums of many samples are off");
}

/// Runs of one to seven entries for each sample.
Finding checkAccumulate(Compute& compute, Dice& dice) {
  std::vector<float> rays(std::size_t{RAY_PLANES} * kEntries), radiance(std::size_t{3} * kEntries);
  for (float& value : rays) value = dice.unit();
  for (float& value : radiance) value = 10.0F * dice.unit();
  std::vector<std::uint32_t> slots(kEntries);
  for (std::uint32_t i = 0, slot = 0, left = 0; i < kEntries; ++i) {
    if (left == 0) left = 1 + dice.next() % 7, ++slot;
    --left;
    slots[i] = slot;
    rays[std::size_t{RAY_SLOT} * kEntries + i] = std::bit_cast<float>(slot);
  }
  std::vector<float> right(std::size_t{3} * kEntries, 0.25F);
  const Buffer out = compute.upload("samples", right), queue = compute.upload("rays", rays),
               light = compute.upload("radiance", radiance);
  runnerOf(compute, "accumulate.cl")
      .run(stages::Accumulate{.count = kEntries,
                              .capacity = kEntries,
                              .rays = queue,
                              .entryRadiance = light,
                              .sampleRadiance = out});
  for (std::uint32_t c = 0; c < 3; ++c)
    for (std::uint32_t i = 0; i < kEntries; ++i)
      right[std::size_t{c} * kEntries + slots[i]] +=
          rays[std::size_t{RAY_THROUGHPUT + c} * kEntries + i] * radiance[std::size_t{c} * kEntries + i];
  return comparedFinding("accumulate", differentBits(readAll<float>(compute, out), right), right.size(),
                         "the host", "reflections have the wrong brightness");
}

}  // namespace

std::vector<Finding> checkCompaction(Compute& compute) {
  Dice dice;
  constexpr std::uint32_t kChunks = (kEntries + kChunk - 1) / kChunk;
  std::vector<std::uint8_t> flags(kEntries + QUEUE_PADDING);
  for (std::uint8_t& flag : flags)
    flag = static_cast<std::uint8_t>(dice.next() & (ENTRY_SHADOW | ENTRY_IMPULSE0));
  std::vector<float> impulses(std::size_t{RAY_PLANES} * kEntries), rays(impulses.size());
  for (float& value : impulses) value = dice.unit();
  for (float& value : rays) value = dice.unit();
  const Buffer from = compute.upload("flags", flags), in = compute.upload("impulses", impulses),
               queue = compute.upload("rays", rays),
               totals = compute.allocate("totals", std::size_t{SUMS} * kChunks * 4),
               sums = compute.allocate("sums", std::size_t{SUMS} * 4),
               shadows = compute.allocate("shadows", std::size_t{kEntries} * 4),
               next = compute.allocate("next", impulses.size() * 4);
  StageRunner stages = runnerOf(compute, "compact.cl");
  stages.run(stages::CompactCount{
      .count = kEntries, .capacity = kEntries, .flags = from, .impulses = {}, .totals = totals});
  stages.run(stages::ScanChunks{.chunks = kChunks, .kinds = SUM_ENDED, .totals = totals, .sums = sums});
  stages.run(stages::CompactShadow{
      .count = kEntries, .capacity = kEntries, .flags = from, .offsets = totals, .shadowQueue = shadows});
  stages.run(stages::CompactImpulse{.count = kEntries,
                                    .capacity = kEntries,
                                    .bounce = 1,
                                    .flags = from,
                                    .offsets = totals,
                                    .impulses = in,
                                    .rays = queue,
                                    .hits = {},
                                    .next = next});
  const auto seenShadows = readAll<std::uint32_t>(compute, shadows);
  const auto seenNext = readAll<float>(compute, next);
  std::size_t different = 0, found = 0, moved = 0;
  for (std::uint32_t i = 0; i < kEntries; ++i) {
    if (flags[i] & ENTRY_SHADOW) different += seenShadows[found++] != i;
    if (!(flags[i] & ENTRY_IMPULSE0)) continue;
    const std::size_t slot = std::size_t{RAY_SLOT} * kEntries;
    different += seenNext[slot + moved] != rays[slot + i];
    for (std::size_t plane = 0; plane < IMPULSE_PLANES; ++plane)
      different += seenNext[plane * kEntries + moved] != impulses[plane * kEntries + i];
    ++moved;
  }
  const auto counted = readAll<std::uint32_t>(compute, sums);
  different += (counted[SUM_SHADOW] != found) + (counted[SUM_IMPULSE] != moved);
  return {comparedFinding("compaction and scans", different, found + moved * (IMPULSE_PLANES + 1) + 2,
                          "the host", "rays are lost or follow others' paths")};
}

std::vector<Finding> checkSums(Compute& compute) {
  Dice dice;
  return {checkAccumulate(compute, dice), checkFilm(compute, dice)};
}

}  // namespace whittle
