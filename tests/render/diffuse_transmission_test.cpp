// Light from behind a surface (KHR_materials_diffuse_transmission): in closed form, the same from kernels and
// reference with every kind of light, and nothing of it where no material asks.
#include <cmath>
#include <numbers>

#include "analysis/feature.h"
#include "support/agreement.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

const glm::vec3 kFront{0.6F, 0.2F, 0.1F}, kThrough{0.9F, 0.7F, 0.3F};

Material leafOf(float share) {
  Material m = lambert(kFront);
  m.doubleSided = true;
  m.diffuseTransmission = share;
  m.diffuseTransmissionColor = kThrough;
  return m;
}

Scene flatLeaf(const Material& material) {
  Scene scene;
  addFloor(scene, material, 0, true, 4);
  return scene;
}

/// Of light of the unit that a lamp 2 m below brings aslant, and of light from above.
TEST(DiffuseTransmission, ShowsALampBehindASheetAsColourTimesShareTimesCosineOverPi) {
  const float share = 0.4F;
  for (const bool behind : {false, true}) {
    Scene scene = flatLeaf(leafOf(share));
    scene.lights = {pointLight({1, behind ? -2.0F : 2.0F, 0}, 10)};
    const double irradiance = 10 / 5.0 * (2 / std::sqrt(5.0));
    const glm::vec3 color = behind ? share * kThrough : (1 - share) * kFront;
    for (const double side : {1.0, -1.0}) {  // of the viewer: the sheet has two alike
      scene.lights[0].position.y = static_cast<float>(side) * (behind ? -2.0F : 2.0F);
      const glm::vec3 seen = shot(scene, {0, side, 0}, {0, -side, 0}, 1);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(seen[c], static_cast<double>(color[c]) * irradiance / std::numbers::pi, 1e-6) << behind;
    }
  }
}

TEST(DiffuseTransmission, IsShadowedOnTheSideOfTheLight) {
  Scene scene = flatLeaf(leafOf(0.5F));
  scene.lights = {pointLight({0, -2, 0}, 10)};
  const glm::vec3 lit = shot(scene, {0, 1, 0}, {0, -1, 0}, 1);
  EXPECT_GT(lit.x, 0);
  addQuad(scene, addMaterial(scene, lambert(glm::vec3(1))), {-1, 0.5F, -1}, {2, 0, 0}, {0, 0, 2});
  EXPECT_GT(shot(scene, {0, 0.4, 0}, {0, -1, 0}, 1).x, 0) << "a blocker on the viewer's side takes nothing";
  addQuad(scene, 1, {-1, -0.5F, -1}, {2, 0, 0}, {0, 0, 2});
  EXPECT_EQ(shot(scene, {0, 0.4, 0}, {0, -1, 0}, 1), glm::vec3(0));
}

/// What a sheet sends out in a uniform surrounding: the share that is reflected and the other that comes
/// through. A dielectric of no reflectance, so that Lambert's part is all.
TEST(DiffuseTransmission, SharesTheLightOfAUniformSkyBetweenTheSides) {
  for (const float share : {0.0F, 0.3F, 1.0F}) {
    Scene scene = flatLeaf(leafOf(share));
    scene.background.radiance = glm::vec3(2);
    Light sky;
    sky.kind = LightKind::Sky;
    sky.intensity = glm::vec3(1);
    Scene lit = scene;
    lit.lights = {sky};
    Settings ambient = smallSettings(1);
    ambient.ambient = 2;
    scene.cameras = lit.cameras = {Camera{}};
    scene.cameras[0].position = lit.cameras[0].position = {0, 1, 0};
    aim(scene.cameras[0], {0, -1, 0});
    aim(lit.cameras[0], {0, -1, 0});
    ambient.width = ambient.height = 2;
    const glm::vec3 fromSky = colorOf(renderOnDevice(lit,
                                                     [&] {
                                                       Settings s = ambient;
                                                       s.ambient.reset();
                                                       return s;
                                                     }())),
                    fromAmbient = colorOf(renderOnDevice(scene, ambient));
    for (int c = 0; c < 3; ++c) {
      const float expected = 2 * ((1 - share) * kFront[c] + share * kThrough[c]);
      EXPECT_NEAR(fromSky[c], expected, 1e-5F) << share;
      EXPECT_NEAR(fromAmbient[c], expected, 1e-5F) << share;
    }
  }
}

