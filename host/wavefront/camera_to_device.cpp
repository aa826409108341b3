// See camera_to_device.h.
#include "wavefront/camera_to_device.h"

#include "scene/camera.h"

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
  const double step =
      halfHeight(camera, static_cast<double>(s.width) / s.height) / s.height;  // square pixels
  split3(d.stepX, d.stepXLow, step * glm::dvec3(camera.right));
  split3(d.stepY, d.stepYLow, -step * glm::dvec3(camera.up));
  d.orthographic = camera.orthographic;
  d.seed = s.seed;
  d.width = static_cast<std::uint32_t>(s.width);
  d.height = static_cast<std::uint32_t>(s.height);
  d.raysPerPixel = static_cast<std::uint32_t>(s.raysPerPixel);
  d.sampler = static_cast<std::uint32_t>(s.sampler);
  d.znear = camera.znear;
  for (int i = 0; i < 3; ++i) d.right[i] = camera.right[i], d.up[i] = camera.up[i];
  d.lensRadius = s.aperture / 2;
  d.focusDistance = s.focusDistance.value_or(1.0F);
  return d;
}

}  // namespace whittle
