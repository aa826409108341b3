// The render loop. Each method that launches is named after its stage.
#include "wavefront/wavefront.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <type_traits>
#include <utility>

namespace whittle {

Wavefront::Wavefront(Compute& compute, StageRunner& stages, RayQueues& queues, const WavefrontSetup& setup,
                     const Buffer& film, const Buffer& aovs)
    : compute_(compute), stages_(stages), queues_(queues), setup_(setup), film_(film), aovs_(aovs) {
  counters_ = compute_.allocate("counters", COUNTERS * sizeof(std::uint32_t));
  compute_.fillZero(counters_);
}

std::uint32_t Wavefront::trace(const TracePass& pass, const KeepGoing& keepGoing) {
  keepGoing_ = &keepGoing;
  pixelOrder_ = &pass.order;
  const std::uint32_t room = queues_.segmentLimit();
  assert(room >= FILM_BLOCK);
  // Whole blocks, so that a pass can end between batches.
  const std::uint32_t samplesAtOnce = std::min({pass.samples, room / FILM_BLOCK, setup_.mostSamples});
  const std::uint32_t pixelsAtOnce = room / samplesAtOnce / FILM_BLOCK * FILM_BLOCK;
  double done = 0.0;
  for (std::uint32_t pixel = 0; pixel < pass.pixels; pixel += pixelsAtOnce) {
    if (!keepGoing.ask(done, true)) return pixel;
    const std::uint32_t pixels = std::min(pixelsAtOnce, pass.pixels - pixel);
    for (std::uint32_t sample = 0; sample < pass.samples; sample += samplesAtOnce) {
      const device::Batch batch{pixel, pixels, pass.firstSample + sample,
                                std::min(samplesAtOnce, pass.samples - sample)};
      const double after = done + static_cast<double>(pixels) * batch.samples;
      mayStop_ = sample == 0;  // later the film has some of the pixels' samples already
      if (!traceBatch(pass, batch, {done, after})) return pixel;
      done = after;
    }
  }
  keepGoing.ask(done, true);
  return pass.pixels;
}

bool Wavefront::traceBatch(const TracePass& pass, const device::Batch& batch, Share share) {
  if (beforeBatch_) beforeBatch_(batchesDone_);
  const RayTally before = tally_;
  batch_ = batch;
  const std::uint32_t count = batch.pixels * batch.samples;
  Buffer queue = queues_.acquire();
  stages_.setBatch(batchesDone_++);
  stages_.setBounce(0);
  raygen(queue, count);
  const bool whole = traceQueue(std::move(queue), count, 1, share);
  stages_.setBounce(0);
  if (whole)
    film(pass.blocks);
  else
    tally_ = before;
  const auto work = stages_.hostWork("wait and read kernel times");
  stages_.collect();
  checkWalks();
  return whole;
}

bool Wavefront::traceQueue(Buffer queue, std::uint32_t count, std::uint32_t bounce, Share share) {
  stages_.setBounce(bounce);
  const auto segments = cut(queue, count, bounce);
  double from = share.from;
  bool whole = true;
  for (const Segment& segment : segments) {
    Buffer next;
    const std::uint32_t nextCount = whole ? traceSegment(queue, segment, bounce, next) : 0;
    const double to = share.from + (share.to - share.from) * segment.end / count;
    // The queue of the last segment is free before the next bounce: two queues serve a path that
    // is never cut.
    if (segment.end == count) queues_.release(std::exchange(queue, {}));
    if (nextCount > 0)
      whole = traceQueue(std::move(next), nextCount, bounce + 1, {from, to});
    else if (next)
      queues_.release(std::move(next));
    from = to;
    if (!keepGoing_->ask(to, false) && mayStop_) whole = false;
  }
  return whole;
}

std::vector<Segment> Wavefront::cut(const Buffer& queue, std::uint32_t count, std::uint32_t bounce) {
  if (count <= queues_.segmentLimit() && !mayHaveLongRuns(count, bounce)) return {{0, count}};
  const auto work = stages_.hostWork("cut queue");
  return queues_.cut(queue, count, hasLongRuns(queue, count, bounce));
}

std::uint32_t Wavefront::traceSegment(const Buffer& queue, Segment segment, std::uint32_t bounce,
                                      Buffer& next) {
  stages_.setBounce(bounce);
  // Eye rays are one for each sample, in the order of their slots, and are never cut: what their entries
  // receive is what their samples have so far.
  assert(bounce > 1 || segment.begin == 0);
  radiance_ = bounce == 1 ? &queues_.sampleRadiance : &queues_.entryRadiance;
  intersect(queue, segment, bounce);
  shade(queue, segment, bounce);
  const ObservedSegment observed{queue, segment, bounce, *radiance_, *pixelOrder_, batch_};
  const Candidates found = takeTurns<stages::Shade>(observed, setup_.lights.front());
  for (std::size_t kind = 0; kind < found.ended.size(); ++kind) tally_.ended[kind] += found.ended[kind];
  for (std::size_t group = 1; group < setup_.lights.size(); ++group) {
    shadeLight(queue, segment, bounce, setup_.lights[group]);
    takeTurns<stages::ShadeLight>(observed, setup_.lights[group]);
  }
  if (observer_) observer_->finished(observed);
  if (bounce > 1) accumulate(queue, segment);
  return bounce < setup_.rounds ? compactImpulse(queue, segment, bounce, found.impulse, next) : 0;
}

void Wavefront::raygen(const Buffer& queue, std::uint32_t count) {
  stages_.run(stages::Raygen{.camera = setup_.camera,
                             .batch = batch_,
                             .count = count,
                             .capacity = queues_.capacity(),
                             .pixelOrder = *pixelOrder_,
                             .rays = queue});
  tally_.primary += count;
  tally_.produced += count;
}

void Wavefront::intersect(const Buffer& queue, Segment segment, std::uint32_t bounce) {
  stages_.run(stages::Intersect{.scene = setup_.scene,
                                .first = segment.begin,
                                .count = segment.count(),
                                .capacity = queues_.capacity(),
                                .rays = queue,
                                .hits = queues_.hits,
                                .hitPlanes = queues_.hitPlanes(),
                                .continued = bounce > 1 || setup_.features.has(Feature::NEAR_PLANE),
                                .counters = counters_});
}

void Wavefront::shade(const Buffer& queue, Segment segment, std::uint32_t bounce) {
  stages_.run(stages::Shade{.scene = setup_.scene,
                            .constants = setup_.constants,
                            .batch = batch_,
                            .first = segment.begin,
                            .count = segment.count(),
                            .capacity = queues_.capacity(),
                            .bounce = bounce,
                            .lastBounce = setup_.bounces,
                            .lightsEnd = setup_.lights.front().end,
                            .waiting = setup_.lights.front().waiting,
                            .width = setup_.camera.width,
                            .pixels = setup_.pixels,
                            .pixelOrder = *pixelOrder_,
                            .rays = queue,
                            .hits = queues_.hits,
                            .entryRadiance = *radiance_,
                            .shadows = queues_.shadows,
                            .impulses = queues_.impulses,
                            .flags = queues_.flags,
                            .aovs = aovs_});
  tally_.finished += segment.count();
}

void Wavefront::shadeLight(const Buffer& queue, Segment segment, std::uint32_t bounce,
                           const LightGroup& lights) {
  stages_.run(stages::ShadeLight{.scene = setup_.scene,
                                 .constants = setup_.constants,
                                 .batch = batch_,
                                 .first = segment.begin,
                                 .count = segment.count(),
                                 .capacity = queues_.capacity(),
                                 .bounce = bounce,
                                 .lightsFirst = lights.first,
                                 .lightsEnd = lights.end,
                                 .waiting = lights.waiting,
                                 .width = setup_.camera.width,
                                 .pixelOrder = *pixelOrder_,
                                 .rays = queue,
                                 .hits = queues_.hits,
                                 .entryRadiance = *radiance_,
                                 .shadows = queues_.shadows,
                                 .flags = queues_.flags});
}

bool Wavefront::mayEnd(std::uint32_t bounce) const {
  if (!setup_.features.has(Feature::IMPULSES)) return false;
  if (setup_.features.has(Feature::CUTOFF) || bounce >= setup_.bounces) return true;
  return setup_.features.has(Feature::STRAIGHT) && bounce > setup_.constants.transparentBounces;
}

LightTurn Wavefront::turnOf(const LightGroup& lights, std::uint32_t i) const {
  if (lights.waiting == 0) return {.light = lights.first};
  const std::uint32_t light = lights.end - lights.waiting + i;
  return {.hasRays = setup_.scene.tables.lights[light].castsShadows != 0, .light = light, .set = i};
}

template <typename S>
Wavefront::Candidates Wavefront::takeTurns(const ObservedSegment& observed, const LightGroup& lights) {
  const Segment segment = observed.segment;
  Candidates first;
  for (std::uint32_t i = 0; i < std::max(lights.waiting, 1U); ++i) {
    LightTurn turn = turnOf(lights, i);
    turn.isFirst = std::is_same_v<S, stages::Shade> && i == 0;
    Candidates found;
    if (turn.hasRays || turn.isFirst)
      found = countCandidates(segment, turn.isFirst && mayEnd(observed.bounce), i);
    else if (lights.waiting > 0)
      addLight(segment, i);
    if (i == 0) first = found;
    const std::uint32_t impulses = turn.isFirst ? found.impulse : 0;
    stages_.addBytes<S>(stages::Shade::bytesOf(found.shadow, impulses, queues_.impulsePlanes()));
    if (observer_) observer_->shaded(observed, turn);
    occlude(compactShadow(segment, found.shadow, i), i);
    if (observer_) observer_->lit(observed, turn);
  }
  return first;
}

Wavefront::Candidates Wavefront::countCandidates(Segment segment, bool mayEnd, std::uint32_t set) {
  if (!queues_.flags) return {};
  const Buffer none;
  const bool maySplit = set == 0 && mostRaysOfHit(setup_.features) > 2;
  // What the first set has of impulses stands until they are compacted.
  const std::uint32_t kinds = set > 0 ? SUM_IMPULSE : (mayEnd ? SUM_ENDED + ENDED_KINDS : SUM_ENDED);
  stages_.run(stages::CompactCount{.count = segment.count(),
                                   .capacity = queues_.capacity(),
                                   .set = set,
                                   .flags = queues_.flags,
                                   .impulses = mayEnd || maySplit ? queues_.impulses : none,
                                   .totals = queues_.totals});
  stages_.run(stages::ScanChunks{
      .chunks = chunksOf(segment), .kinds = kinds, .totals = queues_.totals, .sums = queues_.sums});
  std::array<std::uint32_t, SUMS> sums{};
  const auto work = stages_.hostWork("wait for counts");
  compute_.read(queues_.sums, 0, queues_.sums.bytes, sums.data());
  Candidates found{sums[SUM_SHADOW], sums[SUM_IMPULSE], {}};
  for (std::size_t kind = 0; mayEnd && kind < ENDED_KINDS; ++kind)
    found.ended[kind] = std::uint64_t{sums[SUM_ENDED + 2 * kind + 1]} << 32 | sums[SUM_ENDED + 2 * kind];
  return found;
}

std::uint32_t Wavefront::compactShadow(Segment segment, std::uint32_t found, std::uint32_t set) {
  if (found == 0) return 0;
  stages_.run(stages::CompactShadow{.count = segment.count(),
                                    .capacity = queues_.capacity(),
                                    .set = set,
                                    .flags = queues_.flags,
                                    .offsets = queues_.totals,
                                    .shadowQueue = queues_.shadowQueue},
              stages::CompactShadow::bytesOf(found));
  tally_.shadow += found;
  return found;
}

void Wavefront::occlude(std::uint32_t count, std::uint32_t set) {
  stages_.run(stages::Occlude{.scene = setup_.scene,
                              .count = count,
                              .capacity = queues_.capacity(),
                              .set = set,
                              .shadowQueue = queues_.shadowQueue,
                              .shadows = queues_.shadows,
                              .entryRadiance = *radiance_,
                              .counters = counters_});
}

void Wavefront::addLight(Segment segment, std::uint32_t set) {
  stages_.run(stages::AddLight{.count = segment.count(),
                               .capacity = queues_.capacity(),
                               .set = set,
                               .flags = queues_.flags,
                               .shadows = queues_.shadows,
                               .entryRadiance = *radiance_});
}

std::uint32_t Wavefront::compactImpulse(const Buffer& queue, Segment segment, std::uint32_t bounce,
                                        std::uint32_t found, Buffer& next) {
  if (found == 0) return 0;
  assert(found <= queues_.capacity());
  next = queues_.acquire();
  stages_.run(stages::CompactImpulse{.first = segment.begin,
                                     .count = segment.count(),
                                     .capacity = queues_.capacity(),
                                     .bounce = bounce,
                                     .flags = queues_.flags,
                                     .offsets = queues_.totals,
                                     .impulses = queues_.impulses,
                                     .rays = queue,
                                     .hits = queues_.hits,
                                     .next = next},
              stages::CompactImpulse::bytesOf(found, queues_.impulsePlanes()));
  tally_.impulse += found;
  tally_.produced += found;
  return found;
}

void Wavefront::accumulate(const Buffer& queue, Segment segment) {
  stages_.run(stages::Accumulate{.first = segment.begin,
                                 .count = segment.count(),
                                 .capacity = queues_.capacity(),
                                 .rays = queue,
                                 .entryRadiance = queues_.entryRadiance,
                                 .sampleRadiance = queues_.sampleRadiance});
}

void Wavefront::film(const Buffer& blocks) {
  stages_.run(stages::Film{.batch = batch_,
                           .capacity = queues_.capacity(),
                           .pixels = setup_.pixels,
                           .planes = static_cast<std::uint32_t>(film_.bytes / sizeof(float) / setup_.pixels),
                           .blocks = blocks,
                           .sampleRadiance = queues_.sampleRadiance,
                           .sums = film_,
                           .counters = counters_});
}

std::uint32_t Wavefront::chunksOf(Segment segment) const {
  return (segment.count() + setup_.compactChunk - 1) / setup_.compactChunk;
}

bool Wavefront::mayHaveLongRuns(std::uint32_t count, std::uint32_t bounce) const {
  return count > LONG_RUN && StageConditions{setup_.features, 1, static_cast<int>(bounce)}.longRuns();
}

bool Wavefront::hasLongRuns(const Buffer& queue, std::uint32_t count, std::uint32_t bounce) {
  if (!mayHaveLongRuns(count, bounce)) return false;
  const std::uint32_t zero = 0;
  const std::size_t offset = COUNTER_LONG_RUN * sizeof(std::uint32_t);
  clTry("clearing a counter",
        [&] { compute_.queue().enqueueWriteBuffer(counters_.handle, CL_TRUE, offset, sizeof(zero), &zero); });
  stages_.run(stages::FindLongRuns{
      .count = count, .capacity = queues_.capacity(), .rays = queue, .counters = counters_});
  std::uint32_t found = 0;
  compute_.read(counters_, offset, sizeof(found), &found);
  return found != 0;
}

void Wavefront::checkWalks() {
  if (!setup_.hasLoopBudget) return;
  std::uint32_t spent = 0;
  compute_.read(counters_, COUNTER_SPENT_WALK * sizeof(std::uint32_t), sizeof(spent), &spent);
  if (spent != 0)
    throw ClError(
        fmt::format("a ray meets so many boxes and triangles that {} would end its search: its driver ends "
                    "loops after {} iterations; take another --device",
                    compute_.device().name, compute_.device().facts.loopLimit));
}

std::uint32_t Wavefront::nonFinite() {
  std::uint32_t count = 0;
  compute_.read(counters_, COUNTER_NONFINITE * sizeof(std::uint32_t), sizeof(count), &count);
  return count;
}

void Wavefront::countOn(const RayTally& tally, std::uint32_t nonFinite) {
  tally_ = tally;
  clTry("setting a counter", [&] {
    compute_.queue().enqueueWriteBuffer(counters_.handle, CL_TRUE, COUNTER_NONFINITE * sizeof(std::uint32_t),
                                        sizeof(nonFinite), &nonFinite);
  });
}

}  // namespace whittle
