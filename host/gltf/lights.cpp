// Reads cameras and lights. Cameras: glTF 2.0, 3.10; lights: KHR_lights_punctual. Both look along the
// node's -Z, and the node's scale changes neither.
#include "gltf/lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/ranges.h"

namespace whittle::gltf {

namespace {

bool isFinite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && glm::length(v) < 1e30;
}

/// Unit length; nothing for a zero or non-finite vector.
std::optional<glm::dvec3> unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  return v / length;
}

/// Position and axes of a camera node: scale and shear are left out, right-handed even below a mirror.
bool placeCamera(const glm::dmat4& toWorld, Camera& camera) {
  const auto forward = unit(-glm::dvec3(toWorld[2]));
  if (!forward || !isFinite(toWorld[3])) return false;
  const glm::dvec3 y(toWorld[1]);
  const auto up = unit(y - *forward * glm::dot(y, *forward));
  if (!up) return false;
  camera.position = glm::vec3(glm::dvec3(toWorld[3]));
  camera.forward = glm::vec3(*forward);
  camera.up = glm::vec3(*up);
  camera.right = glm::vec3(glm::cross(*forward, *up));
  return true;
}

/// What a file does not say is 0, and so is what makes no sense: then there is no frame and no plane.
void setFrame(double aspect, double znear, double zfar, Camera& camera) {
  constexpr double kMostAspect = 1e3;
  if (aspect > 1 / kMostAspect && aspect < kMostAspect) camera.aspect = static_cast<float>(aspect);
  if (znear > 0.0 && znear < 1e30) camera.znear = static_cast<float>(znear);
  if (zfar > znear && zfar < 1e30) camera.zfar = static_cast<float>(zfar);
}

/// False if the lens cannot be used.
bool readLens(const Json& json, Camera& camera) {
  camera.orthographic = json["type"] == "orthographic";
  const Json& lens = child(json, camera.orthographic ? "orthographic" : "perspective");
  const double znear = number(lens, "znear", 0.0), zfar = number(lens, "zfar", 0.0);
  if (camera.orthographic) {
    camera.ymag = static_cast<float>(std::abs(number(lens, "ymag", 0.0)));
    setFrame(std::abs(number(lens, "xmag", 0.0)) / static_cast<double>(camera.ymag), znear, zfar, camera);
    return camera.ymag > 0.0F && std::isfinite(camera.ymag);
  }
  setFrame(number(lens, "aspectRatio", 0.0), znear, zfar, camera);
  const double yfov = number(lens, "yfov", 0.0);
  camera.yfov = static_cast<float>(yfov);
  return camera.yfov > 0.0F && yfov < std::numbers::pi;
}

void readCone(const Json& light, const std::string& label, Light& out, Notices& notices) {
  const Json& spot = child(light, "spot");
  const double outer = number(spot, "outerConeAngle", std::numbers::pi / 4);
  const double inner = number(spot, "innerConeAngle", 0.0);
  out.outerConeAngle = static_cast<float>(std::clamp(outer, 0.0, std::numbers::pi / 2));
  out.innerConeAngle = static_cast<float>(std::clamp(inner, 0.0, static_cast<double>(out.outerConeAngle)));
  if (!coneFits(inner, outer)) notices.warn(fmt::format("{}: {}; brought inside", label, kConeFlaw));
}

std::optional<LightKind> kindOf(const std::string& type) {
  for (const LightType& t : kLightTypes)
    if (type == t.word && !standsForOthers(t.kind)) return t.kind;
  return std::nullopt;
}

/// Everything of a light but its place; nothing if it cannot be used.
std::optional<Light> readLight(const Json& json, std::size_t index, Notices& notices) {
  Light light;
  light.name = json.value("name", "");
  const std::string label = fmt::format("light {}{}", index, quotedName(light.name));
  const auto type = json["type"].get<std::string>();
  const auto kind = kindOf(type);
  if (!kind) {
    notices.warn(fmt::format("{}: unknown type{}; the light is left out", label, quotedName(type)));
    return std::nullopt;
  }
  light.kind = *kind;
  const double intensity = number(json, "intensity", 1.0);
  const Json& color = child(json, "color");
  for (int i = 0; i < 3; ++i) {
    light.intensity[i] =
        static_cast<float>(intensity * (color.size() == 3 ? color[at(i)].get<double>() : 1.0));
  }
  if (const std::string flaw = intensityFlaw(light.intensity); !flaw.empty()) {
    notices.warn(fmt::format("{}: {}; the light is left out", label, flaw));
    return std::nullopt;
  }
  if (json.contains("range")) {
    const auto range = static_cast<float>(number(json, "range", 0.0));
    if (range > 0.0F)
      light.range = range;
    else
      notices.warn(fmt::format("{}: its range must be positive; it reaches everywhere", label));
  }
  if (typeOf(light.kind).hasCone) readCone(json, label, light, notices);
  light.castsShadows = leavesShadows(child(json, "extras"));
  return light;
}

}  // namespace

void readCameras(const Document& document, const Hierarchy& hierarchy, Scene& scene, Notices& notices) {
  std::vector<std::pair<int, Camera>> found;
  for (const int node : hierarchy.cameras) {
    const int index = document.nodes[at(node)].camera;
    Camera camera;
    const Json& json = document.json["cameras"][at(index)];
    if (!readLens(json, camera) || !placeCamera(hierarchy.toWorld[at(node)], camera)) {
      notices.warn(
          fmt::format("camera {} at {} has a lens or a transform that cannot be used; it is left out", index,
                      nodeLabel(document, node)));
      continue;
    }
    camera.node = document.nodes[at(node)].name;
    camera.name = json.value("name", "");
    if (camera.name.empty()) camera.name = camera.node;
    found.emplace_back(index, std::move(camera));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [index, camera] : found) scene.cameras.push_back(std::move(camera));
}

void readLights(const Document& document, const Hierarchy& hierarchy, Scene& scene, Notices& notices) {
  const Json* lights = extension(document.json, "KHR_lights_punctual");
  if (!lights) return;
  for (const int node : hierarchy.shown) {
    if (document.nodes[at(node)].light < 0) continue;
    const auto index = static_cast<std::size_t>(document.nodes[at(node)].light);
    auto light = readLight((*lights)["lights"][index], index, notices);
    if (!light) continue;
    const glm::dmat4& toWorld = hierarchy.toWorld[at(node)];
    const auto direction = unit(-glm::dvec3(toWorld[2]));
    if (!isFinite(toWorld[3]) || (!direction && typeOf(light->kind).isAimed)) {
      notices.warn(fmt::format("the light at {} has a transform that cannot be used; it is left out",
                               nodeLabel(document, node)));
      continue;
    }
    light->position = glm::vec3(glm::dvec3(toWorld[3]));
    if (direction) light->direction = glm::vec3(*direction);
    light->castsShadows = light->castsShadows && document.nodes[at(node)].castsShadows();
    if (light->name.empty()) light->name = document.nodes[at(node)].name;
    light->node = node;
    scene.lights.push_back(std::move(*light));
  }
}

}  // namespace whittle::gltf
