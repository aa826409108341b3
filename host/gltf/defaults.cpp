// addDefaults of loader.h: a camera and lights for files that have none. Reads and writes
// the scene only.
#include <fmt/format.h>

#include <algorithm>

#include "gltf/loader.h"
#include "gltf/studio.h"
#include "scene/camera.h"
#include "scene/material_predicates.h"
#include "scene/sky_model.h"

namespace whittle {

namespace {

/// Some triangle answers to light and, at least in places, gives off none: without a light it would be black
/// there. Beside what glows, what has no colour does not count: a light would add highlights at most.
bool somethingIsDark(const Scene& scene) {
  const auto any = [&](const auto& asked) {
    return std::any_of(scene.triangles.begin(), scene.triangles.end(),
                       [&](const Triangle& t) { return asked(scene.materials[t.material]); });
  };
  const bool glows = any(emits);
  return any([&](const Material& m) {
    const bool hasColor = glm::vec3(m.baseColor) != glm::vec3(0.0F);
    return isLit(m) && (!emits(m) || m.emissionTexture.used()) && (hasColor || !glows);
  });
}

}  // namespace

void addDefaults(Scene& scene, Notices& notices, const LoadOptions& options) {
  const double aspect = options.aspect > 0.0 ? options.aspect : kUsualAspect;
  scene.hasOurCamera = options.viewpoint || scene.cameras.empty();
  if (options.viewpoint) {
    scene.cameras = {cameraAt(scene, *options.viewpoint, aspect)};
  } else if (scene.cameras.empty()) {
    scene.cameras.push_back(framingCamera(scene, aspect));
    notices.note("no camera in the file: one was added that frames the scene");
  }
  if (!scene.lights.empty() && std::all_of(scene.lights.begin(), scene.lights.end(),
                                           [](const Light& l) { return l.intensity == glm::vec3(0.0F); }))
    notices.warn(
        fmt::format("all {} lights of the file have intensity 0: they light nothing", scene.lights.size()));
  if (scene.sky) {
    addSky(scene, *scene.sky);
    if (options.defaultLights.value_or(false))
      notices.note("--default-lights adds nothing: the sky has a sun");
    return;
  }
  const bool isBlack = scene.background.map.empty() && scene.background.radiance == glm::vec3(0.0F);
  if (!scene.lights.empty() || !isBlack) {
    if (options.defaultLights.value_or(false) && !scene.lights.empty())
      notices.note("--default-lights adds nothing: the file has lights of its own");
    return;
  }
  const bool isWanted = somethingIsDark(scene) || scene.triangles.empty();
  const bool lights = options.defaultLights.value_or(isWanted);
  const bool background = options.defaultBackground && (isWanted || lights);
  if (!lights && !background) return;
  const Camera& eye = scene.cameras[findCamera(scene, options.camera)];
  scene.hasStudioLights = lights;
  if (lights) scene.lights = studioLights(eye);
  if (background) scene.background = studioBackground(eye);
  notices.note(fmt::format("no light in the file: a small studio was added, {}{}{} ({} it out)",
                           lights ? "three lights" : "", lights && background ? " and " : "",
                           background ? "surroundings to mirror" : "",
                           lights && background ? "--no-default-lights and --no-default-background leave"
                           : lights             ? "--no-default-lights leaves"
                                                : "--no-default-background leaves"));
}

}  // namespace whittle
