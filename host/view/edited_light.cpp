// See edited_light.h.
#include "view/edited_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whittle::view {
namespace {

glm::vec3 directionOf(double azimuth, double elevation) {
  constexpr double kPole = 1e-9;  // radians from it: straight up or down, without a rest of rounding
  const double level = std::abs(elevation) > std::numbers::pi / 2 - kPole ? 0.0 : std::cos(elevation);
  return {glm::dvec3(std::sin(azimuth) * level, std::sin(elevation), std::cos(azimuth) * level)};
}

}  // namespace

EditedLight::EditedLight(const Light& light)
    : intensity(static_cast<double>(std::max({light.intensity.x, light.intensity.y, light.intensity.z}))),
      position(light.position),
      azimuth(std::atan2(static_cast<double>(light.direction.x), static_cast<double>(light.direction.z))),
      elevation(std::atan2(
          static_cast<double>(light.direction.y),
          std::hypot(static_cast<double>(light.direction.x), static_cast<double>(light.direction.z)))),
      innerConeAngle(static_cast<double>(light.innerConeAngle)),
      outerConeAngle(static_cast<double>(light.outerConeAngle)) {
  if (intensity > 0.0) color = glm::dvec3(light.intensity) / intensity;
}

/// Unedited it has the file's bits: a quotient of floats times its divisor is off by less than a float
/// rounds.
Light EditedLight::asLight(const Light& ofFile) const {
  Light light = ofFile;
  light.intensity = isOn ? glm::vec3(color * intensity) : glm::vec3(0.0F);
  light.position = position;
  const EditedLight file(ofFile);
  if (azimuth != file.azimuth || elevation != file.elevation)
    light.direction = directionOf(azimuth, elevation);
  light.innerConeAngle = static_cast<float>(innerConeAngle);
  light.outerConeAngle = static_cast<float>(outerConeAngle);
  return light;
}

}  // namespace whittle::view
