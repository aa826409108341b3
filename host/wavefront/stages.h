// THE table of stages. All that is known of one stands here once: what it is called, where its kernel is and
// in which program it is compiled, when it runs, what its items are and how many of them a work item takes,
// its arguments, and the bytes that it moves. Programs, plan, launches, statistics, profile and trace read
// it.
//
// Bytes are those that a launch must move between queues, film and registers: each plane that it reads or
// writes, once for each entry that needs it, whatever the lanes beside it load. What the scene itself takes
// (tree, triangles, textures) is not among them: it comes from caches mostly, and how much of it nobody
// counts. Bytes over seconds is the effective bandwidth of a stage, to be held against what the machine's
// memory can do.
//
// To add a stage: a kernel in kernels/, a struct here, its place in `Stages`, a method of Wavefront that
// launches it. stages.cpp does not compile unless names and types of the arguments are the kernel's.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "analysis/scene_features.h"
#include "kernels/shared/features.h"
#include "report/stage_facts.h"
#include "wavefront/stage_arguments.h"

namespace whittle {

using Bytes = std::uint64_t;

/// What decides whether a stage is launched.
struct StageConditions {
  const SceneFeatures& features;
  std::size_t lightGroups = 1;
  int bounces = 1;
  bool lateLight = false;  ///< hasLateLight

  bool shadows() const { return features.has(Feature::SHADOWS); }
  bool impulses() const { return features.has(Feature::IMPULSES); }
  /// A sample has at most 2^(bounce - 1) entries in the queue of a bounce, three times as many where some
  /// split, which each does once.
  bool longRuns() const {
    return features.has(Feature::BOTH_BRANCHES) && bounces >= (features.has(Feature::DISPERSION) ? 8 : 10);
  }
};

/// Items that one work item takes.
enum class PerWorkItem : std::uint8_t {
  One,
  Lanes,   ///< ENTRY_LANES with PACKETS, else one
  Packet,  ///< PACKET_RAYS with PACKETS, else one
  Chunk,   ///< COMPACT_CHUNK
};

/// How launches are cut into work items.
struct LaunchWidths {
  bool packets = false;
  std::uint32_t compactChunk = COMPACT_CHUNK;

  std::uint32_t of(PerWorkItem width) const {
    switch (width) {
      case PerWorkItem::One:
        return 1;
      case PerWorkItem::Lanes:
        return packets ? ENTRY_LANES : 1;
      case PerWorkItem::Packet:
        return packets ? PACKET_RAYS : 1;
      case PerWorkItem::Chunk:
        return compactChunk;
    }
    return 1;
  }
};

/// Bytes of one entry in those queues that are as wide as the features ask.
struct EntryBytes {
  Bytes hit = HIT_PLANES * sizeof(float);
  Bytes radiance = RADIANCE_PLANES * sizeof(float);
  bool slots = true;  ///< eye rays carry the slots of their samples
};

struct Stage {
  StageFacts facts;
  PerWorkItem width = PerWorkItem::One;
  bool (*runs)(const StageConditions&) = nullptr;
};

namespace stages {

using Count = std::uint32_t;

inline constexpr Bytes kPlane = sizeof(float);                    ///< of an entry; indices are as wide
inline constexpr Bytes kRay = (RAY_THROUGHPUT - RAY_O) * kPlane;  ///< origin and direction
inline constexpr Bytes kRgb = 3 * kPlane;
inline constexpr Bytes kFlags = sizeof(std::uint8_t);

struct Raygen {
  static constexpr Stage stage{{"raygen", "eye rays", "raygen", "queues", "raygen.cl", "rays", "rays"},
                               PerWorkItem::Lanes,
                               [](const StageConditions&) { return true; }};
  device::DeviceCamera camera{};
  device::Batch batch{};
  Count count = 0, capacity = 0;
  Global<const Count> pixelOrder;
  Global<float> rays;
  WHITTLE_ARGUMENTS(camera, batch, count, capacity, pixelOrder, rays)

