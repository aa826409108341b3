// Reads materials. Factors: glTF 2.0, 3.9 and the extensions' own texts.
#include "gltf/material.h"

#include <fmt/format.h>

#include <cmath>

#include "gltf/roughness.h"
#include "gltf/texture.h"
#include "scene/material_factors.h"
#include "scene/ranges.h"

namespace whittle::gltf {

namespace {

float factor(const Json& object, const char* key, double fallback) {
  return static_cast<float>(number(object, key, fallback));
}

glm::vec3 colour(const Json& object, const char* key, float fallback) {
  const Json& v = child(object, key);
  if (v.size() != 3) return glm::vec3(fallback);
  return {v[0].get<float>(), v[1].get<float>(), v[2].get<float>()};
}

std::string materialLabel(const Json& m, std::size_t i) {
  return fmt::format("material {}{}", i, quotedName(m.value("name", "")));
}

void readBase(const Json& json, TextureReader& textures, Material& out) {
  const Json& pbrJson = child(json, "pbrMetallicRoughness");
  const Json& base = child(pbrJson, "baseColorFactor");
  for (int i = 0; i < 4 && base.size() == 4; ++i) out.baseColor[i] = base[at(i)].get<float>();
  out.metallic = factor(pbrJson, "metallicFactor", 1.0);
  out.roughness = factor(pbrJson, "roughnessFactor", 1.0);
  out.emission = colour(json, "emissiveFactor", 0.0F);
  out.alphaCutoff = factor(json, "alphaCutoff", 0.5);
  out.doubleSided = json.value("doubleSided", false);
  out.baseColorTexture = textures.slot(pbrJson, "baseColorTexture");
  out.metallicRoughnessTexture = textures.slot(pbrJson, "metallicRoughnessTexture");
  out.normalTexture = textures.slot(json, "normalTexture");
  out.normalScale = factor(child(json, "normalTexture"), "scale", 1.0);
  out.occlusionTexture = textures.slot(json, "occlusionTexture");
  out.occlusionStrength = factor(child(json, "occlusionTexture"), "strength", 1.0);
  out.emissionTexture = textures.slot(json, "emissiveTexture");
}

/// -ln(colour)/distance, and 0 where the colour is 1 or the distance infinite.
float absorption(double transmitted, double distance) {
  if (transmitted >= 1.0 || !std::isfinite(distance)) return 0.0F;
  return static_cast<float>(-std::log(std::max(transmitted, 0.0)) / distance);
}

void readVolume(const Json& volume, const std::string& label, Material& out, Notices& notices) {
  out.volume = number(volume, "thicknessFactor", 0.0) > 0.0;
  if (!out.volume || !volume.contains("attenuationDistance")) return;
  const double distance = number(volume, "attenuationDistance", 0.0);
  if (!(distance > 0.0)) {
    notices.warn(fmt::format("{}: attenuationDistance must be positive; nothing is absorbed", label));
    return;
  }
  const glm::vec3 c = colour(volume, "attenuationColor", 1.0F);
  for (int i = 0; i < 3; ++i) out.sigma_a[i] = absorption(c[i], distance);
}

/// What lies over the surface, and how its facets lie.
void readLayers(const Json& json, TextureReader& textures, Material& out) {
  if (const Json* e = extension(json, "KHR_materials_clearcoat")) {
    out.clearcoat = factor(*e, "clearcoatFactor", 0.0);
    out.clearcoatTexture = textures.slot(*e, "clearcoatTexture");
    out.clearcoatRoughness = factor(*e, "clearcoatRoughnessFactor", 0.0);
    out.clearcoatRoughnessTexture = textures.slot(*e, "clearcoatRoughnessTexture");
    out.clearcoatNormalTexture = textures.slot(*e, "clearcoatNormalTexture");
    out.clearcoatNormalScale = factor(child(*e, "clearcoatNormalTexture"), "scale", 1.0);
  }
  if (const Json* e = extension(json, "KHR_materials_sheen")) {
    out.sheenColor = colour(*e, "sheenColorFactor", 0.0F);
    out.sheenColorTexture = textures.slot(*e, "sheenColorTexture");
    out.sheenRoughness = factor(*e, "sheenRoughnessFactor", 0.0);
    out.sheenRoughnessTexture = textures.slot(*e, "sheenRoughnessTexture");
  }
  if (const Json* e = extension(json, "KHR_materials_iridescence")) {
    out.iridescence = factor(*e, "iridescenceFactor", 0.0);
    out.iridescenceTexture = textures.slot(*e, "iridescenceTexture");
    out.iridescenceIor = factor(*e, "iridescenceIor", 1.3);
    out.leastThickness = factor(*e, "iridescenceThicknessMinimum", 100.0);
    out.mostThickness = factor(*e, "iridescenceThicknessMaximum", 400.0);
    out.iridescenceThicknessTexture = textures.slot(*e, "iridescenceThicknessTexture");
  }
  if (const Json* e = extension(json, "KHR_materials_anisotropy")) {
    out.anisotropy = factor(*e, "anisotropyStrength", 0.0);
    out.anisotropyRotation = factor(*e, "anisotropyRotation", 0.0);
    out.anisotropyTexture = textures.slot(*e, "anisotropyTexture");
  }
}

void readExtensions(const Json& json, const std::string& label, TextureReader& textures, Material& out,
                    Notices& notices) {
  if (const Json* e = extension(json, "KHR_materials_emissive_strength")) {
    out.emission *= factor(*e, "emissiveStrength", 1.0);
  }
  if (const Json* e = extension(json, "KHR_materials_ior")) {
    out.ior = factor(*e, "ior", 1.5);
    if (out.ior < 0.0F) {
      notices.warn(fmt::format("{}: {}; 1.5 is used", label, kIorFlaw));
      out.ior = 1.5F;
    }
  }
  if (const Json* e = extension(json, "KHR_materials_transmission")) {
    out.transmission = factor(*e, "transmissionFactor", 0.0);
    out.transmissionTexture = textures.slot(*e, "transmissionTexture");
  }
  if (const Json* e = extension(json, "KHR_materials_specular")) {
    out.specular = factor(*e, "specularFactor", 1.0);
    out.specularTexture = textures.slot(*e, "specularTexture");
    out.specularColor = colour(*e, "specularColorFactor", 1.0F);
    out.specularColorTexture = textures.slot(*e, "specularColorTexture");
  }
  if (const Json* e = extension(json, "KHR_materials_dispersion")) {
    out.dispersion = factor(*e, "dispersion", 0.0);
  }
  if (const Json* e = extension(json, "KHR_materials_diffuse_transmission")) {
    out.diffuseTransmission = factor(*e, "diffuseTransmissionFactor", 0.0);
    out.diffuseTransmissionTexture = textures.slot(*e, "diffuseTransmissionTexture");
    out.diffuseTransmissionColor = colour(*e, "diffuseTransmissionColorFactor", 1.0F);
    out.diffuseTransmissionColorTexture = textures.slot(*e, "diffuseTransmissionColorTexture");
  }
  if (const Json* e = extension(json, "KHR_materials_volume")) readVolume(*e, label, out, notices);
  readLayers(json, textures, out);
  out.unlit = extension(json, "KHR_materials_unlit") != nullptr;
}

/// KHR_materials_pbrSpecularGlossiness as a dielectric of ior 0, whose F0 is the specular colour itself
/// (KHR_materials_ior, KHR_materials_specular). The extension's diffuse colour loses what F0 reflects; here
/// it loses what is reflected at each angle, which is the same from the front. Glossiness is 1 - roughness.
/// It comes in the place of metallic-roughness and of what goes with that alone.
void readSpecularGlossiness(const Json& e, TextureReader& textures, Material& out) {
  const Json& diffuse = child(e, "diffuseFactor");
  for (int i = 0; i < 4 && diffuse.size() == 4; ++i) out.baseColor[i] = diffuse[at(i)].get<float>();
  out.baseColorTexture = textures.slot(e, "diffuseTexture");
  out.metallic = out.ior = out.transmission = 0.0F;
  out.volume = false;
  out.specular = 1.0F;
  out.specularTexture = {};
  out.specularColor = colour(e, "specularFactor", 1.0F);
  out.specularColorTexture = textures.slot(e, "specularGlossinessTexture");
  out.metallicRoughnessTexture = out.specularColorTexture;  // see makeRoughness
}

AlphaMode alphaModeOf(const std::string& mode, const std::string& label, Notices& notices) {
  if (mode == "MASK") return AlphaMode::Mask;
  if (mode == "BLEND") return AlphaMode::Blend;
  if (mode != "OPAQUE")
    notices.warn(fmt::format("{}: unknown alphaMode{}; opaque is used", label, quotedName(mode)));
  return AlphaMode::Opaque;
}

/// Roughness from which clear glass looks wrong; textures may make a surface smoother than its factor.
bool transmitsRoughly(const Material& m) { return m.transmission > 0.0F && m.roughness > 0.2F; }

const Json* glossinessOf(const Json& material) {
  return extension(material, "KHR_materials_pbrSpecularGlossiness");
}

/// All of it but the roughness that is made of glossiness, see makeRoughness.
Material readMaterial(Document& document, int index, TextureReader& textures, Notices& notices) {
  Json& json = document.json["materials"][at(index)];
  const Json* const glossy = glossinessOf(json);
  if (glossy) json.erase("pbrMetallicRoughness");  // for readers without the extension
  const std::string label = materialLabel(json, at(index));
  Material material;
  material.name = json.value("name", "");
  material.index = index;
  material.alphaMode = alphaModeOf(json.value("alphaMode", "OPAQUE"), label, notices);
  readBase(json, textures, material);
  readExtensions(json, label, textures, material, notices);
  if (glossy) readSpecularGlossiness(*glossy, textures, material);
  // Kept as they are, so that the picture shows what the file says; but said.
  if (!isInRange(material)) notices.warn(fmt::format("{}: {}", label, kFactorFlaw));
  return material;
}

}  // namespace

std::vector<int> readMaterials(Document& document, const std::set<int>& wanted, Scene& scene,
                               Notices& notices) {
  std::vector<int> indices(child(document.json, "materials").size() + 1, -1);
  ImageSources sources(document);
  sources.hold(wanted);
  TextureReader textures(document, sources, scene, notices);
  std::vector<GlossyMaterial> glossyMaterials;
  int rough = 0;
  for (const int index : wanted) {
    if (index < 0) continue;
    Material material = readMaterial(document, index, textures, notices);
    if (const Json* const glossy = glossinessOf(document.json["materials"][at(index)]))
      glossyMaterials.push_back({scene.materials.size(), number(*glossy, "glossinessFactor", 1.0)});
    rough += transmitsRoughly(material);
    indices[at(index) + 1] = static_cast<int>(scene.materials.size());
    scene.materials.push_back(std::move(material));
  }
  textures.decodeAll();
  makeRoughness(document, glossyMaterials, scene);
  if (rough > 0)
    notices.note(fmt::format("{} transmit{} light through a rough surface: drawn clear",
                             rough == 1 ? "1 material" : fmt::format("{} materials", rough),
                             rough == 1 ? "s" : ""));
  if (wanted.contains(-1)) {
    indices[0] = static_cast<int>(scene.materials.size());
    Material fallback;
    fallback.name = "default";
    scene.materials.push_back(std::move(fallback));
  }
  return indices;
}

void changeMaterials(Document& document, const std::set<int>& changed, Scene& scene, Notices& notices) {
  ImageSources sources(document);
  TextureReader textures(document, sources, scene, notices);
  for (Material& material : scene.materials) {
    if (!changed.contains(material.index)) continue;
    Material now = readMaterial(document, material.index, textures, notices);
    for (const auto slot : kTextureSlots) (now.*slot).image = (material.*slot).image;
    now.occlusionTexture.image = material.occlusionTexture.image;
    if (glossinessOf(document.json["materials"][at(material.index)])) now.roughness = material.roughness;
    material = std::move(now);
  }
}

}  // namespace whittle::gltf
