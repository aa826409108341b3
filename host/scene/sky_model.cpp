// See sky_model.h. The coefficients are those of the paper's appendix A.2.
#include "scene/sky_model.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/background_map.h"

namespace whittle {
namespace {

/// The fit is of clear skies: below this turbidity its zenith turns black, and further on negative.
constexpr double kLeastFitted = 2.0;

/// Σ over rows and columns of T^(2−row) θ^(3−column) m: a chromaticity at the zenith; θ in radians.
double zenithChromaticity(const std::array<std::array<double, 4>, 3>& m, double turbidity, double theta) {
  double sum = 0.0;
  for (const auto& row : m)
    sum = sum * turbidity + ((row[0] * theta + row[1]) * theta + row[2]) * theta + row[3];
  return sum;
}

constexpr std::array<std::array<double, 4>, 3> kZenithX{{{0.00166, -0.00375, 0.00209, 0.0},
                                                         {-0.02903, 0.06377, -0.03202, 0.00394},
                                                         {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr std::array<std::array<double, 4>, 3> kZenithY{{{0.00275, -0.00610, 0.00317, 0.0},
                                                         {-0.04214, 0.08970, -0.04153, 0.00516},
                                                         {0.15346, -0.26756, 0.06670, 0.26688}}};

/// Directions over which irradiance is summed, evenly in what a level surface receives.
constexpr int kHeights = 96, kAround = 96;

}  // namespace

glm::dvec3 directionToSun(const Sky& sky) {
  const double elevation = sky.elevation * std::numbers::pi / 180.0;
  const double azimuth = std::remainder(sky.azimuth, 360.0) * std::numbers::pi / 180.0;
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
          std::cos(elevation) * std::cos(azimuth)};
}

double SkyModel::Perez::at(double cosZenith, double toSun) const {
  const double cosine = std::cos(toSun);
  return scale * (1.0 + a * std::exp(b / cosZenith)) * (1.0 + c * std::exp(d * toSun) + e * cosine * cosine);
}

SkyModel::SkyModel(const Sky& sky) : sky_(sky), toSun_(directionToSun(sky)) {
  const double t = std::max(sky.turbidity, kLeastFitted);
  const double theta = (90.0 - sky.elevation) * std::numbers::pi / 180.0;
  // The paper ends at the horizon: below it the zenith keeps the colour that it has then.
  const double fitted = std::min(theta, 0.5 * std::numbers::pi);
  perez_ = {{{-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
              -0.0033 * t + 0.0452, zenithChromaticity(kZenithX, t, fitted)},
             {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
              -0.0109 * t + 0.0529, zenithChromaticity(kZenithY, t, fitted)},
             {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
              -0.0670 * t + 0.3703, 1.0}}};
  for (Perez& p : perez_) p.scale = p.atZenith / p.at(1.0, theta);

  const Daylight light = daylightOf(sky);
  sunIrradiance_ = glm::max(linearFromXyz(light.sun), glm::dvec3(0.0)) / kLumensPerWatt;
  double lux = 0.0;
  for (int i = 0; i < kHeights; ++i)
    for (int j = 0; j < kAround; ++j) {
      const double y = std::sqrt((i + 0.5) / kHeights), around = 2.0 * std::numbers::pi * (j + 0.5) / kAround;
      const double across = std::sqrt(1.0 - y * y);
      const glm::dvec3 d(across * std::cos(around), y, across * std::sin(around));
      lux += std::numbers::pi / (kHeights * kAround) *
             perez_[2].at(y, std::acos(std::clamp(glm::dot(d, toSun_), -1.0, 1.0)));
      skyIrradiance_ += std::numbers::pi / (kHeights * kAround) * aboveHorizon(d);
    }
  const double brightness = light.sky / lux;
  perez_[2].scale *= brightness;
  skyIrradiance_ *= brightness;
  ground_ = kGroundAlbedo / std::numbers::pi * (skyIrradiance_ + sunIrradiance_ * std::max(toSun_.y, 0.0));
}

/// The luminance, and the colour that its chromaticities say; what sRGB has no place for is cut.
glm::dvec3 SkyModel::aboveHorizon(const glm::dvec3& d) const {
  constexpr double kLow = 1e-6;
  const double up = std::max(d.y, kLow), toSun = std::acos(std::clamp(glm::dot(d, toSun_), -1.0, 1.0));
  const double x = perez_[0].at(up, toSun), y = perez_[1].at(up, toSun);
  const double luminance = perez_[2].at(up, toSun);
  const glm::dvec3 xyz(x / y * luminance, luminance, (1.0 - x - y) / y * luminance);
  return glm::max(linearFromXyz(xyz), glm::dvec3(0.0)) / kLumensPerWatt;
}

glm::dvec3 SkyModel::radiance(const glm::dvec3& d) const {
  if (d.y > 0.0) return aboveHorizon(d);
  const double haze = d.y < 0.0 ? hazeBefore(sky_, kEyeHeight, std::min(-d.y, 1.0)) : 1.0;
  if (haze == 0.0) return ground_;  // right below, where no horizon is nearest
  return glm::mix(ground_, aboveHorizon(glm::normalize(glm::dvec3(d.x, 0.0, d.z))), haze);
}

void addSky(Scene& scene, const Sky& sky) {
  const SkyModel model(sky);
  scene.sky = sky;
  scene.background = mapOf(kSkyWidth, kSkyHeight, [&](const glm::dvec3& d) { return model.radiance(d); });
  scene.background.hasSun = true;
  if (model.sunIrradiance() == glm::dvec3(0.0)) return;
  Light sun;
  sun.name = "sun";
  sun.kind = LightKind::Directional;
  sun.intensity = glm::vec3(model.sunIrradiance());
  Sky seen = sky;
  seen.elevation = std::max(sky.elevation, 0.0);  // the air lifts a disk that has not set yet
  sun.direction = glm::vec3(-directionToSun(seen));
  scene.lights.push_back(sun);
}

}  // namespace whittle
