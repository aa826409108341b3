// What a wavefront tells whoever watches it, between two launches, and how to read its queues then.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "cl/program.h"
#include "kernels/shared/layout.h"
#include "wavefront/ray_queues.h"

namespace whittle {

/// A segment of a ray queue and where it comes from. Entry i of it is entry segment.begin + i of the ray
/// queue, and i of all other queues.
struct ObservedSegment {
  const Buffer& queue;
  Segment segment;
  std::uint32_t bounce;      ///< of the wavefront's loop: 1 for eye rays
  const Buffer& radiance;    ///< of its entries
  const Buffer& pixelOrder;  ///< of the pass
  device::Batch batch;
};

/// The turn of a light in a segment.
struct LightTurn {
  bool isFirst = false;     ///< all the rest is found, too
  bool hasRays = false;     ///< shadow candidates; what it brings without any is in the radiance
  std::uint32_t light = 0;  ///< of the device's
  std::uint32_t set = 0;    ///< of the queues' candidates and flags
};

class WavefrontObserver {
 public:
  virtual ~WavefrontObserver() = default;
  /// Shading has found the candidates of a light; their shadow rays are not traced yet.
  virtual void shaded(const ObservedSegment&, const LightTurn&) {}
  /// They are.
  virtual void lit(const ObservedSegment&, const LightTurn&) {}
  /// All lights have had their round: hits and radiance stand. Throughputs do not hold the segment's own
  /// hits.
  virtual void finished(const ObservedSegment&) {}
};

/// Planes of the queues on the host. Throws ClError as Compute::read.
class QueueReader {
 public:
  QueueReader(Compute& compute, const RayQueues& queues) : compute_(compute), capacity_(queues.capacity()) {}

  /// Entries [first, first + count) of a plane; T: as wide as a float.
  template <typename T>
  std::vector<T> plane(const Buffer& buffer, std::uint32_t plane, std::uint32_t first,
                       std::uint32_t count) const {
    static_assert(sizeof(T) == sizeof(float));
    std::vector<T> values(count);
    const std::size_t at = static_cast<std::size_t>(plane) * capacity_ + first;
    compute_.read(buffer, at * sizeof(T), count * sizeof(T), values.data());
    return values;
  }
  /// The same of three planes, the first of which is given.
  std::vector<glm::dvec3> vectors(const Buffer& buffer, std::uint32_t firstPlane, std::uint32_t first,
                                  std::uint32_t count) const {
    std::vector<glm::dvec3> values(count);
    for (int axis = 0; axis < 3; ++axis) {
      const auto part = plane<float>(buffer, firstPlane + static_cast<std::uint32_t>(axis), first, count);
      for (std::uint32_t i = 0; i < count; ++i) values[i][axis] = static_cast<double>(part[i]);
    }
    return values;
  }
  /// What the entries' rays carry; 1 for eye rays, which have no such planes.
  std::vector<glm::dvec3> throughputs(const ObservedSegment& s) const {
    const std::uint32_t count = s.segment.count();
    if (s.bounce == 1) return std::vector<glm::dvec3>(count, glm::dvec3(1));
    return vectors(s.queue, RAY_THROUGHPUT, s.segment.begin, count);
  }

 private:
  Compute& compute_;
  std::uint32_t capacity_;
};

}  // namespace whittle
