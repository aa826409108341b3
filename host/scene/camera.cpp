// See camera.h.
#include "scene/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "scene/input_error.h"

namespace whittle {
namespace {

constexpr double kYfov = 0.7;
constexpr double kMargin = 1.1;  // of the half picture, between the scene's box and its edge

/// Towards the eye from what it looks at, unit.
glm::dvec3 towardsEye(double azimuth, double elevation) {
  return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
          std::cos(azimuth) * std::cos(elevation)};
}

/// How steeply to look down on a box whose visible side is `width` by `height` and which is `depth`
/// deep, in radians.
double elevationFor(double width, double height, double depth) {
  constexpr double kFlat = 1e-3;
  if (depth <= kFlat * std::max(width, height)) return 0.0;  // a picture: front on
  if (height <= kFlat * std::max(width, depth)) return 1.2;  // a floor
  if (height < 0.2 * std::min(width, depth)) return 0.6;     // a landscape
  return 0.3;
}

void place(Camera& camera, const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& up) {
  const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
  camera.position = glm::vec3(eye);
  camera.forward = glm::vec3(forward);
  camera.right = glm::vec3(right);
  camera.up = glm::vec3(glm::cross(right, forward));
}

/// The least distance from the middle of the box along `toEye` from which every corner is in the picture.
double framingDistance(const Bounds& box, const Camera& camera, double yfov, double aspect) {
  const glm::dvec3 half = 0.5 * (box.hi - box.lo);
  const glm::dvec3 forward(camera.forward), right(camera.right), up(camera.up);
  const double tanY = std::tan(0.5 * yfov) / kMargin;
  double distance = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 sign((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
    const glm::dvec3 c = half * sign;
    const double needed =
        std::max(std::abs(glm::dot(c, up)) / tanY, std::abs(glm::dot(c, right)) / (tanY * aspect));
    distance = std::max(distance, needed - glm::dot(c, forward));
  }
  return distance;
}

/// Looks at the middle of the scene from an angle, `distance` away or so far that all is seen.
Camera orbiting(const Scene& scene, double azimuth, double elevation, std::optional<double> distance,
                double yfov, const glm::dvec3& up, double aspect) {
  const Bounds box = boundsOf(scene);
  const glm::dvec3 centre = 0.5 * (box.lo + box.hi), toEye = towardsEye(azimuth, elevation);
  Camera camera;
  camera.yfov = static_cast<float>(yfov);
  place(camera, centre, -toEye, up);
  camera.position = glm::vec3(centre + toEye * distance.value_or(framingDistance(box, camera, yfov, aspect)));
  return camera;
}

}  // namespace

double halfHeight(const Camera& camera, double aspect) {
  const double half = camera.orthographic ? static_cast<double>(camera.ymag)
                                          : std::tan(0.5 * static_cast<double>(camera.yfov));
  const double wider = static_cast<double>(camera.aspect) / aspect;
  constexpr double kRounding = 1 + 1e-6;  // of an aspect in single precision
  return wider > kRounding ? half * wider : half;
}

namespace {

/// The point of a triangle that is nearest to the origin (Ericson, Real-Time Collision Detection, 5.1.5).
glm::dvec3 nearestPoint(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a;
  const double d1 = -glm::dot(ab, a), d2 = -glm::dot(ac, a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = -glm::dot(ab, b), d4 = -glm::dot(ac, b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double d5 = -glm::dot(ab, c), d6 = -glm::dot(ac, c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = va + vb + vc;
  return sum > 0 ? a + ab * (vb / sum) + ac * (vc / sum) : a;
}

}  // namespace

bool nearPlaneCuts(const Scene& scene, const Camera& camera, double aspect) {
  if (!(camera.znear > 0.0F)) return false;
  const double znear = static_cast<double>(camera.znear) * (1 + 1e-6), half = halfHeight(camera, aspect);
  const double farthest = znear * std::sqrt(1 + half * half * (1 + aspect * aspect));  // in a corner
  const glm::dvec3 eye(camera.position), forward(camera.forward);
  return std::any_of(scene.triangles.begin(), scene.triangles.end(), [&](const Triangle& t) {
    const glm::dvec3 a = glm::dvec3(scene.positions[t.v0]) - eye, b = glm::dvec3(scene.positions[t.v1]) - eye,
                     c = glm::dvec3(scene.positions[t.v2]) - eye;
    const double za = glm::dot(a, forward), zb = glm::dot(b, forward), zc = glm::dot(c, forward);
    if (std::min({za, zb, zc}) >= znear || std::max({za, zb, zc}) <= 0) return false;
    return camera.orthographic || glm::length(nearestPoint(a, b, c)) <= farthest;
  });
}

bool liesBeyondFarPlane(const Scene& scene, const Camera& camera) {
  const double zfar = camera.zfar;
  if (!std::isfinite(zfar)) return false;
  const glm::dvec3 eye(camera.position), forward(camera.forward);
  return std::any_of(scene.triangles.begin(), scene.triangles.end(), [&](const Triangle& t) {
    for (const std::uint32_t v : {t.v0, t.v1, t.v2})
      if (glm::dot(glm::dvec3(scene.positions[v]) - eye, forward) > zfar) return true;
    return false;
  });
}

std::size_t findCamera(const Scene& scene, const std::string& selector) {
  const auto& cameras = scene.cameras;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    if (cameras[i].name == selector) return i;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    if (!selector.empty() && cameras[i].node == selector) return i;
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(selector.data(), selector.data() + selector.size(), index);
  if (error == std::errc{} && end == selector.data() + selector.size() && index < cameras.size())
    return index;
  std::string names;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    names += fmt::format("{}{} '{}'", i ? ", " : "", i, cameras[i].name);
    if (!cameras[i].node.empty() && cameras[i].node != cameras[i].name)
      names += fmt::format(" at '{}'", cameras[i].node);
  }
  throw InputError(fmt::format("--camera: {} has no camera '{}'; it has {}", scene.file, selector, names));
}

Bounds boundsOf(const Scene& scene) {
  if (scene.triangles.empty()) return {};
  const double inf = std::numeric_limits<double>::infinity();
  Bounds box{glm::dvec3(inf), glm::dvec3(-inf)};
  for (const Triangle& t : scene.triangles) {
    for (const std::uint32_t v : {t.v0, t.v1, t.v2}) {
      box.lo = glm::min(box.lo, glm::dvec3(scene.positions[v]));
      box.hi = glm::max(box.hi, glm::dvec3(scene.positions[v]));
    }
  }
  return box;
}

Camera framingCamera(const Scene& scene, double aspect) {
  // glTF's front is +Z; a long thing is shown by its side.
  constexpr double kLong = 1.5, kFromTheRight = 0.45;
  const Bounds box = boundsOf(scene);
  const glm::dvec3 size = box.hi - box.lo;
  const bool facesX = size.z > kLong * size.x;
  const double width = facesX ? size.z : size.x, depth = facesX ? size.x : size.z;
  const double elevation = elevationFor(width, size.y, depth);
  const double aside = elevation > 0.0 ? kFromTheRight : 0.0;
  const double azimuth = facesX ? 0.5 * std::numbers::pi - aside : aside;
  Camera camera = orbiting(scene, azimuth, elevation, std::nullopt, kYfov, glm::dvec3(0, 1, 0), aspect);
  camera.name = "default";
  return camera;
}

namespace {

void setLens(const Viewpoint& from, double yfov, Camera& camera) {
  camera.yfov = static_cast<float>(yfov);
  if (!from.orthoHeight) return;
  camera.orthographic = true;
  camera.ymag = static_cast<float>(0.5 * *from.orthoHeight);
}

}  // namespace

Camera cameraAt(const Scene& scene, const Viewpoint& from, double aspect) {
  const double yfov = from.yfov.value_or(kYfov);
  Camera camera;
  if (from.orbit) {
    constexpr double kRadians = std::numbers::pi / 180.0;
    const double azimuth = from.orbit->x * kRadians, elevation = from.orbit->y * kRadians;
    // Straight from above or below, up is where the azimuth comes from.
    const bool steep = std::abs(std::cos(elevation)) < 1e-6;
    const glm::dvec3 up = steep ? towardsEye(azimuth, 0.0) * (elevation > 0.0 ? -1.0 : 1.0) : from.up;
    camera = orbiting(scene, azimuth, elevation, from.distance, yfov, up, aspect);
    camera.name = "orbit";
    setLens(from, yfov, camera);
    return camera;
  }
  const Bounds box = boundsOf(scene);
  const glm::dvec3 eye = from.eye.value() - scene.origin;
  const glm::dvec3 target = from.lookAt ? *from.lookAt - scene.origin : 0.5 * (box.lo + box.hi);
  const glm::dvec3 way = target - eye;
  if (!(glm::length(way) > 0.0)) throw InputError("--look-at: is where the eye is");
  const glm::dvec3 forward = glm::normalize(way);
  if (!(glm::length(glm::cross(forward, from.up)) > 1e-9 * glm::length(from.up)))
    throw InputError("--up: runs along the view; give another, for instance 0,0,-1");
  camera.name = "eye";
  setLens(from, yfov, camera);
  place(camera, eye, forward, from.up);
  return camera;
}

}  // namespace whittle
