// The scene on the device: only the buffers its features need. A buffer that is left out is a
// null pointer there.
#pragma once

#include <functional>
#include <vector>

#include "analysis/scene_features.h"
#include "bvh/bvh8.h"
#include "cl/program.h"
#include "report/stats.h"
#include "scene/scene.h"
#include "wavefront/arguments_macro.h"

namespace whittle {

struct DeviceScene {
  Buffer nodes, triangles, corners, indices32, normals, tangents, uv0, uv1, colors, materials, textures,
      texels, linearFromSrgb, lights, backgroundMap, bvh8Nodes, leaves;
  std::uint32_t triangleCount = 0;  ///< not counting the degenerate sentinel at the end
  std::uint32_t lightCount = 0;

  /// SCENE_PARAMS of kernels/lib/scene.cl.
  WHITTLE_ARGUMENTS(nodes, triangles, corners, indices32, normals, tangents, uv0, uv1, colors, materials,
                    textures, texels, linearFromSrgb, lights, backgroundMap, bvh8Nodes, leaves, triangleCount)

  std::vector<const Buffer*> buffers() const;
  void report(std::vector<BufferStats>& out) const;
};

/// Called with the index of an image of the scene once the device has what it needs of it.
using ImageUploaded = std::function<void(std::size_t image)>;

/// Uploads of `pruned` what `features` needs. Throws ClError naming the buffer that does not fit. `uploaded`,
/// which may be empty, is called for each image that it uploads and may take its texels away.
DeviceScene uploadScene(Compute& compute, const Scene& scene, const PrunedScene& pruned, const TriTree& tree,
                        const SceneFeatures& features, const ImageUploaded& uploaded = {});
/// Of the whole scene, for features that nothing analysed.
inline DeviceScene uploadScene(Compute& compute, const Scene& scene, const TriTree& tree,
                               const SceneFeatures& features) {
  return uploadScene(compute, scene, unprunedScene(scene), tree, features);
}

}  // namespace whittle
