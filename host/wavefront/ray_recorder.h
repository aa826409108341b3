// Writes down what becomes of the rays of one sample, read from the queues between the stages: the kernels'
// own numbers, for whoever asks why a pixel is as it is.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/ray_tree.h"
#include "wavefront/device_scene.h"
#include "wavefront/wavefront_observer.h"

namespace whittle {

class RayRecorder : public WavefrontObserver {
 public:
  /// `features`: those of the render.
  RayRecorder(Compute& compute, const RayQueues& queues, const DeviceScene& scene,
              const SceneFeatures& features);

  void shaded(const ObservedSegment& s, const LightTurn& turn) override;
  void lit(const ObservedSegment& s, const LightTurn& turn) override;

  /// Parents come before their children. Lights and materials are numbered as on the device.
  const std::vector<RayRecord>& rays() const { return rays_; }

 private:
  void readRays(const ObservedSegment& s);
  void readHits(std::uint32_t count);
  void readImpulses(std::uint32_t count, std::uint32_t bounce);
  /// Rays that an impulse that splits becomes.
  std::uint32_t carriedChannels(std::uint32_t entry) const;
  RayRecord& of(std::uint32_t entry) { return rays_[segment_[entry]]; }

  Compute& compute_;
  const RayQueues& queues_;
  QueueReader reader_;
  const DeviceScene& scene_;
  const SceneFeatures& features_;
  std::vector<RayRecord> rays_;
  /// [bounce] the records of the entries of that bounce's queue: the loop goes down at once into each queue
  /// that a segment fills.
  std::vector<std::vector<std::size_t>> entries_;
  std::vector<std::size_t> segment_;  ///< of the segment under way
  std::vector<unsigned char> flags_;  ///< the same
};

}  // namespace whittle
