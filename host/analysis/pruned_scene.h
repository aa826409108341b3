// What of a scene goes to the device, decided once for each render: the features, the upload and
// `whittle info` all read it. Nothing that is left out changes a bit of the picture.
#pragma once

#include <cstdint>
#include <vector>

#include "analysis/duplicate_images.h"
#include "analysis/pruning_report.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

/// Vertices whose indices fit 16 bits.
inline constexpr std::size_t kNarrowVertices = 1 << 16;

/// In a table: it does not go to the device.
inline constexpr std::uint32_t kNotUsed = 0xffffffffU;

/// Tables from the scene to the device.
struct PrunedScene {
  std::vector<Material> materials;  ///< as the device gets them; their slots' `image` counts in `images`
  std::vector<std::uint32_t> materialOf;  ///< [Scene::materials] index into `materials`, or kNotUsed
  std::vector<std::uint32_t> images;      ///< indices into Scene::images
  /// Indices into Scene::lights, in the scene's order; each twice where a material transmits diffusely: for
  /// the viewer's side of a surface, then for the other.
  std::vector<std::uint32_t> lights;
  /// [vertices] index into the device's arrays of attributes, or kNotUsed; empty: all of them go as they are.
  std::vector<std::uint32_t> vertexOf;
  std::size_t vertexCount = 0;  ///< on the device
  bool narrowCorners = false;   ///< triangles name their vertices by 16 bits each, not by 32
  bool sharesSlots = false;     ///< identical texture slots are stored once
  PruningReport pruning;
};

/// The whole scene, nothing left out.
PrunedScene unprunedScene(const Scene& scene);

/// Only what the picture needs; unprunedScene with settings.keepAllFeatures. Linear in the scene's size.
/// `texels`: null, or what earlier calls found out about the same images, to which this one adds.
PrunedScene pruneScene(const Scene& scene, const Settings& settings, TexelFacts* texels = nullptr);

}  // namespace whittle
