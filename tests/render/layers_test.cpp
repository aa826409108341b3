// Clear coat, sheen, iridescence and anisotropy on the device: the reference draws the same, with all that
// the rest of the renderer does to light, and nothing of them is there where no material asks.
#include "analysis/feature.h"
#include "support/agreement.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

Material clothUnderLacquer() {
  Material m = lambert({0.6F, 0.2F, 0.1F});
  m.specular = 1;
  m.sheenColor = {0.3F, 0.7F, 0.9F};
  m.sheenRoughness = 0.4F;
  return m;
}

Material lacquer(float roughness, float below) {
  Material m;
  m.baseColor = {0.7F, 0.3F, 0.2F, 1};
  m.metallic = 0.5F;
  m.roughness = below;
  m.clearcoat = 0.8F;
  m.clearcoatRoughness = roughness;
  return m;
}

Material soapy(float roughness, float metallic) {
  Material m = lacquer(0, roughness);
  m.clearcoat = 0;
  m.metallic = metallic;
  m.iridescence = 0.9F;
  m.iridescenceIor = 1.5F;
  m.mostThickness = 420;
  return m;
}

Material brushed(float roughness) {
  Material m = lacquer(0, roughness);
  m.clearcoat = 0;
  m.metallic = 1;
  m.anisotropy = 0.7F;
  m.anisotropyRotation = 0.4F;
  return m;
}

/// A floor of it that rolls a little, quads that it may show, a lamp, a background.
Scene stage(const Material& material) {
  Scene scene;
  addFloor(scene, material, 0, true, 4);
  scene.normals = {
      glm::normalize(glm::vec3(0.2F, 1, 0)), {0, 1, 0}, glm::normalize(glm::vec3(0, 1, 0.3F)), {0, 1, 0}};
  scene.tangents.assign(4, {1, 0, 0, 1});
  addQuad(scene, addMaterial(scene, emitter({1, 2, 3})), {-2, 0.5F, -2}, {1, 0, 0}, {0, 1.5F, 0});
  addQuad(scene, addMaterial(scene, lambert({0.2F, 0.8F, 0.4F})), {0.5F, 0, -2}, {1.5F, 0, 0.5F}, {0, 2, 0});
  scene.normals.resize(scene.positions.size(), glm::vec3(0));
  scene.tangents.resize(scene.positions.size(), glm::vec4(0));
  scene.lights = {pointLight({1, 3, 0.5F}, 25)};
  scene.background.radiance = {0.4F, 0.5F, 0.6F};
  Camera camera;
  camera.position = {0.3F, 1.5F, 4};
  aim(camera, {0, -0.35, -1});
  scene.cameras = {camera};
  return scene;
}

/// Two coats and two of what lies below, smooth and rough; the same of the others.
std::vector<std::pair<const char*, Material>> allKinds() {
  Material glassy = lacquer(0, 0);
  glassy.metallic = 0, glassy.transmission = 0.7F, glassy.doubleSided = true;
  Material veil = lacquer(0.1F, 0.1F);
  veil.alphaMode = AlphaMode::Blend, veil.baseColor.a = 0.6F;
  Material all = brushed(0.35F);
  all.metallic = 0.6F, all.clearcoat = 0.5F, all.clearcoatRoughness = 0.3F;
  all.sheenColor = {0.2F, 0.1F, 0.4F}, all.sheenRoughness = 0.6F, all.iridescence = 0.5F;
  return {{"smooth coat, smooth base", lacquer(0, 0)},
          {"smooth coat, rough base", lacquer(0, 0.5F)},
          {"rough coat, smooth base", lacquer(0.4F, 0)},
          {"rough coat, rough base", lacquer(0.4F, 0.6F)},
          {"coated pane", glassy},
          {"coated veil", veil},
          {"cloth", clothUnderLacquer()},
          {"soapy mirror", soapy(0, 0)},
          {"soapy paint", soapy(0.4F, 0.3F)},
          {"brushed", brushed(0.4F)},
          {"all together", all}};
}

