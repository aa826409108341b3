// Scenes built by hand for the device: cameras that send one ray, or a row of parallel ones, and
// what comes back.
#pragma once

#include "support/pictures.h"
#include "support/probe.h"

namespace whittle::test {

/// A vector beside `forward` that makes a right-handed camera.
inline void aim(Camera& camera, const glm::dvec3& forward) {
  const glm::dvec3 f = glm::normalize(forward);
  const glm::dvec3 side = std::abs(f.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
  const glm::dvec3 right = glm::normalize(glm::cross(f, side));
  camera.forward = f;
  camera.right = right;
  camera.up = glm::cross(right, f);
}

/// Absorbs the share `alpha` and gives off nothing.
inline Material veil(float alpha) {
  Material m = lambert(glm::vec3(0));
  m.unlit = true;
  m.alphaMode = AlphaMode::Blend;
  m.baseColor.a = alpha;
  m.doubleSided = true;
  return m;
}

/// A picture of one pixel whose only ray starts at `origin` along `direction`.
inline RenderResult shoot(Scene scene, const glm::dvec3& origin, const glm::dvec3& direction, int bounces) {
  Camera camera;
  camera.position = origin;
  aim(camera, direction);
  scene.cameras = {camera};
  Settings settings;
  settings.width = settings.height = 1;
  settings.bounces = bounces;
  return renderOnDevice(scene, settings);
}

inline glm::vec3 colorOf(const RenderResult& result, std::size_t pixel = 0) {
  const auto& p = result.radiance.pixels;
  return {p[3 * pixel], p[3 * pixel + 1], p[3 * pixel + 2]};
}

inline glm::vec3 shot(const Scene& scene, const glm::dvec3& origin, const glm::dvec3& direction,
                      int bounces) {
  return colorOf(shoot(scene, origin, direction, bounces));
}

/// `count` parallel rays straight down from (x, height, 0), x evenly from 0 to `reach`.
inline RenderResult shootRowDown(Scene scene, double height, double reach, int count, int bounces) {
  Camera camera;
  camera.orthographic = true;
  camera.forward = {0, -1, 0};
  camera.right = {1, 0, 0};
  camera.up = {0, 0, -1};
  // Pixel i of the row looks at (2 (i + ½)/count − 1) · count · ymag from the middle.
  const double step = reach / (count - 1);
  camera.ymag = static_cast<float>(step / 2);
  camera.position = {static_cast<float>(reach / 2), static_cast<float>(height), 0};
  scene.cameras = {camera};
  Settings settings;
  settings.width = count;
  settings.height = 1;
  settings.bounces = bounces;
  return renderOnDevice(scene, settings);
}

/// From that height, whatever the sample's place in the pixel and the pixel's in the picture.
inline Camera lookingAtOrigin(float height = 1) {
  Camera camera = lookingDown();
  camera.position = {0, height, 0};
  camera.ymag = 1e-6F;
  return camera;
}

/// The root of the mean squared error of the first channel over 24×24 pixels that should all be `expected`.
inline double errorOverPixels(const Scene& scene, Settings settings, int samples, double expected) {
  settings.width = settings.height = 24;
  settings.bounces = 1;
  settings.raysPerPixel = samples;
  const RenderResult result = renderOnDevice(scene, settings);
  double squares = 0;
  for (std::size_t i = 0; i < 576; ++i)
    squares += std::pow(static_cast<double>(colorOf(result, i).x) - expected, 2) / 576;
  return std::sqrt(squares);
}

/// W/m² at the origin on a floor that looks up: Lambert's part of `samples` rays into it from above.
inline double irradianceAtOrigin(Scene scene, Settings settings, int samples) {
  addFloor(scene, lambert(glm::vec3(1)), 0);
  scene.cameras = {lookingAtOrigin()};
  settings.width = settings.height = 1;
  settings.bounces = 1;
  settings.raysPerPixel = samples;
  return static_cast<double>(colorOf(renderOnDevice(scene, settings)).x) * reference::kPi;
}

}  // namespace whittle::test
