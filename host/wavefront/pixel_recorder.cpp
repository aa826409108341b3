// See pixel_recorder.h.
#include "wavefront/pixel_recorder.h"

#include <cmath>

namespace whittle {
namespace {

/// Rec. 709.
float luminanceOf(const glm::dvec3& c) {
  return static_cast<float>(0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z);
}

}  // namespace

PixelRecorder::PixelRecorder(Compute& compute, const RayQueues& queues, const SceneFeatures& features,
                             int width, int height)
    : compute_(compute),
      queues_(queues),
      reader_(compute, queues),
      hasImpulses_(features.has(Feature::IMPULSES)),
      hasStraight_(features.has(Feature::STRAIGHT)),
      hasCost_(features.has(Feature::COST)),
      width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * height) {}

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

void PixelRecorder::readOrder(const ObservedSegment& s) {
  if (orderFrom_ == s.batch.firstPixel && order_.size() == s.batch.pixels) return;
  orderFrom_ = s.batch.firstPixel;
  order_.resize(s.batch.pixels);
  compute_.read(s.pixelOrder, orderFrom_ * sizeof(std::uint32_t), order_.size() * sizeof(std::uint32_t),
                order_.data());
}

void PixelRecorder::finished(const ObservedSegment& s) {
  if (s.batch.firstSample > 0) return;
  readOrder(s);
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
    const std::uint32_t at = order_[ofSlots[i] / s.batch.samples];
    Pixel& pixel = pixels_[static_cast<std::size_t>(at >> 16) * width_ + (at & 0xffffU)];
    pixel.nodes += nodes[i], pixel.tests += tests[i];
    const float light = luminanceOf(throughputs[i] * radiance[i]);
    if (!std::isfinite(light)) continue;  // the film leaves such a sample out
    pixel.light += light;
    pixel.lightTimesBounce += light * static_cast<float>(bounces[i]);
  }
}

FloatImage PixelRecorder::bounces() const {
  FloatImage image{width_, height_, 1, {}};
  image.pixels.reserve(pixels_.size());
  for (const Pixel& p : pixels_) image.pixels.push_back(p.light > 0.0F ? p.lightTimesBounce / p.light : 0.0F);
  return image;
}

FloatImage PixelRecorder::cost() const {
  FloatImage image{width_, height_, 2, {}};
  image.pixels.reserve(2 * pixels_.size());
  for (const Pixel& p : pixels_) {
    image.pixels.push_back(static_cast<float>(p.nodes));
    image.pixels.push_back(static_cast<float>(p.tests));
  }
  return image;
}

}  // namespace whittle
