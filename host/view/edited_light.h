// A light under edit: numbers as a user turns them, there and back without the loss of a bit.
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace whittle::view {

/// A light as a hand turns its knobs: off, its intensity is kept.
struct EditedLight {
  explicit EditedLight(const Light& light);
  /// The file's light with these values.
  Light asLight(const Light& ofFile) const;

  bool isOn = true;
  double intensity = 0.0;  ///< the largest channel's
  glm::dvec3 color{1.0};   ///< linear
  glm::vec3 position;
  /// Where it shines, radians: azimuth from +Z towards +X, elevation above the horizon.
  double azimuth, elevation;
  double innerConeAngle, outerConeAngle;  ///< radians
  bool operator==(const EditedLight&) const = default;
};

}  // namespace whittle::view
