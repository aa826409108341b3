// Which parts of a material show: follows kernels/lib/surface: point.cl, material.cl, surfel.cl and bsdf.cl.
#include "analysis/material_use.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace whittle {
namespace {

constexpr float kMargin = 1e-5F;  ///< relative; what is interpolated loses less to rounding

/// An unlit surface shows base colour, alpha, and its volume's absorption; its normal in an auxiliary output.
Material unlitParts(const Material& m, bool showsNormal) {
  Material read;
  read.unlit = true;
  read.baseColor = m.baseColor;
  read.baseColorTexture = m.baseColorTexture;
  read.volume = m.volume;
  read.sigma_a = m.sigma_a;
  read.alphaMode = m.alphaMode;
  read.alphaCutoff = m.alphaCutoff;
  if (showsNormal) {
    read.normalTexture = m.normalTexture;
    read.normalScale = m.normalScale;
  }
  return read;
}

/// Least alpha of all hits, computed so that kernels are never below it; exact without interpolation.
float leastAlphaAtHits(const Material& m, const AlphaSource& source) {
  float least = m.baseColor.a;
  if (!(least >= 0.0F) || !std::isfinite(least)) return -1.0F;
  if (source.leastTexel < 255)  // texels of 255 are exactly 1, and so is what lies between them
    least *= static_cast<float>(source.leastTexel) / 255.0F * (1.0F - kMargin);
  if (source.coloured) {
    // Weights may be negative by rounding, and add up to 1 but for that.
    const float lost = kMargin * std::max(1.0F, source.colours.greatest);
    least *= (source.colours.least - lost) * (1.0F - kMargin);
  }
  return least;
}

class Bits {
 public:
  template <typename... Values>
  void add(const Values&... values) {
    (append(values), ...);
  }
  void add(const TextureSlot& s) { add(s.image, s.uvSet, s.wrapS, s.wrapT, s.filter, s.transform); }
  std::string text;

 private:
  template <typename T>
  void append(const T& value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, TextureSlot>);
    text.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
};

}  // namespace

Material asRead(const Material& m, const Settings& settings) {
  Material read = m.unlit ? unlitParts(m, settings.aovs) : m;
  read.name.clear();
  read.occlusionStrength = 1.0F;
  read.occlusionTexture = {};
  if (read.emission == glm::vec3(0.0F)) {
    read.emissionTexture = {};
    read.doubleSided = false;  // decides which sides emit, nothing else
  }
  if (read.transmission == 0.0F) read.transmissionTexture = {};
  if (read.specular == 0.0F) read.specularTexture = {};
  if (read.specularColor == glm::vec3(0.0F)) read.specularColorTexture = {};
  if (!read.normalTexture.used()) read.normalScale = 1.0F;
  if (!read.volume) read.sigma_a = glm::vec3(0.0F);
  if (read.alphaMode != AlphaMode::Mask) read.alphaCutoff = 0.5F;
  for (TextureSlot* slot : readSlots(read))
    if (!slot->used()) *slot = {};
  return read;
}

std::string bitsOf(const Material& m) {
  Bits bits;
  bits.add(m.baseColor, m.metallic, m.roughness, m.normalScale, m.emission, m.ior, m.specular,
           m.specularColor, m.transmission, m.volume, m.sigma_a, m.unlit, m.alphaMode, m.alphaCutoff,
           m.doubleSided);
  for (const TextureSlot* slot : readSlots(m)) bits.add(*slot);
  return bits.text;
}

std::array<TextureSlot*, 7> readSlots(Material& m) {
  return {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture,      &m.emissionTexture,
          &m.specularTexture,  &m.specularColorTexture,     &m.transmissionTexture};
}

std::array<const TextureSlot*, 7> readSlots(const Material& m) {
  return {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture,      &m.emissionTexture,
          &m.specularTexture,  &m.specularColorTexture,     &m.transmissionTexture};
}

bool maskIsNeedless(const Material& m, const AlphaSource& source) {
  return m.alphaMode == AlphaMode::Mask && leastAlphaAtHits(m, source) >= m.alphaCutoff;
}

bool blendIsNeedless(const Material& m, const AlphaSource& source) {
  // Weights of vertex colours do not add up to 1 exactly.
  return m.alphaMode == AlphaMode::Blend && m.baseColor.a >= 1.0F && source.leastTexel == 255 &&
         !source.coloured;
}

}  // namespace whittle