  Count items() const { return count; }
  /// Writes rays, and slots where impulses need them; reads the place of each pixel.
  Bytes bytes(const EntryBytes& e) const {
    return count * (kRay + (e.slots ? kPlane : 0)) + batch.pixels * kPlane;
  }
};

struct Intersect {
  static constexpr Stage stage{
      {"intersect", "nearest hits", "intersect", "searches", "intersect.cl", "rays", "rays"},
      PerWorkItem::Packet,
      [](const StageConditions&) { return true; }};
  SceneArgument scene;
  Count first = 0, count = 0, capacity = 0;
  Global<const float> rays;
  Global<float> hits;
  Count hitPlanes = HIT_PLANES;
  Count continued = 0;  ///< 1: rays may have gone straight on
  Global<Count> counters;
  WHITTLE_ARGUMENTS(scene, first, count, capacity, rays, hits, hitPlanes, continued, counters)

  Count items() const { return count; }
  Bytes bytes(const EntryBytes& e) const { return count * (kRay + e.hit); }
};

struct Shade {
  static constexpr Stage stage{
      {"shade", "surfels, emission, first lights, impulses", "shade", "shading", "shade.cl", "rays", "hits"},
      PerWorkItem::Lanes,
      [](const StageConditions&) { return true; }};
  SceneArgument scene;
  device::RenderConstants constants{};
  device::Batch batch{};
  Count first = 0, count = 0, capacity = 0, bounce = 0, lastBounce = 0, lightsEnd = 0, waiting = 0, width = 0,
        pixels = 0;
  Global<const Count> pixelOrder;
  Global<const float> rays, hits;
  Global<float> entryRadiance, shadows, impulses;
  Global<std::uint8_t> flags;
  Global<float> aovs;
  WHITTLE_ARGUMENTS(scene, constants, batch, first, count, capacity, bounce, lastBounce, lightsEnd, waiting,
                    width, pixels, pixelOrder, rays, hits, entryRadiance, shadows, impulses, flags, aovs)

  Count items() const { return count; }
  /// Reads rays, hits and, after the first bounce, throughputs; writes radiance and flags of each set.
  Bytes bytes(const EntryBytes& e) const {
    const bool throughputs = bounce > 1 && bounce < lastBounce;
    return count * (kRay + e.hit + e.radiance + (throughputs ? kRgb : 0) + std::max(waiting, 1U) * kFlags);
  }
  /// Candidates come on top.
  static constexpr Bytes bytesOf(Bytes shadowRays, Bytes impulses, Bytes impulsePlanes) {
    return (shadowRays * SHADOW_PLANES + impulses * impulsePlanes) * kPlane;
  }
};

struct CompactCount {
  static constexpr Stage stage{
      {"compact_count", "candidates in each chunk", "compact", "queues", "compact.cl", "entries", "hits"},
      PerWorkItem::Chunk,
      [](const StageConditions& c) { return c.shadows() || c.impulses(); }};
  Count count = 0, capacity = 0;
  Count set = 0;  ///< of shadow candidates; impulses come with the first
  Global<const std::uint8_t> flags;
  Global<const float> impulses;  ///< none: nothing can have ended or split
  Global<Count> totals;
  WHITTLE_ARGUMENTS(count, capacity, set, flags, impulses, totals)

  Count items() const { return count; }
  Bytes bytes(const EntryBytes&) const { return count * kFlags; }
};

struct ScanChunks {
  static constexpr Stage stage{
      {"scan_chunks", "places of the chunks", "compact", "queues", "compact.cl", "chunks", "hits"},
      PerWorkItem::One,
      CompactCount::stage.runs};
  Count chunks = 0;
  /// Shadow rays, impulses and, where something can have ended, ENDED_KINDS: a work item each.
  Count kinds = SUM_ENDED;
  Global<Count> totals, sums;
  WHITTLE_ARGUMENTS(chunks, kinds, totals, sums)

