// Light from the background by one direction, in double precision.
#pragma once

#include "reference/lights.h"
#include "reference/surfel.h"
#include "scene/sky_light.h"

namespace whittle::reference {

/// `u` of the unit square. A background of one colour: about the normal, as Lambert weighs directions. A map:
/// into a texel chosen by `table`, evenly in solid angle.
LightSample sampleSky(const Background& background, const SkyTable& table, const Surfel& lit, const Vec2& u);

}  // namespace whittle::reference
