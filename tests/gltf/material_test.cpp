// Materials, their extensions, textures and samplers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gltf/builder.h"
#include "gltf/material_files.h"

namespace whittle {
namespace {

using test::expectNear;
using test::GltfBuilder;
using test::Json;
using test::materialOf;
using test::mentions;
using test::textured;

TEST(GltfMaterial, DefaultsOfTheSpecification) {
  const Material m = materialOf(Json::object());
  EXPECT_EQ(m.baseColor, glm::vec4(1));
  EXPECT_EQ(m.metallic, 1.0F);
  EXPECT_EQ(m.roughness, 1.0F);
  EXPECT_EQ(m.emission, glm::vec3(0));
  EXPECT_EQ(m.ior, 1.5F);
  EXPECT_EQ(m.transmission, 0.0F);
  EXPECT_EQ(m.specular, 1.0F);
  EXPECT_EQ(m.alphaMode, AlphaMode::Opaque);
  EXPECT_EQ(m.alphaCutoff, 0.5F);
  EXPECT_FALSE(m.doubleSided || m.unlit || m.volume);
}

/// The same as a dielectric of ior 0 with that F0 (KHR_materials_specular, KHR_materials_ior).
TEST(GltfMaterial, SpecularGlossiness) {
  const Json gloss{{"diffuseFactor", {0.1, 0.2, 0.3, 0.4}},
                   {"specularFactor", {0.5, 0.6, 0.7}},
                   {"glossinessFactor", 0.75}};
  const Material m =
      materialOf({{"pbrMetallicRoughness", {{"metallicFactor", 1}, {"baseColorFactor", {1, 0, 0, 1}}}},
                  {"extensions",
                   {{"KHR_materials_pbrSpecularGlossiness", gloss},
                    {"KHR_materials_ior", {{"ior", 1.3}}},
                    {"KHR_materials_specular", {{"specularFactor", 0.5}}}}}});
  EXPECT_EQ(m.baseColor, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
  EXPECT_EQ(m.specularColor, glm::vec3(0.5F, 0.6F, 0.7F));
  EXPECT_EQ(m.specular, 1.0F);
  EXPECT_EQ(m.metallic, 0.0F);
  EXPECT_EQ(m.ior, 0.0F);
  EXPECT_EQ(m.roughness, 0.25F);
  const Material defaults =
      materialOf({{"extensions", {{"KHR_materials_pbrSpecularGlossiness", Json::object()}}}});
  EXPECT_EQ(defaults.baseColor, glm::vec4(1));
  EXPECT_EQ(defaults.specularColor, glm::vec3(1));
  EXPECT_EQ(defaults.roughness, 0.0F);
}

/// The picture is red and green, opaque: glossiness is the factor throughout, so roughness is 1 less that.
TEST(GltfMaterial, GlossinessOfATextureBecomesRoughness) {
  for (const double factor : {1.0, 0.3}) {
    const Json gloss{{"diffuseTexture", {{"index", 0}}},
                     {"specularGlossinessTexture", {{"index", 0}, {"texCoord", 1}}},
                     {"glossinessFactor", factor}};
    GltfBuilder b = textured({{"extensions", {{"KHR_materials_pbrSpecularGlossiness", gloss}}}});
    const Scene scene = b.load();
    const Material& m = scene.materials.at(0);
    ASSERT_EQ(scene.images.size(), 2U);
    EXPECT_EQ(m.baseColorTexture.image, 0);
    EXPECT_EQ(m.specularColorTexture.image, 0);
    EXPECT_EQ(m.specularColorTexture.uvSet, 1);
    EXPECT_EQ(m.metallicRoughnessTexture.image, 1);
    EXPECT_EQ(m.metallicRoughnessTexture.uvSet, 1);
    EXPECT_EQ(m.roughness, 1.0F);
    const Image& made = scene.images[1];
    EXPECT_EQ(made.width, 2);
    EXPECT_EQ(made.isDeep(), factor != 1.0) << "8 bits are exact where nothing is multiplied";
    for (std::size_t texel = 0; texel < 2; ++texel) {
      const double roughness =
          made.isDeep() ? made.deepTexels.at(4 * texel + 1) / 65535.0 : made.texels.at(4 * texel + 1) / 255.0;
      EXPECT_NEAR(roughness, 1.0 - factor, 0.5 / 65535) << "half a step";
    }
  }
}
TEST(GltfMaterial, CoreFactors) {
  const Material m = materialOf(
      {{"name", "paint"},
       {"alphaMode", "MASK"},
       {"alphaCutoff", 0.25},
       {"doubleSided", true},
       {"emissiveFactor", {1, 0.5, 0}},
       {"pbrMetallicRoughness",
        {{"baseColorFactor", {0.5, 0.25, 0.125, 0.75}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.25}}},
       {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}}});
  EXPECT_EQ(m.name, "paint");
  EXPECT_EQ(m.alphaMode, AlphaMode::Mask);
  EXPECT_EQ(m.alphaCutoff, 0.25F);
  EXPECT_TRUE(m.doubleSided);
  expectNear(m.emission, {8, 4, 0}, 0);
  EXPECT_EQ(m.baseColor, glm::vec4(0.5F, 0.25F, 0.125F, 0.75F));
  EXPECT_EQ(m.metallic, 0.5F);
  EXPECT_EQ(m.roughness, 0.25F);
}

TEST(GltfMaterial, ExtensionFactors) {
  const Material m = materialOf(
      {{"extensions",
        {{"KHR_materials_ior", {{"ior", 0}}},
         {"KHR_materials_transmission", {{"transmissionFactor", 0.5}}},
         {"KHR_materials_specular", {{"specularFactor", 0.25}, {"specularColorFactor", {1, 2, 3}}}},
         {"KHR_materials_unlit", Json::object()}}}});
  EXPECT_EQ(m.ior, 0.0F);
  EXPECT_EQ(m.transmission, 0.5F);
  EXPECT_EQ(m.specular, 0.25F);
  expectNear(m.specularColor, {1, 2, 3}, 0);
  EXPECT_TRUE(m.unlit);
}

TEST(GltfMaterial, AFactorOutsideItsRangeIsKeptAndSaid) {
  const auto isSaid = [](const Json& json) {
    GltfBuilder b;
    b.material(json);
    b.node({{"mesh", b.triangleMesh({{"material", 0}})}});
    b.load();
    return mentions(b.notices.warnings, "material 0: a factor is outside its range");
  };
  const auto ofExtension = [&](const char* extension, const char* key, const Json& value) {
    return isSaid({{"extensions", {{extension, {{key, value}}}}}});
  };
  for (const char* key : {"metallicFactor", "roughnessFactor"})
    for (const auto& [value, isOutside] : {std::pair{-0.01, true}, {0.0, false}, {1.0, false}, {1.01, true}})
      EXPECT_EQ(isSaid({{"pbrMetallicRoughness", {{key, value}}}}), isOutside) << key << ' ' << value;
  EXPECT_TRUE(isSaid({{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1.5}}}}}));
  EXPECT_TRUE(isSaid({{"emissiveFactor", {0, -0.5, 0}}}));
  EXPECT_TRUE(isSaid({{"alphaCutoff", -0.5}}));
  EXPECT_TRUE(ofExtension("KHR_materials_transmission", "transmissionFactor", 1.5));
  EXPECT_TRUE(ofExtension("KHR_materials_specular", "specularFactor", -0.5));
  EXPECT_TRUE(ofExtension("KHR_materials_specular", "specularColorFactor", {0, 0, -1}));
  EXPECT_FALSE(ofExtension("KHR_materials_specular", "specularColorFactor", {0, 0, 7}));
  EXPECT_EQ(materialOf({{"alphaCutoff", 1.5}}).alphaCutoff, 1.5F);
}

