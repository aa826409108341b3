// Eye rays of perspective and orthographic cameras.
#include "reference/camera.h"

#include <fmt/format.h>

#include <charconv>

#include "scene/input_error.h"

namespace whittle::reference {

const Camera& findCamera(const Scene& scene, const std::string& nameOrIndex) {
  for (const Camera& camera : scene.cameras) {
    if (camera.name == nameOrIndex) return camera;
  }
  std::size_t index = 0;
  const char* end = nameOrIndex.data() + nameOrIndex.size();
  const auto [parsed, error] = std::from_chars(nameOrIndex.data(), end, index);
  if (error == std::errc() && parsed == end && index < scene.cameras.size()) return scene.cameras[index];

  std::string cameras;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    cameras += fmt::format("{}{} \"{}\"", i > 0 ? ", " : "", i, scene.cameras[i].name);
  }
  throw InputError(fmt::format("{}: no camera \"{}\"; there are: {}", scene.file, nameOrIndex,
                               cameras.empty() ? "none" : cameras));
}

Ray eyeRay(const Camera& camera, const Vec2& position, int width, int height) {
  const double aspect = static_cast<double>(width) / height;
  const double X = (2 * position.x / width - 1) * aspect;
  const double Y = 1 - 2 * position.y / height;
  const Vec3 right(camera.right), up(camera.up), forward(camera.forward), origin(camera.position);
  if (camera.orthographic) {
    const double ymag = camera.ymag;
    return {origin + ymag * (X * right + Y * up), glm::normalize(forward)};
  }
  const double t = std::tan(0.5 * static_cast<double>(camera.yfov));
  return {origin, glm::normalize(X * t * right + Y * t * up + forward)};
}

}  // namespace whittle::reference
