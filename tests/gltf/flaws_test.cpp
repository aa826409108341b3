// One flaw in how things look does not refuse a file: it costs a warning and the property.
// Structure is strict.
#include <gtest/gtest.h>

#include "gltf/builder.h"

namespace whittle {
namespace {

using test::expectNear;
using test::GltfBuilder;
using test::Json;
using test::mentions;

/// A triangle with coordinates, material 0 and texture 0 with sampler 0.
GltfBuilder withSampler(const Json& material) {
  GltfBuilder b;
  const std::string png = test::pngBytes();
  b.push("images", {{"bufferView", b.view(std::vector<char>(png.begin(), png.end()))}});
  b.push("samplers", Json::object());
  b.push("textures", {{"source", 0}, {"sampler", 0}});
  b.material(material);
  b.node({{"mesh",
           b.triangleMesh({{"material", 0}, {"attributes", {{"TEXCOORD_0", b.vec2({0, 0, 1, 0, 0, 1})}}}})}});
  return b;
}

Json withTexture() { return {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}; }

/// Loads with exactly one warning, which has `part`.
Scene loadWarned(GltfBuilder& b, const std::string& part) {
  Scene scene = b.load();
  EXPECT_EQ(b.notices.warnings.size(), 1U) << part;
  EXPECT_TRUE(mentions(b.notices.warnings, part))
      << (b.notices.warnings.empty() ? "no warning" : b.notices.warnings[0]);
  return scene;
}

TEST(GltfFlaws, UnknownSamplerCodesMeanTheDefaults) {
  for (const char* key : {"wrapS", "wrapT", "magFilter", "minFilter"}) {
    for (const Json& code : {Json(33069), Json(0), Json(-1), Json(1.5), Json("REPEAT")}) {
      SCOPED_TRACE(std::string(key) + " " + code.dump());
      GltfBuilder b = withSampler(withTexture());
      b.json["samplers"][0] = {{key, code}};
      const TextureSlot slot =
          loadWarned(b, std::string("samplers[0].") + key).materials.at(0).baseColorTexture;
      EXPECT_TRUE(slot.used());
      EXPECT_EQ(slot.wrapS, Wrap::Repeat);
      EXPECT_EQ(slot.wrapT, Wrap::Repeat);
      EXPECT_EQ(slot.filter, Filter::Linear);
    }
  }
}

TEST(GltfFlaws, OneWarningForAFlawThatIsEverywhere) {
  GltfBuilder b = withSampler(withTexture());
  b.json["samplers"][0] = {{"wrapS", 33069}, {"wrapT", 33071}};
  for (int i = 0; i < 3; ++i) b.push("samplers", {{"wrapS", 33069}});
  const Scene scene = loadWarned(
      b, "samplers[0].wrapS has the unknown value 33069; read as if it were not there (and 3 more)");
  EXPECT_EQ(scene.materials.at(0).baseColorTexture.wrapT, Wrap::Clamp) << "the other code is right";
}

TEST(GltfFlaws, ColoursOfAnotherLength) {
  const auto material = [](const Json& json, const char* warning) {
    GltfBuilder b = withSampler(json);
    return loadWarned(b, warning).materials.at(0);
  };
  const auto baseColor = [&](const Json& value, const char* warning) {
    return material({{"pbrMetallicRoughness", {{"baseColorFactor", value}}}}, warning).baseColor;
  };
  EXPECT_EQ(baseColor({0.5, 0.25, 0.125}, "baseColorFactor must have 4 numbers, but has 3; the missing ones"),
            glm::vec4(0.5F, 0.25F, 0.125F, 1));
  EXPECT_EQ(baseColor({0.5, 0.25, 0.125, 0.5, 9}, "has 5; the first ones are used"),
            glm::vec4(0.5F, 0.25F, 0.125F, 0.5F));
  EXPECT_EQ(baseColor({0.5, 0.25}, "has 2; read as if it were not there"), glm::vec4(1));
  EXPECT_EQ(baseColor(Json::array(), "has 0; read as if it were not there"), glm::vec4(1));
  EXPECT_EQ(baseColor(0.5, "must be an array; read as if it were not there"), glm::vec4(1));
  EXPECT_EQ(baseColor({0.5, "x", 1, 1}, "baseColorFactor[1] must be a number"), glm::vec4(1));

  expectNear(material({{"emissiveFactor", {0.5, 0.25, 0.125, 1}}}, "has 4; the first ones").emission,
             {0.5F, 0.25F, 0.125F}, 0);
  expectNear(material({{"emissiveFactor", {0.5}}}, "has 1; read as if it were not there").emission, {0, 0, 0},
             0);
  const Json specular{{"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {1, 2}}}}};
  const Material m = material({{"extensions", specular}}, "specularColorFactor must have 3 numbers");
  expectNear(m.specularColor, {1, 1, 1}, 0);
  EXPECT_EQ(m.specular, 0.5F) << "the rest of the extension counts";

  const Json offset{{"KHR_texture_transform", {{"offset", {0.5, 0.25, 0}}, {"scale", {2}}}}};
  GltfBuilder b = withSampler({{"emissiveTexture", {{"index", 0}, {"extensions", offset}}}});
  const TextureSlot slot = b.load().materials.at(0).emissionTexture;
  EXPECT_EQ(slot.transform, (std::array<float, 6>{1, 0, 0.5F, 0, 1, 0.25F}));
  EXPECT_EQ(b.notices.warnings.size(), 2U);
}

TEST(GltfFlaws, ColoursOfLights) {
  const auto intensity = [](const Json& color) {
    GltfBuilder b = withSampler(Json::object());
    b.json["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::array({{{"type", "point"}, {"intensity", 2}, {"color", color}}});
    b.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    return loadWarned(b, "lights[0].color").lights.at(0).intensity;
  };
  expectNear(intensity({0.5, 0.25, 0.125, 1}), {1, 0.5F, 0.25F}, 0);
  expectNear(intensity({0.5, 0.25}), {2, 2, 2}, 0);
}

TEST(GltfFlaws, FactorsOfAnotherType) {
  GltfBuilder b = withSampler({{"doubleSided", 1},
                               {"alphaCutoff", "half"},
                               {"name", 5},
                               {"pbrMetallicRoughness", {{"metallicFactor", "0"}, {"roughnessFactor", 0.5}}},
                               {"extensions", {{"KHR_materials_ior", Json::array()}}}});
  const Material m = b.load().materials.at(0);
  EXPECT_FALSE(m.doubleSided);
  EXPECT_EQ(m.alphaCutoff, 0.5F);
  EXPECT_EQ(m.metallic, 1.0F);
  EXPECT_EQ(m.roughness, 0.5F);
  EXPECT_EQ(m.ior, 1.5F);
  EXPECT_EQ(b.notices.warnings.size(), 5U);
}

TEST(GltfFlaws, MinusOneMeansNone) {
  const auto loadWith = [](const char* place, const char* warning) {
    GltfBuilder b = withSampler({{"normalTexture", {{"index", 0}}}, {"emissiveFactor", {1, 0, 0}}});
    b.node({{"mesh", 0}});
    b.json[Json::json_pointer(place)] = -1;
    return loadWarned(b, warning);
  };
  EXPECT_EQ(loadWith("/meshes/0/primitives/0/material", "primitives[0].material must not be negative")
                .materials.at(0)
                .name,
            "default");
  EXPECT_EQ(loadWith("/nodes/1/mesh", "nodes[1].mesh").triangles.size(), 1U);
  EXPECT_EQ(loadWith("/nodes/0/camera", "nodes[0].camera").triangles.size(), 2U);
  EXPECT_EQ(loadWith("/nodes/0/skin", "nodes[0].skin").triangles.size(), 2U);
  EXPECT_EQ(loadWith("/meshes/0/primitives/0/indices", "indices").triangles.size(), 2U);
  EXPECT_EQ(loadWith("/scene", "scene").triangles.size(), 2U);
  EXPECT_TRUE(loadWith("/textures/0/sampler", "textures[0].sampler").materials.at(0).normalTexture.used());
  const Material m = loadWith("/materials/0/normalTexture/index", "normalTexture.index").materials.at(0);
  EXPECT_FALSE(m.normalTexture.used());
  EXPECT_EQ(m.emission, glm::vec3(1, 0, 0));
}

TEST(GltfFlaws, StructureIsStrict) {
  const auto errorWith = [](const char* place, const Json& value) {
    GltfBuilder b = withSampler(withTexture());
    b.node({{"mesh", 0}});
    b.json[Json::json_pointer(place)] = value;
    return b.error();
  };
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(errorWith("/accessors/0/bufferView", -1), "accessors[0].bufferView must not be negative");
  has(errorWith("/accessors/0/componentType", -1), "accessors[0].componentType");
  has(errorWith("/bufferViews/0/buffer", -1), "bufferViews[0].buffer");
  has(errorWith("/bufferViews/0/byteLength", "x"), "bufferViews[0].byteLength must be an integer");
  has(errorWith("/meshes/0/primitives/0/attributes/POSITION", -1), "POSITION must not be negative");
  has(errorWith("/nodes/0/translation", Json::array({1, 2})), "translation must have 3 numbers, but has 2");
  has(errorWith("/scenes/0/nodes/0", -1), "scenes[0].nodes[0]");
  has(errorWith("/meshes/0/primitives/0/material", 7), "material is 7, but there is 1 material");
}

}  // namespace
}  // namespace whittle
