// See studio.h.
#include "gltf/studio.h"

#include <array>
#include <cmath>
#include "scene/background_map.h"

namespace whittle {
namespace {

/// The studio stands upright, its front where the camera looks.
struct CameraFrame {
  glm::dvec3 forward, right, up{0, 1, 0};
};

CameraFrame frameOf(const Camera& camera) {
  glm::dvec3 forward(camera.forward.x, 0, camera.forward.z);
  if (!(glm::length(forward) > 1e-3)) forward = {camera.up.x, 0, camera.up.z};  // from above or below
  if (!(glm::length(forward) > 1e-3)) forward = {0, 0, -1};
  CameraFrame frame;
  frame.forward = glm::normalize(forward);
  frame.right = glm::cross(frame.forward, frame.up);
  return frame;
}

struct Lamp {
  const char* name;
  glm::dvec3 place;  ///< towards it: along right, up and forward
  float irradiance;  ///< W/m²
  bool castsShadows;
  double radiance;  ///< of its soft box, W/(m² sr)
  double width;     ///< radians, where that has fallen to 1/e
};
constexpr std::array kLamps{
    Lamp{"studio key", {-0.5, 0.8, -0.7}, 2.5F, true, 5.0, 0.35},
    Lamp{"studio fill", {0.8, 0.2, -0.6}, 0.6F, false, 1.2, 0.5},
    Lamp{"studio rim", {0.3, 1.0, 0.7}, 1.0F, false, 2.5, 0.3},  // above what a level camera sees
};

glm::dvec3 towards(const CameraFrame& frame, const Lamp& lamp) {
  return glm::normalize(lamp.place.x * frame.right + lamp.place.y * frame.up + lamp.place.z * frame.forward);
}

glm::dvec3 radianceFrom(const CameraFrame& frame, const glm::dvec3& d) {
  const glm::dvec3 horizon(0.075, 0.08, 0.087), zenith(0.32, 0.34, 0.36), nadir(0.03, 0.03, 0.03);
  const double height = std::abs(d.y);
  glm::dvec3 radiance = glm::mix(horizon, d.y > 0 ? zenith : nadir, height);
  for (const Lamp& lamp : kLamps) {
    const double angle = std::acos(glm::clamp(glm::dot(d, towards(frame, lamp)), -1.0, 1.0));
    radiance += lamp.radiance * std::exp(-(angle / lamp.width) * (angle / lamp.width));
  }
  return radiance;
}

}  // namespace

std::vector<Light> studioLights(const Camera& camera) {
  const CameraFrame frame = frameOf(camera);
  std::vector<Light> lights;
  for (const Lamp& lamp : kLamps) {
    Light light;
    light.name = lamp.name;
    light.kind = LightKind::Directional;
    light.intensity = glm::vec3(lamp.irradiance);
    light.direction = glm::vec3(-towards(frame, lamp));
    light.castsShadows = lamp.castsShadows;
    lights.push_back(light);
  }
  return lights;
}

Background studioBackground(const Camera& camera) {
  constexpr int kWidth = 128, kHeight = 64;
  const CameraFrame frame = frameOf(camera);
  return mapOf(kWidth, kHeight, [&](const glm::dvec3& d) { return radianceFrom(frame, d); });
}

}  // namespace whittle
