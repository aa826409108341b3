// Eye rays of perspective and orthographic cameras.
#include "reference/camera.h"

#include <numbers>

#include "scene/camera.h"

namespace whittle::reference {

Ray eyeRay(const Camera& camera, const Vec2& position, int width, int height) {
  const double aspect = static_cast<double>(width) / height;
  const double X = (2 * position.x / width - 1) * aspect;
  const double Y = 1 - 2 * position.y / height;
  const double t = halfHeight(camera, aspect);
  const Vec3 right(camera.right), up(camera.up), forward(camera.forward), origin(camera.position);
  if (camera.orthographic) {
    return {origin + t * (X * right + Y * up), glm::normalize(forward)};
  }
  return {origin, glm::normalize(X * t * right + Y * t * up + forward)};
}

Ray throughLens(const Camera& camera, const Ray& pinhole, double aperture, double distance, const Vec2& u) {
  const double radius = aperture / 2 * std::sqrt(u.x), angle = 2 * std::numbers::pi * u.y;
  const Vec3 lens = radius * (std::cos(angle) * Vec3(camera.right) + std::sin(angle) * Vec3(camera.up));
  const Vec3 ahead = pinhole.direction / glm::dot(pinhole.direction, Vec3(camera.forward));
  return {pinhole.origin + lens, glm::normalize(distance * ahead - lens)};
}

}  // namespace whittle::reference
