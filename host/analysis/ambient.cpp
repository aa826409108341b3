#include "analysis/ambient.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace whittle {
namespace {

constexpr double kShare = 0.1;

struct Sphere {
  glm::dvec3 center{0};
  double radius = 0.0;
};

/// About the box of all triangles.
Sphere sphereAbout(const Scene& scene) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  glm::dvec3 lo(inf), hi(-inf);
  for (const Triangle& t : scene.triangles)
    for (const std::uint32_t v : {t.v0, t.v1, t.v2})
      lo = glm::min(lo, glm::dvec3(scene.positions[v])), hi = glm::max(hi, glm::dvec3(scene.positions[v]));
  if (scene.triangles.empty()) return {};
  return {(lo + hi) / 2.0, glm::length(hi - lo) / 2.0};
}

glm::dvec3 meanOf(const Background& background) {
  if (background.map.empty()) return background.radiance;
  // Rows count by the solid angle that they cover.
  glm::dvec3 sum(0);
  double weights = 0.0;
  for (int y = 0; y < background.height; ++y) {
    const double weight = std::sin(std::numbers::pi * (y + 0.5) / background.height);
    glm::dvec3 row(0);
    for (int x = 0; x < background.width; ++x)
      for (int c = 0; c < 3; ++c)
        row[c] += background.map[(static_cast<std::size_t>(y) * background.width + x) * 3 + c];
    sum += weight * row;
    weights += weight * background.width;
  }
  return sum / weights * glm::dvec3(background.radiance);
}

}  // namespace

float automaticAmbient(const Scene& scene) {
  const Sphere bounds = sphereAbout(scene);
  glm::dvec3 irradiance(0);
  for (const Light& light : scene.lights) {
    if (standsForOthers(light.kind))
      continue;  // how near surfaces are is not known, the background counts below
    if (light.kind == LightKind::Directional) {
      irradiance += glm::dvec3(light.intensity);
      continue;
    }
    const double away = glm::length(glm::dvec3(light.position) - bounds.center);
    const double distance = std::max(away, bounds.radius);
    if (distance > 0.0 && distance < static_cast<double>(light.range))
      irradiance += glm::dvec3(light.intensity) / (distance * distance);
  }
  const glm::dvec3 sentBack = irradiance / std::numbers::pi + meanOf(scene.background);
  const double ambient = kShare * std::max(sentBack.x, std::max(sentBack.y, sentBack.z));
  return std::isfinite(ambient) ? static_cast<float>(ambient) : 0.0F;
}

}  // namespace whittle
