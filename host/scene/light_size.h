// The size of lights, which the settings give all of a kind.
#pragma once

#include <cmath>
#include <numbers>

#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

/// 1 − cos of half the angle that directional lights fill, without cancellation; 0: they have none.
inline double sunVersine(const Settings& settings) {
  const double sine = std::sin(static_cast<double>(settings.sunAngle) * std::numbers::pi / 720.0);
  return 2.0 * sine * sine;
}

/// Whether the light has a size, so that its shadows have soft edges.
inline bool hasSize(const Light& light, const Settings& settings) {
  if (standsForOthers(light.kind)) return false;  // each has its own
  return (typeOf(light.kind).isPlaced ? settings.lightRadius : settings.sunAngle) > 0.0F;
}

}  // namespace whittle
