// Balls that lie in a heap: fruit in a bowl, gravel.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace generator {

struct HeapSpec {
  int count = 40;
  double radius = 1;  ///< of each ball
  double spread = 5;  ///< they start as far from the axis as this, above one another
  double start = 0;   ///< the height of the lowest
  int steps = 400;
  std::uint32_t series = 13000;
  /// Signed distance to what they lie in, below 0 inside it; in the unit of `radius`.
  std::function<double(glm::dvec3)> distance;
};

/// Middles of the balls at rest.
std::vector<glm::dvec3> heapOfBalls(const HeapSpec& spec);

}  // namespace generator