TEST(GltfMaterial, AbsorptionOfVolumes) {
  const auto volume = [](Json v) {
    return materialOf({{"extensions", {{"KHR_materials_volume", std::move(v)}}}});
  };
  const Material coloured =
      volume({{"thicknessFactor", 1}, {"attenuationDistance", 2}, {"attenuationColor", {0.25, 1, 0}}});
  EXPECT_TRUE(coloured.volume);
  EXPECT_NEAR(coloured.sigma_a.r, std::numbers::ln2, 1e-7);  // -ln(1/4)/2 = ln 2
  EXPECT_EQ(coloured.sigma_a.g, 0.0F);
  EXPECT_TRUE(std::isinf(coloured.sigma_a.b) && coloured.sigma_a.b > 0);
  const Material clear = volume({{"thicknessFactor", 1}, {"attenuationColor", {0.25, 1, 0}}});
  EXPECT_TRUE(clear.volume);
  EXPECT_EQ(clear.sigma_a, glm::vec3(0)) << "an infinite distance absorbs nothing";
  EXPECT_FALSE(volume({{"attenuationDistance", 2}, {"attenuationColor", {0.25, 1, 0}}}).volume) << "thin";
}

TEST(GltfMaterial, SlotsAndSamplers) {
  GltfBuilder b = textured({{"pbrMetallicRoughness",
                             {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}},
                              {"metallicRoughnessTexture", {{"index", 0}}}}},
                            {"emissiveTexture", {{"index", 1}}},
                            {"occlusionTexture", {{"index", 0}, {"strength", 0.5}}}});
  b.push("samplers", {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}});
  b.push("textures", {{"source", 0}, {"sampler", 0}});
  const Scene scene = b.load();
  const Material& m = scene.materials.at(0);
  ASSERT_EQ(scene.images.size(), 1U) << "decoded once, shared";
  EXPECT_EQ(scene.images[0].width, 2);
  EXPECT_EQ(scene.images[0].height, 1);
  EXPECT_EQ(scene.images[0].texels, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 255}));
  EXPECT_EQ(m.baseColorTexture.image, 0);
  EXPECT_EQ(m.baseColorTexture.uvSet, 1);
  EXPECT_EQ(m.baseColorTexture.wrapS, Wrap::Repeat);
  EXPECT_EQ(m.baseColorTexture.filter, Filter::Linear);
  EXPECT_EQ(m.metallicRoughnessTexture.uvSet, 0);
  EXPECT_EQ(m.emissionTexture.wrapS, Wrap::Clamp);
  EXPECT_EQ(m.emissionTexture.wrapT, Wrap::Mirror);
  EXPECT_EQ(m.emissionTexture.filter, Filter::Nearest);
  EXPECT_EQ(m.occlusionStrength, 0.5F);
  EXPECT_FALSE(m.normalTexture.used());
  ASSERT_EQ(scene.uv1.size(), 3U);
  EXPECT_EQ(scene.uv1[0], glm::vec2(0.5F, 0.5F));
  EXPECT_EQ(scene.uv0.size(), 3U);
  EXPECT_TRUE(scene.tangents.empty());
}

