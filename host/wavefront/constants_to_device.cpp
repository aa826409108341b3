// See constants_to_device.h.
#include "wavefront/constants_to_device.h"

#include <cmath>

#include "kernels/shared/features.h"
#include "scene/camera.h"
#include "scene/light_size.h"
#include "scene/sky_light.h"

namespace whittle {
namespace {

/// Within the map's width, so that one step around the end is enough; exactly a half where it is not turned.
float backgroundAhead(const Background& background) {
  return static_cast<float>(0.5 + std::remainder(background.rotation, 360.0) / 360.0);
}

struct EyeCone {
  float width = 0.0F, spread = 0.0F;
};

/// As wide as a pixel. Nothing without a filter, so that a kernel that is told to have one reads textures as
/// they are.
EyeCone eyeCone(const Camera& camera, const Settings& s) {
  if (s.textureFilter == TextureFilter::None) return {};
  const auto pixel =
      static_cast<float>(2 * halfHeight(camera, static_cast<double>(s.width) / s.height) / s.height);
  return camera.orthographic ? EyeCone{pixel, 0.0F} : EyeCone{0.0F, pixel};
}

}  // namespace

device::RenderConstants constantsToDevice(const Scene& scene, const Camera& camera, const Settings& s) {
  const glm::vec3& b = scene.background.radiance;
  const EyeCone cone = eyeCone(camera, s);
  return {.background = {b.x, b.y, b.z},
          .rayOffset = s.rayOffset.value_or(-1.0F),
          .backgroundWidth = scene.background.width,
          .backgroundHeight = scene.background.height,
          .mirrorRoughness = s.mirrorRoughness,
          .seed = s.seed,
          .cutoff = s.cutoff,
          .forward = {camera.forward.x, camera.forward.y, camera.forward.z},
          .zfar = camera.zfar,
          .transparentBounces = static_cast<std::uint32_t>(s.transparentBounces),
          .ambient = ambientOf(scene, s),
          .backgroundAhead = backgroundAhead(scene.background),
          .backgroundClear = s.alpha ? 1U : 0U,
          .lightRadius = s.lightRadius,
          .sunVersine = static_cast<float>(sunVersine(s)),
          .sampler = static_cast<std::uint32_t>(s.sampler),
          .raysPerPixel = static_cast<std::uint32_t>(s.raysPerPixel),
          .glossy = s.glossy ? 1U : 0U,
          .coneWidth = cone.width,
          .coneSpread = cone.spread,
          .textureProbes = s.textureFilter == TextureFilter::Anisotropic ? TEXTURE_PROBES : 1U};
}

}  // namespace whittle
