// See camera_to_device.h.
#include "wavefront/camera_to_device.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "scene/input_error.h"

namespace whittle {
namespace {

/// A vector as the sum of two float vectors. volatile: GCC 12 at -O3 otherwise takes the three differences
/// for 0 (its vectoriser drops the rounding to float and back; gone with -fno-tree-slp-vectorize).
void split3(float* high, float* low, const glm::dvec3& v) {
  for (int i = 0; i < 3; ++i) {
    const volatile float rounded = static_cast<float>(v[i]);
    high[i] = rounded;
    low[i] = static_cast<float>(v[i] - static_cast<double>(rounded));
  }
}

}  // namespace

device::DeviceCamera cameraToDevice(const Camera& camera, const Settings& s) {
  device::DeviceCamera d{};
  for (int i = 0; i < 3; ++i) d.position[i] = camera.position[i];
  for (int i = 0; i < 3; ++i) d.forward[i] = camera.forward[i];
  const double half = camera.orthographic ? camera.ymag : std::tan(0.5 * static_cast<double>(camera.yfov));
  const double step = half / s.height;  // pixels are square
  split3(d.stepX, d.stepXLow, step * glm::dvec3(camera.right));
  split3(d.stepY, d.stepYLow, -step * glm::dvec3(camera.up));
  d.orthographic = camera.orthographic;
  d.seed = s.seed;
  d.width = static_cast<std::uint32_t>(s.width);
  d.height = static_cast<std::uint32_t>(s.height);
  d.raysPerPixel = static_cast<std::uint32_t>(s.raysPerPixel);
  d.sampler = static_cast<std::uint32_t>(s.sampler);
  return d;
}

std::size_t findCamera(const Scene& scene, const std::string& selector) {
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    if (scene.cameras[i].name == selector) return i;
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(selector.data(), selector.data() + selector.size(), index);
  if (error == std::errc{} && end == selector.data() + selector.size() && index < scene.cameras.size())
    return index;
  std::string names;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    names += fmt::format("{}{} '{}'", i ? ", " : "", i, scene.cameras[i].name);
  throw InputError(fmt::format("--camera: {} has no camera '{}'; it has {}", scene.file, selector, names));
}

}  // namespace whittle
