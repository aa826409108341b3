// The render loop. Each method that launches is named after its kernel and its file in kernels/.
#include "wavefront/wavefront.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "wavefront/queue_traffic.h"

namespace whittle {

Wavefront::Wavefront(Compute& compute, StageRunner& stages, RayQueues& queues, const WavefrontSetup& setup,
                     const Buffer& film, const Buffer& aovs)
    : compute_(compute), stages_(stages), queues_(queues), setup_(setup), film_(film), aovs_(aovs) {
  counters_ = compute_.allocate("counters", COUNTERS * sizeof(std::uint32_t));
  compute_.fillZero(counters_);
  tally_.cutOff.resize(setup_.bounces);
}

std::uint32_t Wavefront::trace(const TracePass& pass, const KeepGoing& keepGoing) {
  keepGoing_ = &keepGoing;
  pixelOrder_ = &pass.order;
  const std::uint32_t room = queues_.segmentLimit();
  assert(room >= FILM_BLOCK);
  // Whole blocks, so that a pass can end between batches.
  const std::uint32_t samplesAtOnce = std::min(pass.samples, room / FILM_BLOCK);
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
    // The queue of the last segment is free before the next bounce: two queues serve a path that is never
    // cut.
    if (segment.end == count) queues_.release(std::move(queue));
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
  intersect(queue, segment);
  shade(queue, segment, bounce);
  const Candidates found = countCandidates(segment);
  stages_.addBytes("shade",
                   traffic::shadowCandidates(found.shadow) + traffic::impulseCandidates(found.impulse));
  tally_.cutOff[bounce - 1] += found.cutOff;
  occlude(compactShadow(segment, found.shadow));
  for (std::uint32_t light = 1; light < setup_.scene.lightCount; ++light) {
    shadeLight(queue, segment, light);
    const Candidates lit = countCandidates(segment);
    stages_.addBytes("shade_light", traffic::shadowCandidates(lit.shadow));
    occlude(compactShadow(segment, lit.shadow));
  }
  if (bounce > 1) accumulate(queue, segment);
  return bounce < setup_.bounces ? compactImpulse(queue, segment, found.impulse, next) : 0;
}

void Wavefront::raygen(const Buffer& queue, std::uint32_t count) {
  const bool slots = setup_.features.has(Feature::IMPULSES);
  stages_.run("raygen", laneItems(count), {count, traffic::raygen(count, batch_.pixels, slots)},
              setup_.camera, batch_, count, queues_.capacity(), *pixelOrder_, queue);
  tally_.primary += count;
  tally_.produced += count;
}

void Wavefront::intersect(const Buffer& queue, Segment segment) {
  stages_.run("intersect", searchItems(segment.count()),
              {segment.count(), traffic::intersect(segment.count(), queues_.hitBytes())}, setup_.scene,
              segment.begin, segment.count(), queues_.capacity(), queue, queues_.hits, queues_.hitPlanes());
}

void Wavefront::shade(const Buffer& queue, Segment segment, std::uint32_t bounce) {
  const bool throughputs = bounce > 1 && bounce < setup_.bounces;
  const auto bytes = traffic::shade(segment.count(), throughputs, queues_.hitBytes(), queues_.flagBytes());
  stages_.run("shade", laneItems(segment.count()), {segment.count(), bytes}, setup_.scene, setup_.constants,
              batch_, segment.begin, segment.count(), queues_.capacity(), bounce, setup_.bounces,
              setup_.camera.width, setup_.camera.width * setup_.camera.height, *pixelOrder_, queue,
              queues_.hits, *radiance_, queues_.shadows, queues_.impulses, queues_.flags, aovs_);
  tally_.finished += segment.count();
}

void Wavefront::shadeLight(const Buffer& queue, Segment segment, std::uint32_t light) {
  stages_.run(
      "shade_light", laneItems(segment.count()),
      {segment.count(), traffic::shadeLight(segment.count(), queues_.hitBytes(), queues_.flagBytes())},
      setup_.scene, setup_.constants, segment.begin, segment.count(), queues_.capacity(), light, queue,
      queues_.hits, *radiance_, queues_.shadows, queues_.flags);
}

Wavefront::Candidates Wavefront::countCandidates(Segment segment) {
  if (!queues_.flags) return {};
  const std::uint32_t chunks = chunksOf(segment);
  stages_.run("compact_count", chunks,
              {segment.count(), traffic::compactCount(segment.count(), queues_.flagBytes())}, segment.count(),
              queues_.flags, queues_.totals);
  const std::uint32_t kinds = setup_.features.has(Feature::CUTOFF) ? 3 : 2;
  stages_.run("scan_chunks", kinds, {chunks, traffic::scanChunks(chunks, kinds)}, chunks, queues_.totals,
              queues_.sums);
  std::array<std::uint32_t, 4> sums{};
  const auto work = stages_.hostWork("wait for counts");
  compute_.read(queues_.sums, 0, queues_.sums.bytes, sums.data());
  return {sums[0], sums[1], std::uint64_t{sums[3]} << 32 | sums[2]};
}

std::uint32_t Wavefront::compactShadow(Segment segment, std::uint32_t found) {
  if (found == 0) return 0;
  stages_.run("compact_shadow", chunksOf(segment),
              {segment.count(), traffic::compactShadow(segment.count(), found, queues_.flagBytes())},
              segment.count(), queues_.flags, queues_.totals, queues_.shadowQueue);
  tally_.shadow += found;
  return found;
}

void Wavefront::occlude(std::uint32_t count) {
  if (count == 0) return;
  stages_.run("occlude", searchItems(count), {count, traffic::occlude(count)}, setup_.scene, count,
              queues_.capacity(), queues_.shadowQueue, queues_.shadows, *radiance_);
}

std::uint32_t Wavefront::compactImpulse(const Buffer& queue, Segment segment, std::uint32_t found,
                                        Buffer& next) {
  if (found == 0) return 0;
  assert(found <= queues_.capacity());
  next = queues_.acquire();
  stages_.run("compact_impulse", chunksOf(segment),
              {segment.count(), traffic::compactImpulse(segment.count(), found, queues_.flagBytes())},
              segment.begin, segment.count(), queues_.capacity(), queues_.flags, queues_.totals,
              queues_.impulses, queue, next);
  tally_.impulse += found;
  tally_.produced += found;
  return found;
}

void Wavefront::accumulate(const Buffer& queue, Segment segment) {
  stages_.run("accumulate", segment.count(), {segment.count(), traffic::accumulate(segment.count())},
              segment.begin, segment.count(), queues_.capacity(), queue, queues_.entryRadiance,
              queues_.sampleRadiance);
}

void Wavefront::film(const Buffer& blocks) {
  const std::uint32_t pixels = setup_.camera.width * setup_.camera.height;
  const auto planes = static_cast<std::uint32_t>(film_.bytes / sizeof(float) / pixels);
  const auto bytes = traffic::film(batch_.pixels, batch_.samples, planes, batch_.firstSample == 0);
  stages_.run("film", laneItems(batch_.pixels), {batch_.pixels, bytes}, batch_, queues_.capacity(), pixels,
              planes, blocks, queues_.sampleRadiance, film_, counters_);
}

std::uint32_t Wavefront::chunksOf(Segment segment) const {
  return (segment.count() + setup_.compactChunk - 1) / setup_.compactChunk;
}

bool Wavefront::mayHaveLongRuns(std::uint32_t count, std::uint32_t bounce) const {
  // A sample has at most 2^(bounce-1) entries in the queue of a bounce.
  return setup_.features.has(Feature::BOTH_BRANCHES) && count > LONG_RUN && bounce >= 10;
}

bool Wavefront::hasLongRuns(const Buffer& queue, std::uint32_t count, std::uint32_t bounce) {
  if (!mayHaveLongRuns(count, bounce)) return false;
  const std::uint32_t zero = 0;
  const std::size_t offset = COUNTER_LONG_RUN * sizeof(std::uint32_t);
  clTry("clearing a counter",
        [&] { compute_.queue().enqueueWriteBuffer(counters_.handle, CL_TRUE, offset, sizeof(zero), &zero); });
  stages_.run("find_long_runs", count, {count, traffic::findLongRuns(count)}, count, queues_.capacity(),
              queue, counters_);
  std::uint32_t found = 0;
  compute_.read(counters_, offset, sizeof(found), &found);
  return found != 0;
}

std::uint32_t Wavefront::laneItems(std::uint32_t entries) const {
  return setup_.features.has(Feature::PACKETS) ? (entries + ENTRY_LANES - 1) / ENTRY_LANES : entries;
}

std::uint32_t Wavefront::searchItems(std::uint32_t rays) const {
  return setup_.features.has(Feature::PACKETS) ? (rays + PACKET_RAYS - 1) / PACKET_RAYS : rays;
}

std::uint32_t Wavefront::nonFinite() {
  std::uint32_t count = 0;
  compute_.read(counters_, COUNTER_NONFINITE * sizeof(std::uint32_t), sizeof(count), &count);
  return count;
}

}  // namespace whittle
