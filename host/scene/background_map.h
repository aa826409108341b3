// Fills a background's equirectangular map from a function of direction.
#pragma once

#include <cmath>
#include <numbers>

#include "scene/scene.h"

namespace whittle {

/// A map whose texels are `radiance` (glm::dvec3 of a unit glm::dvec3, world) along their middles; see
/// Background for which those are.
template <typename Radiance>
Background mapOf(int width, int height, const Radiance& radiance) {
  Background background;
  background.radiance = glm::vec3(1.0F);
  background.width = width;
  background.height = height;
  background.map.reserve(std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    const double polar = (y + 0.5) / height * std::numbers::pi;
    for (int x = 0; x < width; ++x) {
      const double around = ((x + 0.5) / width - 0.5) * 2.0 * std::numbers::pi;
      const glm::dvec3 d(std::sin(polar) * std::sin(around), std::cos(polar),
                         -std::sin(polar) * std::cos(around));
      const glm::dvec3 seen = radiance(d);
      for (int c = 0; c < 3; ++c) background.map.push_back(static_cast<float>(seen[c]));
    }
  }
  return background;
}

}  // namespace whittle
