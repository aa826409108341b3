// The triangles that glow, as a table to choose one from at random: what a surface light (LightKind::Surface)
// is made of.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace whittle {

struct Emitter {
  std::uint32_t triangle = 0;   ///< index in the scene
  float until = 0.0F;           ///< chosen where the last one's `until` <= u < this; the last has 1
  float inverseDensity = 0.0F;  ///< m²: one over the density of its points, where they are chosen evenly
  bool twoSided = false;        ///< it glows on both sides
  bool operator==(const Emitter&) const = default;
};

/// By their power: area times the largest channel of the emission's factor. In the scene's order. Without
/// masked ones, whose holes would glow, and those without an area.
std::vector<Emitter> emittersOf(const Scene& scene);

/// Adds the light that all of them are together, if there are any; false: there are none.
bool addSurfaceLight(Scene& scene);

}  // namespace whittle
