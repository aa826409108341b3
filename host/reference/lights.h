// KHR_lights_punctual: what each light delivers at a point.
#pragma once

#include "reference/vec.h"
#include "scene/scene.h"

namespace whittle::reference {

struct LightSample {
  Vec3 w_i;         ///< unit, towards the light
  double distance;  ///< metres; infinite for directional lights
  Vec3 biradiance;  ///< unshadowed irradiance of a surface at the point that faces the light, W/m²
};

LightSample sampleLight(const Light& light, const Vec3& point);

}  // namespace whittle::reference
