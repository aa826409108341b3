// Small scenes built by hand, and single rays through them. Lengths in metres, radiance in W/(m² sr).
#pragma once

#include <utility>

#include "reference/trace.h"

namespace whittle::test {

using reference::Ray;
using reference::Vec2;
using reference::Vec3;
using reference::Vec4;

/// Light scattered evenly and nothing else: specular 0 takes the dielectric's own reflection away.
inline Material lambert(const glm::vec3& colour) {
  Material m;
  m.baseColor = glm::vec4(colour, 1);
  m.metallic = 0;
  m.specular = 0;
  return m;
}

inline Material emitter(const glm::vec3& radiance) {
  Material m = lambert(glm::vec3(0));
  m.emission = radiance;
  m.doubleSided = true;
  return m;
}

/// A place on a white metal with that normal and roughness.
inline reference::Surfel whiteMetalAt(const Vec3& n, double roughness) {
  return {.position = Vec3(0),
          .facing = n,
          .n = n,
          .front = true,
          .rayOffset = 0,
          .baseColor = Vec3(1),
          .alpha = 1,
          .metallic = 1,
          .roughness = roughness,
          .transmission = 0,
          .smooth = false,
          .glossy = true,
          .volume = false,
          .unlit = false,
          .fresnel = {1.5, 1, Vec3(1)},
          .eta = 1.5,
          .emission = Vec3(0),
          .sigma_a = Vec3(0)};
}

/// Reflectance `colour` at normal incidence, on both sides.
inline Material mirror(const glm::vec3& colour) {
  Material m;
  m.doubleSided = true;
  m.baseColor = glm::vec4(colour, 1);
  m.roughness = 0;
  return m;
}

inline Material glass(float ior, bool volume) {
  Material m;
  m.metallic = 0;
  m.roughness = 0;
  m.transmission = 1;
  m.ior = ior;
  m.volume = volume;
  return m;
}

inline std::uint32_t addMaterial(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

/// Two triangles: corner, corner + u, corner + u + v, corner + v; its front has the normal u × v.
inline void addQuad(Scene& scene, std::uint32_t material, const glm::vec3& corner, const glm::vec3& u,
                    const glm::vec3& v) {
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  scene.positions.insert(scene.positions.end(), {corner, corner + u, corner + u + v, corner + v});
  scene.triangles.push_back({first, first + 1, first + 2, material});
  scene.triangles.push_back({first, first + 2, first + 3, material});
}

/// A square of half side `half` about the y axis at height y; its front looks up, or down.
inline void addFloor(Scene& scene, const Material& material, float y, bool up = true, float half = 50) {
  const std::uint32_t m = addMaterial(scene, material);
  const glm::vec3 x(2 * half, 0, 0), z(0, 0, 2 * half), corner(-half, y, -half);
  up ? addQuad(scene, m, corner, z, x) : addQuad(scene, m, corner, x, z);
}

inline Light pointLight(const glm::vec3& position, float intensity) {
  Light light;
  light.position = position;
  light.intensity = glm::vec3(intensity);
  return light;
}

/// Looks straight down from y = 1, 2 m of height, −z at the top of the picture.
inline Camera lookingDown(const std::string& name = "down") {
  Camera camera;
  camera.name = name;
  camera.orthographic = true;
  camera.position = {0, 1, 0};
  camera.forward = {0, -1, 0};
  camera.up = {0, 0, -1};
  return camera;
}

/// An offset that is far below every tolerance, where an expected value knows of none.
inline Settings exactSettings() {
  Settings settings;
  settings.rayOffset = 1e-12F;
  return settings;
}

/// A scene ready for single rays, and the count of those.
class Probe {
 public:
  explicit Probe(Scene scene, Settings settings = exactSettings())
      : scene_(withCamera(std::move(scene))), settings_(std::move(settings)), triangles_(scene_) {}

  Vec3 Li(const Vec3& origin, const Vec3& direction) {
    const reference::Sample sample{0, 0, rays};
    return reference::Li(world(), sample, {origin, glm::normalize(direction)}, {}, Vec3(1));
  }
  reference::World world() const { return {scene_, settings_, triangles_, scene_.cameras[0]}; }
  std::optional<reference::Surfel> surfelAlong(const Ray& ray) const {
    const auto hit = reference::nearestSurface(world(), ray);
    if (!hit) return std::nullopt;
    return reference::makeSurfel(scene_, settings_, triangles_, ray, *hit);
  }
  Settings& settings() { return settings_; }

  RayCounts rays;

 private:
  static Scene withCamera(Scene scene) {
    if (scene.cameras.empty()) scene.cameras.emplace_back();
    return scene;
  }

  Scene scene_;
  Settings settings_;
  reference::TriangleIndex triangles_;
};

}  // namespace whittle::test
