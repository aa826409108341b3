// Which numbers of lights and materials make sense, in the words that a user reads: of the loader, which
// mends a file, and of an edit, which is refused.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "scene/scene.h"

namespace whittle {

/// Of colour · intensity; empty: nothing is wrong with it.
inline std::string intensityFlaw(const glm::vec3& intensity) {
  for (int i = 0; i < 3; ++i) {
    if (intensity[i] >= 0.0F && std::isfinite(intensity[i])) continue;
    return intensity[i] > 0.0F ? "its intensity is beyond 3.4e38, the most that a float holds"
                               : "its intensity is negative";
  }
  return {};
}

inline constexpr const char* kConeFlaw = "cone angles outside 0 ≤ inner ≤ outer ≤ 90°";
/// Radians.
inline bool coneFits(double inner, double outer) {
  return inner >= 0.0 && inner <= outer && outer <= std::numbers::pi / 2 + 1e-6;
}

inline constexpr const char* kIorFlaw = "ior must not be negative";

/// See isInRange.
inline constexpr const char* kFactorFlaw = "a factor is outside its range";
}  // namespace whittle