  Count items() const { return chunks; }
  Count workItems() const { return kinds; }
  /// Reads and writes the totals.
  Bytes bytes(const EntryBytes&) const { return Bytes{2} * chunks * kinds * kPlane; }
};

struct CompactShadow {
  static constexpr Stage stage{
      {"compact_shadow", "the shadow queue", "compact", "queues", "compact.cl", "entries", "shadow rays"},
      PerWorkItem::Chunk,
      [](const StageConditions& c) { return c.shadows(); }};
  Count count = 0, capacity = 0, set = 0;
  Global<const std::uint8_t> flags;
  Global<const Count> offsets;
  Global<Count> shadowQueue;
  WHITTLE_ARGUMENTS(count, capacity, set, flags, offsets, shadowQueue)

  Count items() const { return count; }
  Bytes bytes(const EntryBytes&) const { return count * kFlags; }
  /// The indices come on top.
  static constexpr Bytes bytesOf(Bytes found) { return found * kPlane; }
};

struct Occlude {
  static constexpr Stage stage{
      {"occlude", "light that arrives", "occlude", "searches", "occlude.cl", "rays", "shadow rays"},
      PerWorkItem::Packet,
      [](const StageConditions& c) { return c.shadows(); }};
  SceneArgument scene;
  Count count = 0, capacity = 0, set = 0;
  Global<const Count> shadowQueue;
  Global<const float> shadows;
  Global<float> entryRadiance;
  Global<Count> counters;
  WHITTLE_ARGUMENTS(scene, count, capacity, set, shadowQueue, shadows, entryRadiance, counters)

  Count items() const { return count; }
  /// Reads index, ray, length and contribution; adds to the radiance, as though every light were reached.
  Bytes bytes(const EntryBytes&) const { return count * (kPlane + SHADOW_PLANES * kPlane + 2 * kRgb); }
};

struct ShadeLight {
  static constexpr Stage stage{
      {"shade_light", "further lights", "shade", "shading", "shade.cl", "rays", "shadow rays"},
      PerWorkItem::Lanes,
      [](const StageConditions& c) { return c.lightGroups > 1; }};
  SceneArgument scene;
  device::RenderConstants constants{};
  device::Batch batch{};
  Count first = 0, count = 0, capacity = 0, bounce = 0, lightsFirst = 0, lightsEnd = 0, waiting = 0,
        width = 0;
  Global<const Count> pixelOrder;
  Global<const float> rays, hits;
  Global<float> entryRadiance, shadows;
  Global<std::uint8_t> flags;
  WHITTLE_ARGUMENTS(scene, constants, batch, first, count, capacity, bounce, lightsFirst, lightsEnd, waiting,
                    width, pixelOrder, rays, hits, entryRadiance, shadows, flags)

  Count items() const { return count; }
  /// Reads rays, hits, radiance and flags; writes the last two. Candidates come on top (Shade::bytesOf).
  Bytes bytes(const EntryBytes& e) const {
    return count * (kRay + e.hit + 2 * kRgb + (1 + std::max(waiting, 1U)) * kFlags);
  }
};

struct AddLight {
  static constexpr Stage stage{
      {"add_light", "light without shadows, in its turn", "shade", "shading", "shade.cl", "entries", "hits"},
      PerWorkItem::Lanes,
      [](const StageConditions& c) { return c.lateLight; }};
  Count count = 0, capacity = 0, set = 0;
  Global<const std::uint8_t> flags;
  Global<const float> shadows;
  Global<float> entryRadiance;
  WHITTLE_ARGUMENTS(count, capacity, set, flags, shadows, entryRadiance)

  Count items() const { return count; }
  /// Reads flags and contribution, adds to the radiance, as though every entry had some.
  Bytes bytes(const EntryBytes&) const { return count * (kFlags + 3 * kRgb); }
};

struct CompactImpulse {
  static constexpr Stage stage{
      {"compact_impulse", "the next ray queue", "compact", "queues", "compact.cl", "entries", "impulses"},
      PerWorkItem::Chunk,
      [](const StageConditions& c) { return c.impulses(); }};
  Count first = 0, count = 0, capacity = 0, bounce = 0;
  Global<const std::uint8_t> flags;
  Global<const Count> offsets;
  Global<const float> impulses, rays, hits;
  Global<float> next;
  WHITTLE_ARGUMENTS(first, count, capacity, bounce, flags, offsets, impulses, rays, hits, next)

