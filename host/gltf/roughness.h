// Roughness made of glossiness (KHR_materials_pbrSpecularGlossiness), once images are decoded.
#pragma once

#include <cstddef>
#include <vector>

#include "gltf/document.h"

namespace whittle::gltf {

/// A material of the scene whose metallic-roughness texture holds glossiness in its alpha, times
/// `glossiness`.
struct GlossyMaterial {
  std::size_t material = 0;
  double glossiness = 1.0;
};

/// Gives those materials images with 1 less their glossiness in green, each once; without a texture the
/// roughness alone. Throws InputError where that takes too much memory.
void makeRoughness(const Document& document, const std::vector<GlossyMaterial>& glossy, Scene& scene);

}  // namespace whittle::gltf
