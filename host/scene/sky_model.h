// A clear sky after Preetham, Shirley and Smits 1999, "A Practical Analytic Model for Daylight": how bright
// it is in each direction beside the zenith, and in what colour. How bright it is altogether follows from
// sun_light.h, since the paper's own zenith sends down more than arrives (host/reference/README.md).
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "scene/scene.h"
#include "scene/sun_light.h"

namespace whittle {

/// Of the ground below the horizon: what it sends back of the light of sun and sky.
inline constexpr double kGroundAlbedo = 0.2;
/// Where the horizon is seen from, metres above that ground: the farther the ground, the more haze before it.
inline constexpr double kEyeHeight = 100.0;

/// Sides of the map that addSky makes.
inline constexpr int kSkyWidth = 1024, kSkyHeight = 512;

/// Unit, world. Points down where the sun is below the horizon.
glm::dvec3 directionToSun(const Sky& sky);

class SkyModel {
 public:
  /// `sky` within its limits.
  explicit SkyModel(const Sky& sky);

  /// Radiance seen along `d` (unit, world), without the sun's disk: linear sRGB, W/(m² sr), never negative.
  /// Below the horizon: the ground's, and the horizon's where haze lies before it.
  glm::dvec3 radiance(const glm::dvec3& d) const;
  /// From the sun on a surface that faces it: linear sRGB, W/m².
  const glm::dvec3& sunIrradiance() const { return sunIrradiance_; }
  /// From the sky on a level surface: linear sRGB, W/m².
  const glm::dvec3& skyIrradiance() const { return skyIrradiance_; }

 private:
  /// The distribution of Perez, Seals, Michalsky 1993, of one quantity.
  struct Perez {
    double a, b, c, d, e;
    double atZenith = 0.0;  ///< the quantity there
    double scale = 1.0;     ///< atZenith over what the distribution has there
    double at(double cosZenith, double toSun) const;
  };

  glm::dvec3 aboveHorizon(const glm::dvec3& d) const;

  Sky sky_;
  glm::dvec3 toSun_;
  std::array<Perez, 3> perez_;  ///< chromaticities x and y, luminance in cd/m²
  glm::dvec3 sunIrradiance_, skyIrradiance_{0.0}, ground_{0.0};
};

/// Surrounds the scene with the sky, as a map, in the place of its background, and adds the sun, a
/// directional light called "sun", behind its lights. A sun that has set sends no light.
void addSky(Scene& scene, const Sky& sky);

}  // namespace whittle