  Count items() const { return count; }
  Bytes bytes(const EntryBytes&) const { return count * kFlags; }
  /// On top: candidates and slots read, whole rays written.
  static constexpr Bytes bytesOf(Bytes found, Bytes impulsePlanes) {
    return 2 * found * (impulsePlanes + 1) * kPlane;
  }
};

struct Accumulate {
  static constexpr Stage stage{
      {"accumulate", "entries into samples", "accumulate", "queues", "accumulate.cl", "entries", "hits"},
      PerWorkItem::One,
      [](const StageConditions& c) { return c.impulses(); }};
  Count first = 0, count = 0, capacity = 0;
  Global<const float> rays, entryRadiance;
  Global<float> sampleRadiance;
  WHITTLE_ARGUMENTS(first, count, capacity, rays, entryRadiance, sampleRadiance)

  Count items() const { return count; }
  /// Reads slot, throughput and radiance; adds to the sample, as though each entry were the only one of it.
  Bytes bytes(const EntryBytes& e) const { return count * (kPlane + kRgb + 3 * e.radiance); }
};

struct FindLongRuns {
  static constexpr Stage stage{
      {"find_long_runs", "samples that need slices", "compact", "queues", "compact.cl", "entries", "rays"},
      PerWorkItem::One,
      [](const StageConditions& c) { return c.longRuns(); }};
  Count count = 0, capacity = 0;
  Global<const float> rays;
  Global<Count> counters;
  WHITTLE_ARGUMENTS(count, capacity, rays, counters)

  Count items() const { return count; }
  Bytes bytes(const EntryBytes&) const { return count * kPlane; }
};

struct Film {
  static constexpr Stage stage{
      {"film", "samples into pixels", "film", "queues", "film.cl", "pixels", "samples"},
      PerWorkItem::Lanes,
      [](const StageConditions&) { return true; }};
  device::Batch batch{};
  Count capacity = 0, pixels = 0, planes = FILM_PLANES;
  Global<const Count> blocks;
  Global<const float> sampleRadiance;
  Global<float> sums;
  Global<Count> counters;
  WHITTLE_ARGUMENTS(batch, capacity, pixels, planes, blocks, sampleRadiance, sums, counters)

  Count items() const { return batch.pixels; }
  /// Reads samples; reads and writes the film's planes, or writes them alone before the first sample.
  Bytes bytes(const EntryBytes& e) const {
    const Bytes all = batch.pixels;
    return all * batch.samples * e.radiance + all * planes * (batch.firstSample == 0 ? 1 : 2) * kPlane;
  }
};

}  // namespace stages

/// In the order of their first launches.
using Stages =
    std::tuple<stages::Raygen, stages::Intersect, stages::Shade, stages::CompactCount, stages::ScanChunks,
               stages::CompactShadow, stages::Occlude, stages::AddLight, stages::ShadeLight,
               stages::CompactImpulse, stages::Accumulate, stages::FindLongRuns, stages::Film>;

/// Calls `f` with a value of each stage's struct, all of whose arguments are null or zero: launched like
/// this a stage does nothing.
template <typename F>
void forEachStage(const F& f) {
  std::apply([&](const auto&... stage) { (f(stage), ...); }, Stages{});
}

/// The rows of the table.
const std::vector<Stage>& allStages();

/// Those that a render launches, or may launch.
std::vector<std::string> plannedStages(const StageConditions& conditions);

/// Work items of a launch.
template <typename S>
std::uint64_t workItemsOf(const S& stage, const LaunchWidths& widths) {
  if constexpr (requires { stage.workItems(); }) {
    return stage.workItems();
  } else {
    const std::uint64_t each = widths.of(S::stage.width);
    return (stage.items() + each - 1) / each;
  }
}

}  // namespace whittle
