// Layers and facets of materials: coats, sheen, films, brushed metal, colours that part, light from behind.
#include <gtest/gtest.h>

#include <numbers>

#include "gltf/material_files.h"

namespace whittle {
namespace {

using test::GltfBuilder;
using test::Json;
using test::materialOf;
using test::mentions;
using test::textured;

TEST(GltfMaterialLayers, AreRead) {
  const Material plain = materialOf(Json::object());
  EXPECT_EQ(plain.clearcoat, 0.0F);
  EXPECT_EQ(plain.sheenColor, glm::vec3(0));
  EXPECT_EQ(plain.iridescence, 0.0F);
  EXPECT_EQ(plain.iridescenceIor, 1.3F);
  EXPECT_EQ(plain.leastThickness, 100.0F);
  EXPECT_EQ(plain.mostThickness, 400.0F);
  EXPECT_EQ(plain.anisotropy, 0.0F);
  EXPECT_EQ(plain.dispersion, 0.0F);
  EXPECT_EQ(plain.diffuseTransmission, 0.0F);
  EXPECT_EQ(plain.diffuseTransmissionColor, glm::vec3(1));
  const Json slot = {{"index", 0}, {"texCoord", 1}};
  GltfBuilder b =
      textured({{"extensions",
                 {{"KHR_materials_clearcoat",
                   {{"clearcoatFactor", 0.5},
                    {"clearcoatTexture", slot},
                    {"clearcoatRoughnessFactor", 0.25},
                    {"clearcoatRoughnessTexture", slot},
                    {"clearcoatNormalTexture", {{"index", 0}, {"scale", 0.75}}}}},
                  {"KHR_materials_sheen",
                   {{"sheenColorFactor", {0.25, 0.5, 1}},
                    {"sheenColorTexture", slot},
                    {"sheenRoughnessFactor", 0.75},
                    {"sheenRoughnessTexture", slot}}},
                  {"KHR_materials_iridescence",
                   {{"iridescenceFactor", 1},
                    {"iridescenceTexture", slot},
                    {"iridescenceIor", 1.75},
                    {"iridescenceThicknessMinimum", 50},
                    {"iridescenceThicknessMaximum", 700},
                    {"iridescenceThicknessTexture", slot}}},
                  {"KHR_materials_anisotropy",
                   {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 2.5}, {"anisotropyTexture", slot}}},
                  {"KHR_materials_dispersion", {{"dispersion", 0.36}}},
                  {"KHR_materials_diffuse_transmission",
                   {{"diffuseTransmissionFactor", 0.25},
                    {"diffuseTransmissionTexture", slot},
                    {"diffuseTransmissionColorFactor", {1, 0.5, 0.25}},
                    {"diffuseTransmissionColorTexture", slot}}}}}});
  const Scene scene = b.load();
  EXPECT_TRUE(b.notices.warnings.empty());
  EXPECT_FALSE(mentions(b.notices.notes, "not read"));
  const Material& m = scene.materials.at(0);
  EXPECT_EQ(m.clearcoat, 0.5F);
  EXPECT_EQ(m.clearcoatRoughness, 0.25F);
  EXPECT_EQ(m.clearcoatNormalScale, 0.75F);
  EXPECT_EQ(m.sheenColor, glm::vec3(0.25F, 0.5F, 1));
  EXPECT_EQ(m.sheenRoughness, 0.75F);
  EXPECT_EQ(m.iridescence, 1.0F);
  EXPECT_EQ(m.iridescenceIor, 1.75F);
  EXPECT_EQ(m.leastThickness, 50.0F);
  EXPECT_EQ(m.mostThickness, 700.0F);
  EXPECT_EQ(m.anisotropy, 0.5F);
  EXPECT_EQ(m.anisotropyRotation, 2.5F);
  EXPECT_EQ(m.dispersion, 0.36F);
  EXPECT_EQ(m.diffuseTransmission, 0.25F);
  EXPECT_EQ(m.diffuseTransmissionColor, glm::vec3(1, 0.5F, 0.25F));
  for (const auto read :
       {&Material::clearcoatTexture, &Material::clearcoatRoughnessTexture, &Material::sheenColorTexture,
        &Material::sheenRoughnessTexture, &Material::iridescenceTexture,
        &Material::iridescenceThicknessTexture, &Material::anisotropyTexture,
        &Material::diffuseTransmissionTexture, &Material::diffuseTransmissionColorTexture}) {
    EXPECT_TRUE((m.*read).used());
    EXPECT_EQ((m.*read).uvSet, 1);
  }
  EXPECT_EQ(m.clearcoatNormalTexture.uvSet, 0);
  EXPECT_TRUE(m.clearcoatNormalTexture.used());
  EXPECT_FALSE(scene.tangents.empty()) << "coat and grain are laid along them";
}

}  // namespace
}  // namespace whittle
