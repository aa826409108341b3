// See pixel_recorder.h.
#include "wavefront/pixel_recorder.h"

#include <cmath>

#include "wavefront/film.h"

namespace whittle {
namespace {

/// Rec. 709.
float luminanceOf(const glm::dvec3& c) {
  return static_cast<float>(0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z);
}

}  // namespace

PixelRecorder::PixelRecorder(Compute& compute, const RayQueues& queues, const SceneFeatures& features,
                             const Settings& settings)
    : compute_(compute),
      queues_(queues),
      reader_(compute, queues),
      hasImpulses_(features.has(Feature::IMPULSES)),
      hasStraight_(features.has(Feature::STRAIGHT)),
      hasCost_(features.has(Feature::COST)),
      settings_(settings),
      pixels_(tracedRegion(settings).pixels()) {}

/// Without impulses entry i is that of slot i, and nobody writes it.
std::vector<std::uint32_t> PixelRecorder::slots(const ObservedSegment& s) const {
  const std::uint32_t count = s.segment.count();
  if (hasImpulses_) return reader_.plane<std::uint32_t>(s.queue, RAY_SLOT, s.segment.begin, count);
  std::vector<std::uint32_t> slots(count);
  for (std::uint32_t i = 0; i < count; ++i) slots[i] = s.segment.begin + i;
  return slots;
}

std::vector<std::uint32_t> PixelRecorder::bouncesOf(const ObservedSegment& s) const {
  const std::uint32_t count = s.segment.count();
  if (!hasStraight_ || s.bounce == 1) return std::vector<std::uint32_t>(count, s.bounce);
  auto steps = reader_.plane<std::uint32_t>(s.queue, RAY_STEPS, s.segment.begin, count);
  for (std::uint32_t& step : steps) step &= STEP_STRAIGHT - 1;
  return steps;
}

/// Batches go through the film's pixels in their order.
void PixelRecorder::readPlaces(const ObservedSegment& s) {
  const std::uint32_t end = s.batch.firstPixel + s.batch.pixels;
  if (end <= placed_) return;
  std::vector<std::uint32_t> places(s.batch.pixels);
  compute_.read(s.pixelOrder, s.batch.firstPixel * sizeof(std::uint32_t),
                places.size() * sizeof(std::uint32_t), places.data());
  for (std::uint32_t i = 0; i < s.batch.pixels; ++i) pixels_[s.batch.firstPixel + i].place = places[i];
  placed_ = end;
}

void PixelRecorder::finished(const ObservedSegment& s) {
  if (s.batch.firstSample > 0) return;
  readPlaces(s);
  const std::uint32_t count = s.segment.count();
  const auto ofSlots = slots(s), bounces = bouncesOf(s);
  const auto throughputs = reader_.throughputs(s), radiance = reader_.vectors(s.radiance, 0, 0, count);
  std::vector<std::uint32_t> nodes(count), tests(count);
  if (hasCost_) {
    nodes = reader_.plane<std::uint32_t>(queues_.hits, HIT_NODES, 0, count);
    tests = reader_.plane<std::uint32_t>(queues_.hits, HIT_TESTS, 0, count);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    if (ofSlots[i] % s.batch.samples != 0) continue;
    Pixel& pixel = pixels_[s.batch.firstPixel + ofSlots[i] / s.batch.samples];
    pixel.nodes += nodes[i], pixel.tests += tests[i];
    const float light = luminanceOf(throughputs[i] * radiance[i]);
    if (!std::isfinite(light)) continue;  // the film leaves such a sample out
    pixel.light += light;
    pixel.lightTimesBounce += light * static_cast<float>(bounces[i]);
  }
}

FloatImage PixelRecorder::bounces() const {
  FloatImage image = blackImage(settings_, 1);
  for (const Pixel& p : pixels_)
    image.pixels[placeOf(p.place, image)] = p.light > 0.0F ? p.lightTimesBounce / p.light : 0.0F;
  return image;
}

FloatImage PixelRecorder::cost() const {
  FloatImage image = blackImage(settings_, 2);
  for (const Pixel& p : pixels_) {
    const std::size_t at = 2 * placeOf(p.place, image);
    image.pixels[at] = static_cast<float>(p.nodes);
    image.pixels[at + 1] = static_cast<float>(p.tests);
  }
  return image;
}

}  // namespace whittle