/// A curved sheet with lamps on both sides, a glowing quad and a sky.
Scene leafStage(const Material& material, bool curved) {
  Scene scene = flatLeaf(material);
  if (curved)
    scene.normals = {
        glm::normalize(glm::vec3(0.2F, 1, 0)), {0, 1, 0}, glm::normalize(glm::vec3(0, 1, 0.3F)), {0, 1, 0}};
  addQuad(scene, addMaterial(scene, emitter({3, 2, 1})), {-2, -1.5F, -2}, {0, 0, 1.5F}, {1.5F, 0, 0});
  addQuad(scene, addMaterial(scene, lambert({0.2F, 0.8F, 0.4F})), {0.5F, -0.8F, -1}, {1.5F, 0, 0.5F},
          {0, 0.4F, 1});
  if (curved) scene.normals.resize(scene.positions.size(), glm::vec3(0));
  Light spot = pointLight({-1, -2, 0.5F}, 20), sun = pointLight({0, 0, 0}, 1);
  spot.kind = LightKind::Spot, spot.direction = glm::normalize(glm::vec3(0.4F, 1, -0.2F));
  spot.innerConeAngle = 0.3F, spot.outerConeAngle = 0.9F;
  sun.kind = LightKind::Directional, sun.direction = glm::normalize(glm::vec3(0.2F, 1, 0.3F));
  scene.lights = {pointLight({1, 2, 0.5F}, 15), pointLight({1, -2, -0.5F}, 15), spot, sun};
  scene.background.radiance = {0.4F, 0.5F, 0.6F};
  Camera camera;
  camera.position = {0.3F, 1.5F, 4};
  aim(camera, {0, -0.35, -1});
  scene.cameras = {camera};
  return scene;
}

std::vector<std::pair<const char*, Material>> kindsOfLeaf() {
  Material smooth = leafOf(0.4F), rough = leafOf(0.7F), pane = leafOf(0.6F), layered = leafOf(0.5F),
           cut = leafOf(0.5F);
  smooth.roughness = 0, smooth.specular = 1;
  rough.roughness = 0.5F, rough.specular = 1, rough.metallic = 0.3F;
  pane.transmission = 0.5F, pane.roughness = 0, pane.specular = 1;
  layered.clearcoat = 0.8F, layered.clearcoatRoughness = 0.3F, layered.sheenColor = {0.3F, 0.7F, 0.9F};
  layered.sheenRoughness = 0.4F, layered.iridescence = 0.5F, layered.specular = 1;
  cut.alphaMode = AlphaMode::Blend, cut.baseColor.a = 0.6F;
  return {{"matte", leafOf(0.5F)}, {"smooth", smooth},   {"rough", rough},
          {"pane", pane},          {"layered", layered}, {"blended", cut}};
}

Settings oneProgramOfLeaves(Settings settings) {
  settings.keepFeatures = bitOf(Feature::CLEARCOAT) | bitOf(Feature::SHEEN) | bitOf(Feature::IRIDESCENCE) |
                          bitOf(Feature::METAL) | bitOf(Feature::MIRROR) | bitOf(Feature::TRANSMISSION) |
                          bitOf(Feature::ALPHA_BLEND) | bitOf(Feature::BOTH_BRANCHES) |
                          bitOf(Feature::MICROFACET) | bitOf(Feature::FILTERED_SHADOWS);
  return settings;
}

