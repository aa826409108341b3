// Writes down what becomes of the rays of one sample, read from the queues between the stages: the kernels'
// own numbers, for whoever asks why a pixel is as it is.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "wavefront/device_scene.h"
#include "wavefront/wavefront_observer.h"

namespace whittle {

/// A ray towards a light that would have to be free for its light to arrive.
struct ShadowRecord {
  std::uint32_t light = 0;  ///< of those on the device
  glm::vec3 origin{0.0F}, direction{0.0F};
  float length = 0.0F;           ///< metres
  glm::vec3 contribution{0.0F};  ///< radiance towards the ray's origin if nothing is in the way, W/(m² sr)
  glm::vec3 arrived{0.0F};       ///< what of it arrives
};

/// An impulse that is not followed.
struct EndedRecord {
  float throughput = 0.0F;  ///< in the largest channel
  bool byCutoff = false;    ///< else by a limit of depth
};

struct HitRecord {
  std::uint32_t primitive = 0;  ///< index of the triangle in the scene
  std::uint32_t material = 0;   ///< of those on the device
  float b1 = 0.0F, b2 = 0.0F;   ///< barycentrics
  glm::vec3 position{0.0F};     ///< metres, in the scene's coordinates
  glm::vec3 normal{0.0F};       ///< of the triangle, unit, towards the ray's origin
};

struct RayRecord {
  int parent = -1;            ///< in the list; −1: an eye ray
  std::uint32_t round = 1;    ///< of the wavefront's loop: 1 for eye rays
  bool goesStraight = false;  ///< on from where its parent hit
  glm::vec3 origin{0.0F}, direction{0.0F}, throughput{1.0F};
  std::optional<HitRecord> hit;  ///< none: it leaves the scene
  glm::vec3 local{0.0F};  ///< emission, background, and light that no shadow ray is sent for, W/(m² sr)
  glm::vec3 radiance{
      0.0F};  ///< that and what its shadow rays bring: times throughput its share of the sample
  std::vector<ShadowRecord> shadows;
  std::vector<EndedRecord> ended;
};

class RayRecorder : public WavefrontObserver {
 public:
  /// `features`: those of the render.
  RayRecorder(Compute& compute, const RayQueues& queues, const DeviceScene& scene,
              const SceneFeatures& features);

  void shaded(const ObservedSegment& s, std::uint32_t light) override;
  void lit(const ObservedSegment& s, std::uint32_t light) override;

  /// Parents come before their children.
  const std::vector<RayRecord>& rays() const { return rays_; }

 private:
  void readRays(const ObservedSegment& s);
  void readHits(std::uint32_t count);
  void readImpulses(std::uint32_t count, std::uint32_t bounce);
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