/// Only who wants texels where a texture is seen small gets them.
TEST(GltfMaterial, SamplersThatWantTexelsHaveNoLevels) {
  for (const auto& [code, hasLevels] :
       {std::pair{9728, false}, {9729, true}, {9984, true}, {9986, true}, {9987, true}}) {
    GltfBuilder b = textured({{"emissiveTexture", {{"index", 0}}}, {"normalTexture", {{"index", 1}}}});
    b.push("samplers", {{"minFilter", code}});
    b.push("textures", {{"source", 0}, {"sampler", 0}});
    const Material m = b.load().materials.at(0);
    EXPECT_TRUE(m.emissionTexture.hasLevels) << "no sampler";
    EXPECT_EQ(m.normalTexture.hasLevels, hasLevels) << code;
  }
}

TEST(GltfMaterial, TextureTransform) {
  const double quarter = std::numbers::pi / 2;
  GltfBuilder b = textured(
      {{"pbrMetallicRoughness",
        {{"baseColorTexture",
          {{"index", 0},
           {"extensions",
            {{"KHR_texture_transform",
              {{"offset", {0.5, 0.25}}, {"rotation", quarter}, {"scale", {2, 3}}, {"texCoord", 1}}}}}}}}}});
  const Scene scene = b.load();
  const TextureSlot& slot = scene.materials.at(0).baseColorTexture;
  EXPECT_EQ(slot.uvSet, 1) << "the transform's own texCoord wins";
  const auto apply = [&slot](float u, float v) {
    const auto& t = slot.transform;
    return glm::vec3(t[0] * u + t[1] * v + t[2], t[3] * u + t[4] * v + t[5], 0);
  };
  // Scale first; then a quarter turn counter-clockwise as seen with v downwards, u to -v and v to u;
  // then the offset.
  expectNear(apply(1, 0), {0.5F, 0.25F - 2, 0}, 1e-6F);
  expectNear(apply(0, 1), {0.5F + 3, 0.25F, 0}, 1e-6F);
  EXPECT_TRUE(scene.uv0.empty());
  EXPECT_EQ(scene.uv1.size(), 3U);
}

/// A texture glows in places: the rest would be black without the default lights.
TEST(GltfMaterial, WhatGlowsByATextureIsLitAsWell) {
  GltfBuilder b = textured({{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}});
  EXPECT_EQ(b.load().lights.size(), 3U);
}