Settings withEverything(Settings settings) {
  for (const Feature f :
       {Feature::CLEARCOAT, Feature::SHEEN, Feature::IRIDESCENCE, Feature::ANISOTROPY, Feature::MICROFACET,
        Feature::MIRROR, Feature::TRANSMISSION, Feature::METAL, Feature::ALPHA_BLEND, Feature::BOTH_BRANCHES})
    settings.keepFeatures |= bitOf(f);  // one program for all
  return settings;
}

TEST(Layers, AgreeWithTheReference) {
  for (const auto& [name, material] : allKinds()) {
    Settings settings = withEverything(smallSettings(4));
    settings.ambient = 0.1F;
    expectAgreement(compareWithReference(stage(material), settings), name, 1);
  }
}

TEST(Layers, AgreeWithTheReferenceWhereRoughSurfacesReflect) {
  for (const auto& [name, material] : allKinds()) {
    Settings settings = withEverything(smallSettings(3));
    settings.glossy = true;
    settings.raysPerPixel = 4;
    expectAgreement(compareWithReference(stage(material), settings), name, 1);
  }
}

/// Maps of their own turn the normal of the surface and that of its coat, which so reflect two ways.
TEST(Layers, AgreeWithTheReferenceWithNormalMaps) {
  for (const float below : {0.0F, 0.5F}) {
    Material m = lacquer(0, below);
    m.clearcoatNormalTexture.image = 0;
    m.clearcoatNormalScale = 0.7F;
    m.normalTexture.image = 1;
    Scene scene = stage(m);
    scene.images = {{"", 2, 1, {140, 120, 250, 255, 118, 140, 250, 255}},
                    {"", 1, 2, {128, 140, 250, 255, 128, 110, 250, 255}}};
    scene.uv0.assign(scene.positions.size(), glm::vec2(0));
    scene.uv0[1] = {0, 3}, scene.uv0[2] = {3, 3}, scene.uv0[3] = {3, 0};
    const Agreement agreement = compareWithReference(scene, smallSettings(3));
    expectAgreement(agreement, "normal maps", 1);
    EXPECT_GT(agreement.kernel.stats.rays.impulse, 0U);
  }
}

/// What leaves a feature out changes no bit, and one that is not used is left out.
TEST(Layers, AreLeftOutWhereNoMaterialAsks) {
  Material plain = lacquer(0, 0.4F);
  plain.clearcoat = 0;
  const RenderResult without = renderOnDevice(stage(plain), smallSettings(3));
  for (const char* words : {"clear coats", "sheen", "iridescence", "anisotropy"})
    EXPECT_FALSE(uses(without.stats, words)) << words;
  const RenderResult with = renderOnDevice(stage(plain), withEverything(smallSettings(3)));
  EXPECT_TRUE(uses(with.stats, "sheen"));
  EXPECT_EQ(differingPixels(without.radiance, with.radiance), 0U);
}

TEST(Layers, GiveTheSameBitsForEachNumberOfLanes) {
  const Scene scene = stage(allKinds().back().second);
  Settings settings = smallSettings(3);
  settings.glossy = true;
  const RenderResult eight = renderOnDevice(scene, settings);
  settings.lanes = Lanes::One;
  EXPECT_EQ(differingPixels(eight.radiance, renderOnDevice(scene, settings).radiance), 0U);
}

/// One bounce more than the coat and what lies below it need: each sample is one unit of light.
TEST(Layers, ReflectAWhiteSkyWhole) {
  Scene scene;
  Material m = mirror(glm::vec3(1));
  m.clearcoat = 1;
  addFloor(scene, m, 0);
  scene.background.radiance = glm::vec3(1);
  for (const double slope : {10.0, 0.7, 0.05}) {
    const glm::vec3 seen = shot(scene, {0, 1, 0}, {1, -slope, 0}, 3);
    EXPECT_NEAR(seen.x, 1, 1e-6) << slope;
  }
}

}  // namespace
}  // namespace whittle::test
