#include "gltf/roughness.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace whittle::gltf {
namespace {

/// In 8 bits where they hold it exactly, else in 16 beside them.
Image roughnessOf(const Image& from, double glossiness) {
  Image image{from.name, from.width, from.height, std::vector<std::uint8_t>(from.texels.size())};
  const bool isExact = glossiness == 1.0 && !from.isDeep();
  if (!isExact) image.deepTexels.resize(from.texels.size());
  for (std::size_t alpha = 3; alpha < from.texels.size(); alpha += 4) {
    const double gloss = from.isDeep() ? from.deepTexels[alpha] / 65535.0 : from.texels[alpha] / 255.0;
    const double roughness = std::clamp(1.0 - glossiness * gloss, 0.0, 1.0);
    image.texels[alpha - 2] = static_cast<std::uint8_t>(std::lround(255.0 * roughness));
    image.texels[alpha] = 255;
    if (isExact) continue;
    image.deepTexels[alpha - 2] = static_cast<std::uint16_t>(std::lround(65535.0 * roughness));
    image.deepTexels[alpha] = 65535;
  }
  return image;
}

}  // namespace

void makeRoughness(const Document& document, const std::vector<GlossyMaterial>& glossy, Scene& scene) {
  std::map<std::pair<int, double>, int> made;
  for (const auto& [index, glossiness] : glossy) {
    Material& material = scene.materials[index];
    TextureSlot& slot = material.metallicRoughnessTexture;
    material.roughness = slot.used() ? 1.0F : static_cast<float>(1.0 - glossiness);
    if (!slot.used()) continue;
    const auto [known, isNew] =
        made.try_emplace({slot.image, glossiness}, static_cast<int>(scene.images.size()));
    if (isNew) {
      const Image& from = scene.images[at(slot.image)];
      const std::uint64_t bytes = from.texels.size() * (glossiness == 1.0 && !from.isDeep() ? 1 : 3);
      document.hold(bytes, "roughness made of glossiness");
      if (document.textureLevels)
        document.promise(bytes / 3, "smaller levels of roughness made of glossiness");
      scene.images.push_back(roughnessOf(from, glossiness));
    }
    slot.image = known->second;
  }
}

}  // namespace whittle::gltf
