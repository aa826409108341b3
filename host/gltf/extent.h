// Boxes around the points of accessors, each found once.
#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <map>

#include "gltf/document.h"

namespace whittle::gltf {

/// An axis-aligned box, empty at first.
struct Extent {
  glm::dvec3 lo{std::numeric_limits<double>::infinity()};
  glm::dvec3 hi{-std::numeric_limits<double>::infinity()};

  /// Takes `p` in, but for points that nothing can be drawn at: not finite, or 1e30 away.
  void grow(const glm::dvec3& p);
  /// Takes another box in.
  void grow(const Extent& other);
  bool isEmpty() const { return !(lo.x <= hi.x); }
  glm::dvec3 centre() const { return 0.5 * (lo + hi); }
  double diagonal() const { return isEmpty() ? 0.0 : glm::length(hi - lo); }
  /// The largest coordinate on either side of 0; 0 where it is empty.
  double farthest() const;
};

/// Boxes by accessor. What an accessor says of its bounds itself may be missing or wrong, so its
/// points are read.
class Extents {
 public:
  explicit Extents(Document& document) : document_(document) {}

  /// In the accessor's own space; empty where it does not hold points. Throws InputError if it
  /// cannot be read.
  const Extent& of(int accessor);

 private:
  Document& document_;
  std::map<int, Extent> known_;
};

}  // namespace whittle::gltf
