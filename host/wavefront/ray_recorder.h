// Writes down what becomes of the rays of one sample, read from the queues between the stages: the kernels'
// own numbers, for whoever asks why a pixel is as it is.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "cl/program.h"
#include "scene/ray_tree.h"
#include "wavefront/device_scene.h"
#include "wavefront/ray_queues.h"

namespace whittle {

/// What a wavefront tells whoever watches it, between two launches. Entry i of a segment is entry
/// segment.begin + i of the ray queue, and i of all other queues.
class WavefrontObserver {
 public:
  virtual ~WavefrontObserver() = default;
  /// Shading has found the candidates of a light round (0: with everything else); their shadow rays are not
  /// traced yet.
  virtual void shaded(const Buffer& queue, Segment segment, std::uint32_t bounce, std::uint32_t light,
                      const Buffer& radiance) = 0;
  /// They are.
  virtual void lit(Segment segment, std::uint32_t light, const Buffer& radiance) = 0;
};

class RayRecorder : public WavefrontObserver {
 public:
  /// `features`: those of the render.
  RayRecorder(Compute& compute, const RayQueues& queues, const DeviceScene& scene,
              const SceneFeatures& features);

  void shaded(const Buffer& queue, Segment segment, std::uint32_t bounce, std::uint32_t light,
              const Buffer& radiance) override;
  void lit(Segment segment, std::uint32_t light, const Buffer& radiance) override;

  /// Parents come before their children. Lights and materials are numbered as on the device.
  const std::vector<RayRecord>& rays() const { return rays_; }

 private:
  std::vector<float> plane(const Buffer& buffer, std::uint32_t plane, std::uint32_t first,
                           std::uint32_t count);
  std::vector<glm::dvec3> vectors(const Buffer& buffer, std::uint32_t firstPlane, std::uint32_t first,
                                  std::uint32_t count);
  void readRays(const Buffer& queue, Segment segment, std::uint32_t bounce);
  void readHits(std::uint32_t count);
  void readImpulses(std::uint32_t count, std::uint32_t bounce);
  RayRecord& of(std::uint32_t entry) { return rays_[segment_[entry]]; }

  Compute& compute_;
  const RayQueues& queues_;
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