TEST(DiffuseTransmission, AgreesWithTheReference) {
  for (const auto& [name, material] : kindsOfLeaf()) {
    Settings settings = oneProgramOfLeaves(smallSettings(3));
    settings.ambient = 0.1F;
    const Agreement agreement = compareWithReference(leafStage(material, true), settings);
    expectAgreement(agreement, name, 4);
    EXPECT_TRUE(uses(agreement.kernel.stats, "diffuse transmission")) << name;
  }
}

/// Lights of some size, surfaces that glow and a sky, each of which is met on both sides.
TEST(DiffuseTransmission, AgreesWithTheReferenceWithLightsThatAreSampled) {
  for (const LightKind kind : {LightKind::Surface, LightKind::Sky, LightKind::Point}) {
    Scene scene = leafStage(leafOf(0.5F), false);
    if (kind != LightKind::Point) {
      Light light = pointLight({0, 0, 0}, 1);
      light.kind = kind;
      scene.lights = {light};
    }
    Settings settings = smallSettings(2);
    settings.raysPerPixel = 4;
    if (kind == LightKind::Point) settings.lightRadius = 0.2F;
    expectAgreement(compareWithReference(scene, settings), std::string(typeOf(kind).word), 12);
  }
}

/// A quarter circle of few facets seen from inside, lit from outside at grazing angles, where a facet's plane
/// would cast shadows on its neighbours.
TEST(DiffuseTransmission, AgreesWithTheReferenceWhereSurfacesAreCurved) {
  Scene scene;
  const std::uint32_t m = addMaterial(scene, leafOf(0.5F));
  constexpr int kFacets = 6;
  for (int i = 0; i <= kFacets; ++i) {
    const float angle = static_cast<float>(std::numbers::pi * i / kFacets);
    for (const float z : {-2.0F, 2.0F}) {
      scene.positions.push_back({2 * std::cos(angle), 2 * std::sin(angle), z});
      scene.normals.push_back({std::cos(angle), std::sin(angle), 0});
    }
  }
  for (std::uint32_t i = 0; i < kFacets; ++i) {
    scene.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1, m});
    scene.triangles.push_back({2 * i + 1, 2 * i + 2, 2 * i + 3, m});
  }
  scene.lights = {pointLight({6, 3, 0}, 60), pointLight({0, 0.5F, 1}, 3)};
  Camera camera;
  camera.position = {0, 0.3F, 6};
  aim(camera, {0, 0.1, -1});
  scene.cameras = {camera};
  const Agreement agreement = compareWithReference(scene, smallSettings(1));
  expectAgreement(agreement, "curved", 4);
  EXPECT_TRUE(uses(agreement.kernel.stats, "smooth terminator"));
}

TEST(DiffuseTransmission, IsLeftOutWhereNoMaterialAsks) {
  const RenderResult without = renderOnDevice(leafStage(leafOf(0), true), smallSettings(3));
  EXPECT_FALSE(uses(without.stats, "diffuse transmission"));
  Settings kept = smallSettings(3);
  kept.keepFeatures = bitOf(Feature::DIFFUSE_TRANSMISSION);
  const RenderResult with = renderOnDevice(leafStage(leafOf(0), true), kept);
  EXPECT_TRUE(uses(with.stats, "diffuse transmission"));
  EXPECT_EQ(differingPixels(without.radiance, with.radiance), 0U);
  EXPECT_EQ(without.stats.rays.total(), with.stats.rays.total());
}

TEST(DiffuseTransmission, GivesTheSameBitsForEachNumberOfLanes) {
  Settings settings = smallSettings(2);
  const RenderResult eight = renderOnDevice(leafStage(leafOf(0.5F), true), settings);
  settings.lanes = Lanes::One;
  EXPECT_EQ(differingPixels(eight.radiance, renderOnDevice(leafStage(leafOf(0.5F), true), settings).radiance),
            0U);
}

}  // namespace
}  // namespace whittle::test
