// See appearance.h.
#include "scene/appearance.h"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace whittle {
namespace {

/// The numbers that can be edited, once: of a constant thing to be read, else to be written.
auto numbersOf(auto& light) requires requires { light.outerConeAngle; }
{
  return std::tie(light.intensity, light.position, light.direction, light.innerConeAngle,
                  light.outerConeAngle);
}
auto numbersOf(auto& material) requires requires { material.roughness; }
{
  return std::tie(material.baseColor, material.metallic, material.roughness, material.transmission,
                  material.ior, material.emission);
}

template <typename T>
void setNumbers(const std::vector<T>& from, std::vector<T>& to) {
  assert(from.size() == to.size());
  for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i) numbersOf(to[i]) = numbersOf(from[i]);
}

}  // namespace

Appearance appearanceOf(const Scene& scene) {
  return {scene.lights, scene.materials, scene.background.radiance, scene.background.rotation};
}

void setAppearance(const Appearance& appearance, Scene& scene) {
  setNumbers(appearance.lights, scene.lights);
  setNumbers(appearance.materials, scene.materials);
  scene.background.radiance = appearance.backgroundRadiance;
  scene.background.rotation = appearance.backgroundRotation;
}

bool differs(const Light& a, const Light& b) { return numbersOf(a) != numbersOf(b); }
bool differs(const Material& a, const Material& b) { return numbersOf(a) != numbersOf(b); }

void turnAndScale(Background& background, const Settings& settings) {
  background.radiance = background.unscaled * settings.backgroundStrength;
  background.rotation = background.hasSun ? 0.0 : settings.backgroundRotation;
}

}  // namespace whittle
