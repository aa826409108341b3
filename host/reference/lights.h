// KHR_lights_punctual: what each light delivers at a point.
#pragma once

#include "reference/vec.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle::reference {

struct LightSample {
  Vec3 w_i;         ///< unit, towards the light
  double distance;  ///< metres; infinite for directional lights
  Vec3 biradiance;  ///< unshadowed irradiance of a surface at the point that faces the light, W/m²
};

/// From its middle.
LightSample sampleLight(const Light& light, const Vec3& point);

/// What a light of some size sends by one of its points, `u` of the unit square, in the place of all of it:
/// evenly in solid angle. `middle`: sampleLight's.
LightSample spread(const Light& light, const LightSample& middle, const Settings& settings, const Vec2& u);

}  // namespace whittle::reference
