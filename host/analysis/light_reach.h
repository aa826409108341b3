// Which lights can reach nothing.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace whittle {

/// Box of the triangles that answer to light, world space, metres.
struct LitBounds {
  glm::vec3 lo{std::numeric_limits<float>::infinity()};
  glm::vec3 hi{-std::numeric_limits<float>::infinity()};

  void add(const glm::vec3& p) { lo = glm::min(lo, p), hi = glm::max(hi, p); }
  void add(const LitBounds& b) { lo = glm::min(lo, b.lo), hi = glm::max(hi, b.hi); }
};

/// Bounds of the triangles whose material, by index, is lit.
LitBounds litBounds(const Scene& scene, const std::vector<std::uint8_t>& lit);

/// Why a light adds nothing to any point of the box, or "" where it may.
std::string whyDark(const Light& light, const LitBounds& bounds);

}  // namespace whittle
