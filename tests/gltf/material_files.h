// Files with one material, for its tests.
#pragma once

#include <string>
#include <vector>

#include "gltf/builder.h"

namespace whittle::test {

/// One triangle with both sets of coordinates, material 0, texture 0 a small picture.
inline GltfBuilder textured(const Json& material) {
  GltfBuilder b;
  const std::string png = pngBytes();
  const int view = b.view(std::vector<char>(png.begin(), png.end()));
  b.push("images", {{"bufferView", view}, {"mimeType", "image/png"}});
  b.push("textures", {{"source", 0}});
  b.material(material);
  b.node({{"mesh", b.triangleMesh({{"material", 0},
                                   {"attributes",
                                    {{"TEXCOORD_0", b.vec2({0, 1, 1, 1, 0, 0})},
                                     {"TEXCOORD_1", b.vec2({0.5F, 0.5F, 1, 1, 0, 0})},
                                     {"NORMAL", b.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1})}}}})}});
  return b;
}

inline Material materialOf(const Json& json) {
  GltfBuilder b;
  b.material(json);
  b.node({{"mesh", b.triangleMesh({{"material", 0}})}});
  const Scene scene = b.load();
  EXPECT_TRUE(b.notices.warnings.empty());
  return scene.materials.at(0);
}

}  // namespace whittle::test
