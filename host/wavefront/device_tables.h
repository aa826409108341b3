// Lights, materials and texture slots as the device has them. They are small, so an edit makes them anew and
// uploads those that changed. Layouts: kernels/shared/layout.h.
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "analysis/pruned_scene.h"
#include "cl/program.h"
#include "kernels/shared/layout.h"
#include "scene/emitters.h"
#include "scene/scene.h"
#include "wavefront/texture_levels.h"

namespace whittle {

/// What a triangle says of its material.
struct SurfaceKind {
  std::uint32_t material = 0;  ///< of DeviceTables::materials
  std::uint32_t flags = 0;     ///< TRIANGLE_…
  bool operator==(const SurfaceKind&) const = default;
};

/// Where the texels of an image begin.
struct TexelRange {
  std::uint32_t image = 0;             ///< of Scene::images
  bool isDeep = false;                 ///< its 16-bit texels
  std::uint32_t first = 0;             ///< word
  Averaging levels = Averaging::None;  ///< how the smaller levels behind them are made
  bool operator==(const TexelRange&) const = default;
};

struct DeviceTables {
  std::vector<Emitter> emitters;                  ///< of a surface light, where there is one
  std::vector<device::DeviceLight> lights;        ///< those that reach something, in the scene's order
  std::vector<device::DeviceMaterial> materials;  ///< one at least
  std::vector<device::DeviceTexture> textures;    ///< the slots of materials
  std::vector<TexelRange> texels;                 ///< image after image
  std::vector<SurfaceKind> surfaces;              ///< by index into Scene::materials
};

DeviceTables tablesOf(const Scene& scene, const PrunedScene& pruned);

inline void copy3(float* out, const glm::vec3& v) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }

/// Of plain structs without padding.
template <typename T>
bool haveSameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// The texels of all images as words, the first channel lowest; they go from the images to the device without
/// another copy in between. `consumed`: see uploadScene.
Buffer uploadTexels(Compute& compute, const Scene& scene, const std::vector<TexelRange>& ranges,
                    Scene* consumed);

}  // namespace whittle
