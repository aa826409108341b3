// What a surface can do, asked of its material's factors: features, the radiance bound, the upload and tests
// all ask here. A texture may scale a factor down to 0, never up. The reference asks nothing: it decides at
// each hit.
#pragma once

#include <algorithm>
#include <limits>

#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

/// Answers to light; an unlit surface shows its base colour alone.
inline bool isLit(const Material& m) { return !m.unlit; }
inline bool emits(const Material& m) { return isLit(m) && m.emission != glm::vec3(0.0F); }
inline bool isMetallic(const Material& m) { return m.metallic > 0.0F; }

/// KHR_materials_clearcoat at work, and the extensions after it by their names.
inline bool isCoated(const Material& m) { return isLit(m) && m.clearcoat > 0.0F; }
inline bool hasSheen(const Material& m) {
  return isLit(m) && (m.sheenColor.r > 0.0F || m.sheenColor.g > 0.0F || m.sheenColor.b > 0.0F);
}
inline bool isIridescent(const Material& m) { return isLit(m) && m.iridescence > 0.0F; }
inline bool isAnisotropic(const Material& m) { return isLit(m) && m.anisotropy > 0.0F; }

/// What canReflect and those after it take for a mirror: with Settings::glossy anything.
inline float reflectingRoughness(const Settings& settings) {
  return settings.glossy ? std::numeric_limits<float>::infinity() : settings.mirrorRoughness;
}

/// Somewhere smoother than `mirrorRoughness` (Settings): a mirror or clear glass there.
inline bool canBeSmooth(const Material& m, float mirrorRoughness) {
  return isLit(m) && (m.metallicRoughnessTexture.used() || std::max(m.roughness, 0.0F) < mirrorRoughness);
}
inline bool canBeRough(const Material& m, float mirrorRoughness) {
  return isLit(m) && !(std::max(m.roughness, 0.0F) < mirrorRoughness);
}
/// Rough, and not Lambert's alone.
inline bool canShowHighlight(const Material& m, float mirrorRoughness) {
  return canBeRough(m, mirrorRoughness) && (m.specular > 0.0F || isMetallic(m) || isIridescent(m));
}

/// Its coat is somewhere smoother than `mirrorRoughness`.
inline bool coatCanReflect(const Material& m, float mirrorRoughness) {
  return isCoated(m) && (m.clearcoatRoughnessTexture.used() || m.clearcoatRoughness < mirrorRoughness);
}
inline bool coatCanBeRough(const Material& m, float mirrorRoughness) {
  return isCoated(m) && !(m.clearcoatRoughness < mirrorRoughness);
}

/// What lies below a coat sends out a mirror impulse.
inline bool baseCanReflect(const Material& m, float mirrorRoughness) {
  const bool isDielectricMirror = (m.specular > 0.0F && m.ior != 1.0F) || isIridescent(m);
  return canBeSmooth(m, mirrorRoughness) && (isMetallic(m) || isDielectricMirror);
}
/// Sends out a mirror impulse.
inline bool canReflect(const Material& m, float mirrorRoughness) {
  return baseCanReflect(m, mirrorRoughness) || coatCanReflect(m, mirrorRoughness);
}

inline bool transmits(const Material& m) { return isLit(m) && m.transmission > 0.0F; }
/// Bends what it transmits.
inline bool refracts(const Material& m) { return transmits(m) && m.volume; }
/// Bends each colour by itself (KHR_materials_dispersion).
inline bool disperses(const Material& m) { return refracts(m) && m.dispersion > 0.0F && m.ior > 1.0F; }
/// Lights on one side of it show on the other (KHR_materials_diffuse_transmission).
inline bool transmitsDiffusely(const Material& m) { return isLit(m) && m.diffuseTransmission > 0.0F; }
inline bool absorbs(const Material& m) { return m.volume && m.sigma_a != glm::vec3(0.0F); }
inline bool isMasked(const Material& m) { return m.alphaMode == AlphaMode::Mask; }
inline bool blends(const Material& m) { return m.alphaMode == AlphaMode::Blend; }
/// Lets light go on the way it came: a ray that meets it goes on without a bounce.
inline bool goesStraightOn(const Material& m) {
  return blends(m) || (transmits(m) && (!m.volume || m.ior == 1.0F));
}
/// Eye and impulse rays do not meet its back (glTF 2.0, 3.9.5); what light passes has two sides.
inline bool showsFrontOnly(const Material& m) { return !m.doubleSided && !m.volume && !transmits(m); }
/// Lets a part of the light of a shadow ray through.
inline bool filters(const Material& m) { return blends(m) || transmits(m); }

inline bool canSendImpulses(const Material& m, float mirrorRoughness) {
  return canReflect(m, mirrorRoughness) || filters(m);
}
inline bool canSendTwoImpulses(const Material& m, float mirrorRoughness) {
  const bool reflects = canReflect(m, mirrorRoughness);
  const bool reflectsTwice = baseCanReflect(m, mirrorRoughness) && coatCanReflect(m, mirrorRoughness);
  return reflectsTwice || (transmits(m) && (reflects || m.volume)) || (blends(m) && reflects);
}

/// KHR_materials_specular at work.
inline bool changesSpecular(const Material& m) {
  return m.specular != 1.0F || m.specularColor != glm::vec3(1.0F) || m.specularTexture.used() ||
         m.specularColorTexture.used();
}

}  // namespace whittle
