// Procedural surfaces baked to the three images of a glTF material.
#pragma once

#include <functional>

#include "gltf_builder.h"

namespace generator {

/// A surface at a point of its texture.
struct SurfacePoint {
  glm::dvec3 color{0.5};  ///< linear reflectance
  double height = 0;      ///< metres
  double roughness = 0.5;
};

/// A function of the unit square: x to the right, y down. It repeats without a seam.
using SurfaceFunction = std::function<SurfacePoint(glm::dvec2 uv)>;

/// Pixels and size of a texture.
struct BakeSize {
  int width = 512, height = 512;
  double metres = 0.1;  ///< what the width covers; pixels are square
};

/// PNG files: sRGB colour, tangent-space normals, roughness in green with blue 1, as glTF wants them.
struct BakedSurface {
  std::vector<std::uint8_t> color, normal, roughness;
};

BakedSurface bake(const BakeSize& size, const SurfaceFunction& surface);

/// Bakes and adds the images to `scene`, and makes `spec` use them. Its factors of colour and roughness
/// become 1.
MaterialSpec withTextures(GltfBuilder& scene, MaterialSpec spec, const BakeSize& size,
                          const SurfaceFunction& surface);

/// The PNG file of a picture whose linear colours are a function of the unit square.
std::vector<std::uint8_t> paintPicture(int width, int height,
                                       const std::function<glm::dvec3(glm::dvec2 uv)>& color);

/// A linear value in [0, 1] as an 8-bit sRGB code (IEC 61966-2-1).
std::uint8_t srgbCode(double linear);

}  // namespace generator
