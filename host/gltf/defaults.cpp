// addDefaults of loader.h: a camera and lights for files that have none. Reads and writes the scene
// only.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gltf/loader.h"
#include "scene/camera.h"
#include "scene/material_predicates.h"

namespace whittle {

namespace {

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
  const double aspect = options.aspect > 0.0 ? options.aspect : kUsualAspect;
  if (options.viewpoint) {
    scene.cameras = {cameraAt(scene, *options.viewpoint, aspect)};
  } else if (scene.cameras.empty()) {
    scene.cameras.push_back(framingCamera(scene, aspect));
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
  const Camera& eye = scene.cameras[findCamera(scene, options.camera)];
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
