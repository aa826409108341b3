// addDefaults of loader.h: a camera and lights for files that have none. Reads and writes the scene
// only.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gltf/loader.h"
#include "scene/material_predicates.h"

namespace whittle {

namespace {

struct Box {
  glm::dvec3 lo{-1.0};
  glm::dvec3 hi{1.0};
};

/// Of the triangles, not of all vertices; a box of two metres around the origin where there are none.
Box boundsOf(const Scene& scene) {
  if (scene.triangles.empty()) return {};
  const double inf = std::numeric_limits<double>::infinity();
  Box box{glm::dvec3(inf), glm::dvec3(-inf)};
  for (const Triangle& t : scene.triangles) {
    for (const std::uint32_t v : {t.v0, t.v1, t.v2}) {
      box.lo = glm::min(box.lo, glm::dvec3(scene.positions[v]));
      box.hi = glm::max(box.hi, glm::dvec3(scene.positions[v]));
    }
  }
  return box;
}

/// How steeply to look down on a box whose visible side is `width` by `height` and which is `depth` deep, in
/// radians.
double elevationFor(double width, double height, double depth) {
  constexpr double kFlat = 1e-3;
  if (depth <= kFlat * std::max(width, height)) return 0.0;  // a picture: front on
  if (height <= kFlat * std::max(width, depth)) return 1.2;  // a floor
  if (height < 0.2 * std::min(width, depth)) return 0.6;     // a landscape
  return 0.3;
}

Camera framingCamera(const Scene& scene) {
  constexpr double kYfov = 0.7;
  constexpr double kAspect = 16.0 / 9.0;
  constexpr double kMargin = 1.1;  // of the half picture, between the box and its edge
  const Box box = boundsOf(scene);
  const glm::dvec3 centre = 0.5 * (box.lo + box.hi);
  const glm::dvec3 half = 0.5 * (box.hi - box.lo);

  const bool facesX = half.z > half.x;
  const double width = facesX ? half.z : half.x;
  const double depth = facesX ? half.x : half.z;
  const double elevation = elevationFor(width, half.y, depth);
  const glm::dvec3 aside = facesX ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 toEye = aside * std::cos(elevation) + glm::dvec3(0, 1, 0) * std::sin(elevation);
  const glm::dvec3 forward = -toEye;
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
  const glm::dvec3 up = glm::cross(right, forward);

  // The nearest distance from which every corner of the box lies inside the picture.
  const double tanY = std::tan(0.5 * kYfov) / kMargin;
  double distance = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 sign((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
    const glm::dvec3 c = half * sign;
    const double needed =
        std::max(std::abs(glm::dot(c, up)) / tanY, std::abs(glm::dot(c, right)) / (tanY * kAspect));
    distance = std::max(distance, needed - glm::dot(c, forward));
  }
  Camera camera;
  camera.name = "default";
  camera.position = glm::vec3(centre + toEye * distance);
  camera.forward = glm::vec3(forward);
  camera.right = glm::vec3(right);
  camera.up = glm::vec3(up);
  camera.yfov = static_cast<float>(kYfov);
  return camera;
}

bool hasEmitters(const Scene& scene) {
  std::vector<bool> used(scene.materials.size());
  for (const Triangle& t : scene.triangles) used[t.material] = true;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Material& m = scene.materials[i];
    if (used[i] && (!isLit(m) || emits(m))) return true;
  }
  return false;
}

/// Some triangle would look different under a light.
bool hasLitSurfaces(const Scene& scene) {
  return std::any_of(scene.triangles.begin(), scene.triangles.end(),
                     [&](const Triangle& t) { return isLit(scene.materials[t.material]); });
}

Light directional(const char* name, const glm::vec3& direction, const glm::vec3& irradiance,
                  bool castsShadows) {
  Light light;
  light.name = name;
  light.kind = LightKind::Directional;
  light.intensity = irradiance;
  light.direction = glm::normalize(direction);
  light.castsShadows = castsShadows;
  return light;
}

}  // namespace

void addDefaults(Scene& scene, Notices& notices, const LoadOptions& options) {
  if (scene.cameras.empty()) {
    scene.cameras.push_back(framingCamera(scene));
    notices.note("no camera in the file: one was added that frames the scene");
  }
  const bool isBlack = scene.background.map.empty() && scene.background.radiance == glm::vec3(0.0F);
  if (!scene.lights.empty() || !isBlack) {
    if (options.defaultLights && !scene.lights.empty())
      notices.note("--default-lights adds nothing: the file has lights of its own");
    return;
  }
  if (!options.defaultLights && hasEmitters(scene)) {
    if (hasLitSurfaces(scene))
      notices.note(
          "no light in the file, only surfaces that glow, and those light nothing: --default-lights adds a "
          "sun");
    return;
  }
  const Camera& eye = scene.cameras.front();
  // The sun stands behind the camera, to the left and above; the fill light to the right, where the sun casts
  // shadows.
  const glm::vec3 fromSun = eye.forward * 0.7F + eye.right * 0.5F - eye.up * 0.8F;
  const glm::vec3 fromFill = eye.forward * 0.6F - eye.right * 0.8F - eye.up * 0.2F;
  scene.lights.push_back(directional("default sun", fromSun, glm::vec3(2.5F), true));
  scene.lights.push_back(directional("default fill", fromFill, glm::vec3(0.6F), false));
  if (!options.defaultBackground) {
    notices.note("no light in the file: a sun with shadows and a fill light without were added");
    return;
  }
  scene.background.radiance = glm::vec3(0.13F, 0.15F, 0.18F);
  notices.note(
      "no light in the file: a sun with shadows, a fill light without and a grey-blue background were added");
}

}  // namespace whittle
