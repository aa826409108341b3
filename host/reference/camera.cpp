// Eye rays of perspective and orthographic cameras.
#include "reference/camera.h"

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

}  // namespace whittle::reference
