// Queue memory and the cutting of queues into segments.
#include "wavefront/ray_queues.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "kernels/shared/layout.h"

namespace whittle {
namespace {

/// As kernels/shade.cl does.
bool asksForDistances(const SceneFeatures& features) {
  return features.has(Feature::TEXTURES) || features.has(Feature::ABSORPTION) ||
         features.has(Feature::AOVS) || features.has(Feature::FAR_PLANE);
}

std::uint32_t conePlanesFor(const SceneFeatures& features) {
  return features.has(Feature::TEXTURE_LEVELS) ? CONE_PLANES : 0;
}

/// Of all impulse candidates of a hit.
std::uint32_t impulsePlanesFor(const SceneFeatures& features) {
  const std::uint32_t cone = conePlanesFor(features), splits = mostRaysOfHit(features) > 2 ? 2 : 0;
  const std::uint32_t candidates = features.has(Feature::BOTH_BRANCHES) ? 2 : 1;
  return candidates * (IMPULSE_PLANES + cone) + splits * (SPLIT_PLANES + cone);
}

std::uint32_t rayPlanesFor(const SceneFeatures& features) {
  if (features.has(Feature::STRAIGHT)) return RAY_PLANES_STRAIGHT + conePlanesFor(features);
  return features.has(Feature::IMPULSES) ? RAY_PLANES + conePlanesFor(features) : EYE_RAY_PLANES;
}

std::uint32_t hitPlanesFor(const SceneFeatures& features) {
  if (features.has(Feature::COST)) return HIT_PLANES_COST;
  if (features.has(Feature::STRAIGHT)) return HIT_PLANES_STRAIGHT;
  return asksForDistances(features) ? HIT_PLANES : HIT_PLANES_WITHOUT_T;
}

}  // namespace

RayQueues::RayQueues(Compute& compute, const Asked& asked, std::uint32_t capacity, std::uint32_t compactChunk)
    : compute_(compute),
      capacity_(capacity),
      segmentLimit_(capacity / mostRaysOfHit(asked.features)),
      rayPlanes_(rayPlanesFor(asked.planes)),
      hitPlanes_(hitPlanesFor(asked.planes)),
      impulsePlanes_(IMPULSE_PLANES + conePlanesFor(asked.features)),
      radiancePlanes_(asked.planes.has(Feature::COVERAGE) ? RADIANCE_PLANES_COVERAGE : RADIANCE_PLANES),
      entryBytes_{hitPlanesFor(asked.features) * sizeof(float), radiancePlanes_ * sizeof(float),
                  rayPlanesFor(asked.features) > RAY_SLOT} {
  // A packet reads up to fifteen entries past its segment (into the next plane, or the padding) and ignores
  // them. It writes whole packets from entry 0, which stay inside a plane because the capacity is a multiple.
  assert(capacity % PACKET_RAYS == 0);
  const auto planes = [&](const char* name, std::size_t count) {
    return compute.allocate(name, (count * capacity + QUEUE_PADDING) * sizeof(float));
  };
  const bool shadowRays = asked.features.has(Feature::SHADOWS);
  const bool impulseRays = asked.features.has(Feature::IMPULSES);
  hits = planes("hits", hitPlanes_);
  sampleRadiance = planes("sampleRadiance", radiancePlanes_);
  const std::size_t sets = asked.waitingLights;
  if (shadowRays) shadows = planes("shadows", sets * SHADOW_PLANES), shadowQueue = planes("shadowQueue", 1);
  // Kernels for two put the only one of a hit into either place.
  if (impulseRays)
    impulses = planes("impulses", impulsePlanesFor(asked.planes)),
    entryRadiance = planes("entryRadiance", radiancePlanes_);
  if (shadowRays || impulseRays) {
    flags = compute.allocate("flags", (shadowRays ? sets : 1) * capacity + QUEUE_PADDING);
    // Of all kinds, even where nothing can end: the items of scan_chunks are rounded up to a work-group.
    const std::size_t chunks = capacity / compactChunk + 1;
    totals = compute.allocate("totals", SUMS * chunks * sizeof(std::uint32_t));
    sums = compute.allocate("sums", SUMS * sizeof(std::uint32_t));
  }
}

Buffer RayQueues::acquire() {
  if (free_.empty()) {
    ++queuesMade_;
    return compute_.allocate(
        "rays", (static_cast<std::size_t>(rayPlanes_) * capacity_ + QUEUE_PADDING) * sizeof(float));
  }
  Buffer queue = std::move(free_.back());
  free_.pop_back();
  return queue;
}

void RayQueues::reserve(std::size_t count) {
  std::vector<Buffer> taken;
  while (taken.size() < count) taken.push_back(acquire());
  for (auto& queue : taken) release(std::move(queue));
}

std::vector<std::uint32_t> RayQueues::readSlots(const Buffer& queue, std::uint32_t begin,
                                                std::uint32_t count) const {
  std::vector<std::uint32_t> slots(count);
  const std::size_t offset = (static_cast<std::size_t>(RAY_SLOT) * capacity_ + begin) * sizeof(std::uint32_t);
  compute_.read(queue, offset, count * sizeof(std::uint32_t), slots.data());
  return slots;
}

std::vector<Segment> RayQueues::cut(const Buffer& queue, std::uint32_t count, bool mayHaveLongRuns) const {
  if (mayHaveLongRuns) return cutLongRuns(readSlots(queue, 0, count));
  std::vector<Segment> segments;
  std::uint32_t begin = 0;
  while (count - begin > segmentLimit_) {
    // The last sample boundary at or before the limit: no run is longer than LONG_RUN here.
    const std::uint32_t end = begin + segmentLimit_;
    const std::uint32_t window = std::min<std::uint32_t>(LONG_RUN + 1, segmentLimit_);
    const auto slots = readSlots(queue, end - window, window + 1);
    std::uint32_t at = window;
    while (at > 0 && slots[at] == slots[at - 1]) --at;
    if (at == 0) throw std::logic_error("a ray queue holds a longer run of one sample than was reported");
    segments.push_back({begin, end - window + at});
    begin = segments.back().end;
  }
  segments.push_back({begin, count});
  return segments;
}

std::vector<Segment> RayQueues::cutLongRuns(const std::vector<std::uint32_t>& slots) const {
  const auto count = static_cast<std::uint32_t>(slots.size());
  std::vector<Segment> segments;
  std::uint32_t begin = 0;  // of the segment being filled
  for (std::uint32_t run = 0; run < count;) {
    std::uint32_t runEnd = run + 1;
    while (runEnd < count && slots[runEnd] == slots[run]) ++runEnd;
    const bool isLong = runEnd - run > LONG_RUN;
    if (begin < run && (isLong || runEnd - begin > segmentLimit_)) {
      segments.push_back({begin, run});
      begin = run;
    }
    if (isLong) {
      for (; begin < runEnd; begin = segments.back().end)
        segments.push_back({begin, std::min(begin + LONG_RUN, runEnd)});
    }
    run = runEnd;
  }
  if (begin < count) segments.push_back({begin, count});
  return segments;
}

void RayQueues::report(std::vector<BufferStats>& out) const {
  for (const Buffer* b :
       {&hits, &entryRadiance, &sampleRadiance, &shadows, &shadowQueue, &impulses, &flags, &totals, &sums})
    if (*b) out.push_back({b->name, "queues", b->bytes});
  if (!free_.empty()) out.push_back({"rays", "queues", free_.front().bytes * queuesMade_});
}

}  // namespace whittle
