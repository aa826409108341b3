// What the rays of each pixel's first sample cost and bring, read from the queues between the stages:
// auxiliary outputs that no stage has to know of.
#pragma once

#include <cstdint>
#include <vector>

#include "analysis/scene_features.h"
#include "image/image_io.h"
#include "wavefront/wavefront_observer.h"

namespace whittle {

class PixelRecorder : public WavefrontObserver {
 public:
  /// `features`: those of the render.
  PixelRecorder(Compute& compute, const RayQueues& queues, const SceneFeatures& features,
                const Settings& settings);

  void finished(const ObservedSegment& s) override;

  /// [1] At which bounce the sample's light came, the mean weighted with its luminance: 1
  /// where it comes from what the eye sees, 2 behind one mirror; what goes straight on is no bounce. 0: none
  /// came.
  FloatImage bounces() const;
  /// [2] Nodes opened and triangles tested by the searches for the hits of the sample's rays;
  /// of rays that go as a packet those of the packet. Needs Feature::COST.
  FloatImage cost() const;

 private:
  struct Pixel {
    std::uint32_t place = 0;  ///< y << 16 | x of the picture
    float light = 0.0F, lightTimesBounce = 0.0F;
    std::uint32_t nodes = 0, tests = 0;
  };
  std::vector<std::uint32_t> slots(const ObservedSegment& s) const;
  std::vector<std::uint32_t> bouncesOf(const ObservedSegment& s) const;
  void readPlaces(const ObservedSegment& s);

  Compute& compute_;
  const RayQueues& queues_;
  QueueReader reader_;
  bool hasImpulses_, hasStraight_, hasCost_;
  const Settings& settings_;
  std::vector<Pixel> pixels_;  ///< in the film's order
  std::uint32_t placed_ = 0;   ///< of them have their place
};

}  // namespace whittle
