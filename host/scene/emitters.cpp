// See emitters.h.
#include "scene/emitters.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "scene/material_predicates.h"

namespace whittle {
namespace {

double areaOf(const Scene& scene, const Triangle& t) {
  const glm::dvec3 p0(scene.positions[t.v0]), p1(scene.positions[t.v1]), p2(scene.positions[t.v2]);
  return 0.5 * glm::length(glm::cross(p1 - p0, p2 - p0));
}

/// Of one m² of it.
double powerOf(const Material& m) {
  if (!emits(m) || isMasked(m)) return 0.0;
  return std::max({0.0F, m.emission.r, m.emission.g, m.emission.b});
}

}  // namespace

std::vector<Emitter> emittersOf(const Scene& scene) {
  std::vector<Emitter> emitters;
  std::vector<double> powers;
  double all = 0.0;
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const Triangle& t = scene.triangles[i];
    const double each = powerOf(scene.materials[t.material]);
    const double power = each > 0.0 ? each * areaOf(scene, t) : 0.0;
    if (!(power > 0.0)) continue;
    emitters.push_back({i, 0.0F, 0.0F, scene.materials[t.material].doubleSided});
    powers.push_back(power);
    all += power;
  }
  double sum = 0.0;
  float before = 0.0F;
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    sum += powers[i];
    Emitter& e = emitters[i];
    e.until = i + 1 == emitters.size() ? 1.0F : std::min(1.0F, static_cast<float>(sum / all));
    // The chance that it really has; 0: too small for a float, and never chosen.
    const double chance = static_cast<double>(e.until) - static_cast<double>(before);
    const double area = areaOf(scene, scene.triangles[e.triangle]);
    e.inverseDensity = chance > 0.0 ? static_cast<float>(area / chance) : 0.0F;
    before = e.until;
  }
  return emitters;
}

bool addSurfaceLight(Scene& scene) {
  const bool glows = std::any_of(scene.triangles.begin(), scene.triangles.end(), [&](const Triangle& t) {
    return powerOf(scene.materials[t.material]) > 0.0;
  });
  if (!glows) return false;
  Light light;
  light.name = "glowing surfaces";
  light.kind = LightKind::Surface;
  scene.lights.push_back(light);
  return true;
}

}  // namespace whittle