/// A light would add highlights at most, and the radiance of what glows would no longer be what the file
/// says.
TEST(GltfMaterial, BlackBesideWhatGlowsNeedsNoLight) {
  const auto lightsWith = [](const std::vector<Json>& materials) {
    GltfBuilder b;
    for (const Json& material : materials)
      b.node({{"mesh", b.triangleMesh({{"material", b.material(material)}})}});
    return b.load().lights.size();
  };
  const Json black{{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 0}}}};
  const Json veil{{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 0.1}}}}};
  const Json dim{{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0.1, 0, 1}}}}};
  Json glowing = black;
  glowing["emissiveFactor"] = {1, 1, 1};
  EXPECT_EQ(lightsWith({glowing, veil, black}), 0U);
  EXPECT_EQ(lightsWith({glowing, dim}), 3U);
  EXPECT_EQ(lightsWith({black}), 3U) << "highlights are all that there is to see";
}

TEST(GltfMaterial, TexturesThatCannotBeReadLeaveTheFactor) {
  const Json material{
      {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"baseColorFactor", {0.5, 1, 1, 1}}}}};
  const auto loadWith = [&](auto&& change, const char* warning) {
    GltfBuilder b = textured(material);
    change(b.json);
    const Scene scene = b.load();
    EXPECT_FALSE(scene.materials.at(0).baseColorTexture.used());
    EXPECT_EQ(scene.materials.at(0).baseColor.r, 0.5F);
    EXPECT_TRUE(scene.uv0.empty());
    EXPECT_EQ(b.notices.warnings.size(), 1U);
    EXPECT_TRUE(mentions(b.notices.warnings, warning)) << b.notices.warnings.at(0);
  };
  loadWith([](Json& j) { j["images"][0] = {{"uri", "none.png"}}; }, "image 0");
  loadWith([](Json& j) { j["images"][0] = {{"uri", "data:image/png;base64,AAAA"}}; }, "image 0");
  loadWith([](Json& j) { j["images"][0] = {{"uri", "data:image/png;base64,*"}}; }, "cannot be decoded");
  loadWith([](Json& j) { j["images"][0] = {{"uri", "http://example.org/a.png"}}; }, "local files only");
  loadWith([](Json& j) { j["images"][0] = {{"name", "nothing"}}; }, "neither a uri nor a bufferView");
  loadWith([](Json& j) { j["bufferViews"][0]["byteOffset"] = 1 << 30; }, "reaches beyond");
  loadWith([](Json& j) { j["textures"][0] = Json::object(); }, "texture 0 has no image");
  loadWith(
      [](Json& j) {
        j["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
      },
      "KHR_texture_basisu");
  loadWith([](Json& j) { j["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 2; },
           "TEXCOORD_2");
}

TEST(GltfMaterial, ReferencesAreChecked) {
  const auto errorWith = [](auto&& change) {
    GltfBuilder b = textured({{"normalTexture", {{"index", 0}}}});
    change(b.json);
    return b.error();
  };
  EXPECT_NE(errorWith([](Json& j) {
              j["materials"][0]["normalTexture"]["index"] = 1;
            }).find("materials[0].normalTexture.index is 1, but there is 1 texture"),
            std::string::npos);
  EXPECT_NE(errorWith([](Json& j) { j["textures"][0]["source"] = 1; }).find("but there is 1 image"),
            std::string::npos);
  EXPECT_NE(errorWith([](Json& j) { j["textures"][0]["sampler"] = 0; }).find("but there are no samplers"),
            std::string::npos);
}

TEST(GltfMaterial, OnlyWhatIsUsedIsLoaded) {
  GltfBuilder b = textured({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  b.push("images", {{"uri", "none.png"}});
  b.push("textures", {{"source", 1}});
  b.material({{"emissiveTexture", {{"index", 1}}}});
  b.node({{"mesh", b.triangleMesh()}});
  const Scene scene = b.load();
  EXPECT_TRUE(b.notices.warnings.empty())
      << "the image that is missing belongs to a material that nothing has";
  ASSERT_EQ(scene.materials.size(), 2U);
  EXPECT_EQ(scene.triangles.at(0).material, 0U);
  EXPECT_EQ(scene.triangles.at(1).material, 1U) << "the default material";
  EXPECT_EQ(scene.materials[1].baseColor, glm::vec4(1));
}

}  // namespace
}  // namespace whittle
