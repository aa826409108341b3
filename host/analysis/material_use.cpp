// Which parts of a material show: follows kernels/lib/surface: point.cl, material.cl, surfel.cl and bsdf.cl.
#include "analysis/material_use.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <type_traits>

#include "analysis/feature.h"
#include "scene/material_predicates.h"

namespace whittle {
namespace {

constexpr float kMargin = 1e-5F;  ///< relative; what is interpolated loses less to rounding

bool isAmong(Feature feature, std::initializer_list<Feature> features) {
  return std::find(features.begin(), features.end(), feature) != features.end();
}

/// What an unlit surface shows; its normal in an auxiliary output alone.
Material unlitParts(const Material& m, bool showsNormal) {
  using enum Feature;
  Material read;
  read.unlit = true;
  read.doubleSided = m.doubleSided;
  read.volume = m.volume;
  read.alphaMode = m.alphaMode;
#define WHITTLE_VECTOR(name, size, least, most, isUnlit) \
  if (isUnlit) read.name = m.name;
#define WHITTLE_SCALAR(name, least, most, isUnlit) \
  if (isUnlit) read.name = m.name;
#define WHITTLE_SLOT(slot, FEATURE, encoding, factor, OTHERS) \
  if (isAmong(UNLIT, WHITTLE_LIST OTHERS)) read.slot = m.slot;
  WHITTLE_MATERIAL_FACTORS(WHITTLE_VECTOR, WHITTLE_SCALAR)
  WHITTLE_TEXTURE_SLOTS(WHITTLE_SLOT)
#undef WHITTLE_VECTOR
#undef WHITTLE_SCALAR
#undef WHITTLE_SLOT
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

bool isZero(float factor) { return factor == 0.0F; }
bool isZero(const glm::vec3& factor) { return factor == glm::vec3(0.0F); }

void dropTexturesTimes0(Material& m) {
#define WHITTLE_DROP(slot, FEATURE, encoding, factor, OTHERS) \
  if (isZero(factor)) m.slot = {};
  WHITTLE_TEXTURE_SLOTS(WHITTLE_DROP)
#undef WHITTLE_DROP
}

/// What layers that are not there are like.
void dropUnusedLayers(Material& m) {
  const Material plain;
  if (!isCoated(m)) {
    m.clearcoatRoughness = plain.clearcoatRoughness;
    m.clearcoatNormalTexture = {};
  }
  if (!m.clearcoatNormalTexture.used()) m.clearcoatNormalScale = plain.clearcoatNormalScale;
  if (!hasSheen(m)) m.sheenRoughness = plain.sheenRoughness;
  if (!isIridescent(m)) {
    m.iridescenceIor = plain.iridescenceIor;
    m.mostThickness = plain.mostThickness;
    m.iridescenceThicknessTexture = {};
  }
  if (!m.iridescenceThicknessTexture.used()) m.leastThickness = plain.leastThickness;
  if (!isAnisotropic(m)) m.anisotropyRotation = plain.anisotropyRotation;
  if (!disperses(m)) m.dispersion = plain.dispersion;
  if (!transmitsDiffusely(m)) m.diffuseTransmissionColor = plain.diffuseTransmissionColor;
}

class Bits {
 public:
  template <typename... Values>
  void add(const Values&... values) {
    (append(values), ...);
  }
  void add(const TextureSlot& s) {
    add(s.image, s.uvSet, s.wrapS, s.wrapT, s.filter, s.hasLevels, s.transform);
  }
  std::string text;

 private:
  template <typename T>
  void append(const T& value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, TextureSlot>);
    text.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
};

}  // namespace

void dropLevels(Material& m) {
  for (const auto slot : kTextureSlots) (m.*slot).hasLevels = false;
}

Material asRead(const Material& m, const Settings& settings) {
  Material read = m.unlit ? unlitParts(m, settings.aovs) : m;
  read.name.clear();
  read.occlusionStrength = 1.0F;
  read.occlusionTexture = {};
  // It decides which sides are seen, where light does not pass, and which sides emit.
  const bool hidesBack = settings.backFaces == BackFaces::Cull && !read.volume && !transmits(read);
  if (!emits(read) && !hidesBack) read.doubleSided = false;
  dropTexturesTimes0(read);
  dropUnusedLayers(read);
  if (!read.normalTexture.used()) read.normalScale = 1.0F;
  if (!read.volume) read.sigma_a = glm::vec3(0.0F);
  if (!isMasked(read)) read.alphaCutoff = 0.5F;
  for (const auto slot : kTextureSlots)
    if (!(read.*slot).used()) read.*slot = {};
  if (settings.textureFilter == TextureFilter::None) dropLevels(read);
  return read;
}

std::string bitsOf(const Material& m) {
  Bits bits;
#define WHITTLE_VECTOR(name, ...) bits.add(m.name);
#define WHITTLE_SCALAR(name, ...) bits.add(m.name);
#define WHITTLE_SLOT(slot, FEATURE, encoding, factor, OTHERS) bits.add(m.slot);
  WHITTLE_MATERIAL_FACTORS(WHITTLE_VECTOR, WHITTLE_SCALAR)
  WHITTLE_TEXTURE_SLOTS(WHITTLE_SLOT)
#undef WHITTLE_VECTOR
#undef WHITTLE_SCALAR
#undef WHITTLE_SLOT
  bits.add(m.volume, m.unlit, m.alphaMode, m.doubleSided);
  return bits.text;
}

bool maskIsNeedless(const Material& m, const AlphaSource& source) {
  return isMasked(m) && leastAlphaAtHits(m, source) >= m.alphaCutoff;
}

bool blendIsNeedless(const Material& m, const AlphaSource& source) {
  // Weights of vertex colours do not add up to 1 exactly.
  return blends(m) && m.baseColor.a >= 1.0F && source.leastTexel == 255 && !source.coloured;
}

}  // namespace whittle
