// Light of the sun on its way through clear air: what arrives, and what the air that scatters it sends down
// instead. Spectral, 380 to 780 nm.
#pragma once

#include <glm/vec3.hpp>

#include "scene/sky.h"

namespace whittle {

/// Lumens of a watt of white light, visible wavelengths alone: lx to W/m², cd/m² to W/(m² sr) (Ward 1994).
inline constexpr double kLumensPerWatt = 179.0;

struct Daylight {
  /// From the sun's disk on a surface that faces it: CIE 1931 XYZ, Y in lx.
  glm::dvec3 sun{0.0};
  /// From the sky on a level surface, lx.
  double sky = 0.0;
};

/// `sky` within its limits.
Daylight daylightOf(const Sky& sky);

/// Of what lies deeper than the horizon, seen from `height` metres: what the air on the way there keeps of
/// its light, and gives its own instead of. `down`: sine of the angle below the horizon, above 0.
double hazeBefore(const Sky& sky, double height, double down);

/// CIE XYZ to linear sRGB, Y to luminance; channels may be negative (IEC 61966-2-1).
glm::dvec3 linearFromXyz(const glm::dvec3& xyz);

}  // namespace whittle
