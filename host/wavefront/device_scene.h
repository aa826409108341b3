// The scene on the device: only the buffers its features need. A buffer that is left out is a
// null pointer there.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "analysis/scene_features.h"
#include "bvh/bvh8.h"
#include "cl/program.h"
#include "kernels/shared/layout.h"
#include "report/stats.h"
#include "scene/scene.h"
#include "wavefront/arguments_macro.h"
#include "wavefront/device_tables.h"

namespace whittle {

struct DeviceScene {
  Buffer nodes, triangles, corners, indices32, normals, tangents, uv0, uv1, colors, materials, textures,
      texels, linearFromSrgb, lights, emitters, backgroundMap, sky, bvh8Nodes, leaves;
  std::uint32_t triangleCount = 0;  ///< not counting the degenerate sentinel at the end
  DeviceTables tables;  ///< what the buffers of the same names hold, `triangles` and `texels` the rest

  /// SCENE_PARAMS of kernels/lib/scene.cl.
  WHITTLE_ARGUMENTS(nodes, triangles, corners, indices32, normals, tangents, uv0, uv1, colors, materials,
                    textures, texels, linearFromSrgb, lights, emitters, backgroundMap, sky, bvh8Nodes, leaves,
                    triangleCount)

  std::vector<const Buffer*> buffers() const;
  void report(std::vector<BufferStats>& out) const;
};

/// The features that decide what is uploaded.
inline constexpr std::uint64_t kSceneBufferFeatures =
    bitOf(Feature::TREE) | bitOf(Feature::PACKETS) | bitOf(Feature::VERTEX_NORMALS) |
    bitOf(Feature::TEXTURES) | bitOf(Feature::VERTEX_COLORS) | bitOf(Feature::NORMAL_TEXTURE) |
    bitOf(Feature::UV0) | bitOf(Feature::UV1) | bitOf(Feature::BACKGROUND_MAP) |
    bitOf(Feature::SURFACE_LIGHTS) | bitOf(Feature::SKY_LIGHTS) | bitOf(Feature::CLEARCOAT) |
    bitOf(Feature::ANISOTROPY);

/// Uploads of `pruned` what `features` needs. Throws ClError naming the buffer that does not fit. The
/// tree's nodes are let go where a wider tree takes their place.
/// `consumed`: null, or the scene itself, whose owner reads no more of its normals, tangents, texture
/// coordinates and texels: they are let go as soon as the device has them. `stays`: what it has already of
/// texels, background and the sky's table; an empty buffer is uploaded.
DeviceScene uploadScene(Compute& compute, const Scene& scene, const PrunedScene& pruned, TriTree tree,
                        const SceneFeatures& features, Scene* consumed = nullptr, DeviceScene stays = {});

/// Of a scene that goes: the buffers of its images.
DeviceScene imagesOf(DeviceScene&& scene);

/// Which buffers an edit reached.
struct TableChanges {
  bool lights = false, materials = false, textures = false, triangles = false;
  bool any() const { return lights || materials || textures || triangles; }
};
/// After an edit of lights or materials that reads the same texels: writes those tables that are others, and
/// what the triangles say of their materials. Tree, vertices and texels stay.
TableChanges takeOver(Compute& compute, const Scene& scene, DeviceTables tables, DeviceScene& onDevice);

/// Corners, m, of triangle `index` in leaf order, of which the device says `triangle`;
/// kernels/lib/corners.cl.
std::array<glm::vec3, 3> readCorners(Compute& compute, const DeviceScene& scene, std::uint32_t index,
                                     const device::DeviceTriangle& triangle);

/// Of the whole scene, for features that nothing analysed.
inline DeviceScene uploadScene(Compute& compute, const Scene& scene, TriTree tree,
                               const SceneFeatures& features) {
  return uploadScene(compute, scene, unprunedScene(scene), std::move(tree), features);
}

}  // namespace whittle
