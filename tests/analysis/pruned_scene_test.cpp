// What stays on the host: each rule on a scene that it fits, and on one that misses it by a hair.
#include "analysis/pruned_scene.h"

#include <cmath>
#include <limits>

#include "support/single_rays.h"

namespace whittle::test {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

/// A square from (-1, 0, -1) to (1, 0, 1) for each of these materials.
Scene squares(const std::vector<Material>& materials) {
  Scene scene;
  for (const Material& m : materials) addFloor(scene, m, 0, true, 1);
  return scene;
}

PrunedScene used(const Scene& scene, bool aovs = false) {
  Settings settings;
  settings.aovs = aovs;
  return pruneScene(scene, settings);
}

Image image(int width, int height, std::vector<std::uint8_t> texels) {
  return {"", width, height, std::move(texels)};
}

Image opaqueImage() { return image(2, 1, {10, 20, 30, 255, 40, 50, 60, 255}); }

TextureSlot reading(int imageIndex) {
  TextureSlot slot;
  slot.image = imageIndex;
  return slot;
}

/// How many materials a scene with these two needs.
std::size_t keptOf(const Material& a, const Material& b, bool aovs = false) {
  Scene scene = squares({a, b});
  scene.images = {opaqueImage()};
  return used(scene, aovs).materials.size();
}

TEST(SceneUseMaterials, ThoseWithoutATriangleGo) {
  Scene scene = squares({lambert({1, 0, 0}), lambert({0, 1, 0}), lambert({0, 0, 1})});
  for (Triangle& t : scene.triangles)
    if (t.material == 1) t.material = 2;
  const PrunedScene pruned = used(scene);
  EXPECT_EQ(pruned.materialOf, (std::vector<std::uint32_t>{0, kNotUsed, 1}));
  EXPECT_EQ(pruned.materials.at(1).baseColor, glm::vec4(0, 0, 1, 1));
  EXPECT_EQ(pruned.pruning.materials.unused, 1U);
  EXPECT_EQ(pruned.pruning.materials.kept(), 2U);
}

TEST(SceneUseMaterials, AlikeInEveryBitBecomeOne) {
  const Material plain = lambert({0.5F, 0.5F, 0.5F});
  Material other = plain;
  other.name = "another name";
  other.occlusionStrength = 0.25F;
  other.occlusionTexture = reading(0);
  other.alphaCutoff = 0.1F;  // of a mode that does not cut
  other.emissionTexture = reading(0);
  other.normalScale = 3;
  other.sigma_a = {1, 2, 3};  // of no volume
  EXPECT_EQ(keptOf(plain, other), 1U);
  Material pane = plain, twoSided = plain;
  pane.transmission = twoSided.transmission = 0.5F;  // both sides are seen in any case, and none emits
  twoSided.doubleSided = true;
  EXPECT_EQ(keptOf(pane, twoSided), 1U);
  twoSided.transmission = pane.transmission = 0;
  EXPECT_EQ(keptOf(pane, twoSided), 2U) << "one hides its back";
  other.roughness = std::nextafter(plain.roughness, 2.0F);
  EXPECT_EQ(keptOf(plain, other), 2U);
}

TEST(SceneUseMaterials, WhatShowsKeepsThemApart) {
  const auto apart = [](const Material& base, auto change) {
    Material other = base;
    change(other);
    return keptOf(base, other) == 2;
  };
  const Material glow = [] {
    Material m = lambert({0.5F, 0.5F, 0.5F});
    m.emission = {1, 1, 1};
    m.alphaMode = AlphaMode::Mask;
    m.baseColor.a = 0.25F;
    m.normalTexture = reading(0);
    return m;
  }();
  EXPECT_TRUE(apart(glow, [](Material& m) { m.doubleSided = true; }));
  EXPECT_TRUE(apart(glow, [](Material& m) { m.emissionTexture = reading(0); }));
  EXPECT_TRUE(apart(glow, [](Material& m) { m.alphaCutoff = 0.75F; }));
  EXPECT_TRUE(apart(glow, [](Material& m) { m.normalScale = 0.5F; }));
  EXPECT_TRUE(apart(glow, [](Material& m) { m.normalTexture.transform[2] = 0.5F; }));
  EXPECT_TRUE(apart(glow, [](Material& m) { m.volume = true; }));
  EXPECT_TRUE(apart(glow, [](Material& m) { m.ior = 1.25F; }));
}

TEST(SceneUseMaterials, UnlitOnesShowTheirColourOnly) {
  Material unlit = lambert({0.5F, 0.5F, 0.5F}), other = unlit;
  unlit.unlit = other.unlit = true;
  other.roughness = 0.125F;
  other.emission = {1, 1, 1};
  other.transmission = 0.5F;
  other.normalTexture = reading(0);
  EXPECT_EQ(keptOf(unlit, other), 1U);
  EXPECT_EQ(keptOf(unlit, other, true), 2U) << "the normal is an auxiliary output";
  other.baseColor.g = std::nextafter(0.5F, 1.0F);
  EXPECT_EQ(keptOf(unlit, other), 2U);
}

/// Two materials with a base colour texture each.
PrunedScene withImages(const Image& a, const Image& b) {
  Material first = lambert(glm::vec3(1)), second = lambert(glm::vec3(0.5F));
  first.baseColorTexture = reading(0);
  second.baseColorTexture = reading(1);
  Scene scene = squares({first, second});
  scene.images = {a, b};
  return used(scene);
}

TEST(SceneUseImages, EqualOnesAreStoredOnce) {
  const PrunedScene pruned = withImages(opaqueImage(), opaqueImage());
  EXPECT_EQ(pruned.images, std::vector<std::uint32_t>{0});
  EXPECT_EQ(pruned.materials.at(1).baseColorTexture.image, 0);
  EXPECT_EQ(pruned.pruning.images.alike, 1U);
}

TEST(SceneUseImages, OneTexelOrTheSizeKeepsThemApart) {
  Image other = opaqueImage();
  other.texels.back() ^= 1;
  EXPECT_EQ(withImages(opaqueImage(), other).images.size(), 2U);
  EXPECT_EQ(withImages(opaqueImage(), image(1, 2, opaqueImage().texels)).images.size(), 2U);
}

TEST(SceneUseImages, ThoseThatNobodyReadsGo) {
  Material m = lambert(glm::vec3(1));
  m.occlusionTexture = reading(0);
  m.emissionTexture = reading(1);      // times an emission of 0
  m.transmissionTexture = reading(2);  // likewise
  m.normalTexture = reading(3);
  Material unused = m;
  unused.baseColorTexture = reading(4);
  Scene scene = squares({m});
  addMaterial(scene, unused);
  for (std::uint8_t i = 0; i < 5; ++i) scene.images.push_back(image(1, 1, {i, i, i, 255}));
  const PrunedScene pruned = used(scene);
  EXPECT_EQ(pruned.images, std::vector<std::uint32_t>{3});
  EXPECT_EQ(pruned.materials.at(0).normalTexture.image, 0);
  EXPECT_EQ(pruned.pruning.images.unused, 4U);
  scene.materials[0].emission.b = 1e-30F;
  EXPECT_EQ(used(scene).images, (std::vector<std::uint32_t>{3, 1}));
}

TEST(SceneUseVertices, OnlyUnusedOnesMakeATable) {
  Scene scene = squares({lambert(glm::vec3(1))});
  scene.normals.assign(scene.positions.size(), glm::vec3(0, 1, 0));
  EXPECT_TRUE(used(scene).vertexOf.empty());
  EXPECT_EQ(used(scene).vertexCount, 4U);
  scene.positions.insert(scene.positions.begin(), glm::vec3(9));
  scene.normals.insert(scene.normals.begin(), glm::vec3(1, 0, 0));
  for (Triangle& t : scene.triangles) ++t.v0, ++t.v1, ++t.v2;
  const PrunedScene pruned = used(scene);
  EXPECT_EQ(pruned.vertexOf, (std::vector<std::uint32_t>{kNotUsed, 0, 1, 2, 3}));
  EXPECT_EQ(pruned.vertexCount, 4U);
  scene.normals.clear();
  EXPECT_TRUE(used(scene).vertexOf.empty()) << "positions go with their triangles";
}

TEST(SceneUseVertices, ThoseInUseDecideHowWideTheirIndicesAre) {
  Scene scene = squares({lambert(glm::vec3(1))});
  scene.positions.resize(65537);
  scene.normals.assign(scene.positions.size(), glm::vec3(0, 1, 0));
  for (std::uint32_t v = 4; v < 65536; v += 3)
    scene.triangles.push_back({v, v + 1, std::min(v + 2, 65535U), 0});
  EXPECT_EQ(used(scene).vertexCount, 65536U);
  EXPECT_TRUE(used(scene).narrowCorners) << "one is not used";
  EXPECT_FALSE(unprunedScene(scene).narrowCorners);
  scene.triangles[0].v0 = 65536;
  scene.triangles[1].v0 = 65536;
  EXPECT_TRUE(used(scene).narrowCorners) << "now it is, and vertex 0 is not";
  scene.triangles[1].v0 = 0;
  EXPECT_EQ(used(scene).vertexCount, 65537U);
  EXPECT_FALSE(used(scene).narrowCorners);
}

/// Why the only light of a floor of [-1, 1]² at height 0 is left out; "" where it stays.
std::string darkBecause(const Light& light, const Material& floor = lambert(glm::vec3(1))) {
  Scene scene = squares({floor});
  scene.lights = {light};
  const PrunedScene pruned = used(scene);
  EXPECT_EQ(pruned.lights.size() + pruned.pruning.droppedLights.size(), 1U);
  return pruned.lights.empty() ? pruned.pruning.droppedLights[0].reason : "";
}

TEST(SceneUseLights, BlackOnesGoAndStrangeOnesStay) {
  Light light = pointLight({0, 1, 0}, 0);
  EXPECT_EQ(darkBecause(light), "gives no light");
  light.intensity = {0, -1, 0};
  EXPECT_EQ(darkBecause(light), "gives no light");
  light.intensity = {-1, 1e-40F, -1};
  EXPECT_EQ(darkBecause(light), "");
  for (const float strange : {std::nanf(""), kInf, -kInf}) {
    light.intensity = {0, strange, 0};
    EXPECT_EQ(darkBecause(light), "") << strange;
  }
}

TEST(SceneUseLights, ARangeThatEndsBeforeTheBoxReachesNothing) {
  Light light = pointLight({0, 8, 0}, 1);
  light.range = 7.99F;
  EXPECT_EQ(darkBecause(light), "out of range of every triangle");
  for (const float range : {7.99995F, 8.0F, 8.001F, kInf, std::nanf("")}) {
    light.range = range;
    EXPECT_EQ(darkBecause(light), "") << range;
  }
  light.kind = LightKind::Directional;  // reaches everywhere
  light.range = 1;
  EXPECT_EQ(darkBecause(light), "");
}

TEST(SceneUseLights, AConeThatMissesTheBallReachesNothing) {
  // The ball about the floor, of radius sqrt(2), is seen from 10 m above under asin(sqrt(2)/10)
  // on either side.
  Light light = pointLight({0, 10, 0}, 1);
  light.kind = LightKind::Spot;
  light.outerConeAngle = 0.5F;
  const float touching = std::asin(std::sqrt(2.0F) / 10) + light.outerConeAngle;
  const auto tilted = [&](float angle) {
    light.direction = {std::sin(angle), -std::cos(angle), 0};
    return darkBecause(light);
  };
  EXPECT_EQ(tilted(touching + 1e-3F), "shines past every triangle");
  EXPECT_EQ(tilted(touching - 1e-5F), "");
  EXPECT_EQ(tilted(0), "");
  EXPECT_EQ(tilted(3.14159F), "shines past every triangle");
  light.direction = {0, 2, 0};  // the kernel's angle is another then
  EXPECT_EQ(darkBecause(light), "");
  light.direction = {0, 1, 0};
  light.position = {0, 1, 0};  // inside the ball
  EXPECT_EQ(darkBecause(light), "");
}

TEST(SceneUseLights, NoneIsNeededWhereNothingIsLit) {
  Material unlit = lambert(glm::vec3(1));
  unlit.unlit = true;
  Light light = pointLight({0, 1, 0}, 1);
  EXPECT_EQ(darkBecause(light, unlit), "no surface answers to light");
  light.kind = LightKind::Directional;
  EXPECT_EQ(darkBecause(light, unlit), "no surface answers to light");
  EXPECT_EQ(darkBecause(light), "");
}

TEST(SceneUseLights, OrderAndNamesAreKept) {
  Scene scene = squares({lambert(glm::vec3(1))});
  for (const float intensity : {1.0F, 0.0F, 2.0F, 3.0F})
    scene.lights.push_back(pointLight({0, intensity, 0}, intensity));
  scene.lights[1].name = "burnt out";
  const PrunedScene pruned = used(scene);
  EXPECT_EQ(pruned.lights, (std::vector<std::uint32_t>{0, 2, 3}));
  ASSERT_EQ(pruned.pruning.droppedLights.size(), 1U);
  EXPECT_EQ(pruned.pruning.droppedLights[0].index, 1U);
  EXPECT_EQ(pruned.pruning.droppedLights[0].name, "burnt out");
}

Material alpha(AlphaMode mode, float factor, bool textured = false) {
  Material m = lambert(glm::vec3(1));
  m.alphaMode = mode;
  m.baseColor.a = factor;
  if (textured) m.baseColorTexture = reading(0);
  return m;
}

/// The mode on the device of a floor with this material, texture and alpha of its vertices.
AlphaMode modeOf(const Material& m, const Image& texture = opaqueImage(),
                 const std::vector<float>& vertices = {}) {
  Scene scene = squares({m});
  scene.images = {texture};
  for (const float a : vertices) scene.colors.emplace_back(1, 1, 1, a);
  return used(scene).materials.at(0).alphaMode;
}

TEST(SceneUseAlpha, AMaskThatCutsNothingOutIsOpaque) {
  Material m = alpha(AlphaMode::Mask, 0.5F);
  EXPECT_EQ(modeOf(m), AlphaMode::Opaque) << "at the cutoff";
  m.alphaCutoff = std::nextafter(0.5F, 1.0F);
  EXPECT_EQ(modeOf(m), AlphaMode::Mask);
  m = alpha(AlphaMode::Mask, 1, true);
  m.alphaCutoff = 1;
  EXPECT_EQ(modeOf(m), AlphaMode::Opaque) << "texels of 255 are 1";
  m.alphaCutoff = 0.5F;
  EXPECT_EQ(modeOf(m, image(2, 1, {0, 0, 0, 128, 0, 0, 0, 255})), AlphaMode::Opaque);
  EXPECT_EQ(modeOf(m, image(2, 1, {0, 0, 0, 127, 0, 0, 0, 255})), AlphaMode::Mask);
  EXPECT_EQ(modeOf(m, image(2, 1, {0, 0, 0, 255, 0, 0, 0, 0})), AlphaMode::Mask);
  EXPECT_EQ(modeOf(alpha(AlphaMode::Mask, std::nanf(""))), AlphaMode::Mask);
}

TEST(SceneUseAlpha, VertexColoursCountWithAMargin) {
  const Material m = alpha(AlphaMode::Mask, 1);
  EXPECT_EQ(modeOf(m, opaqueImage(), {1, 1, 1, 0.51F}), AlphaMode::Opaque);
  EXPECT_EQ(modeOf(m, opaqueImage(), {1, 1, 1, 0.5F}), AlphaMode::Mask)
      << "interpolation may fall short of it";
  EXPECT_EQ(modeOf(m, opaqueImage(), {1, 1, 1, 0.1F}), AlphaMode::Mask);
  EXPECT_EQ(modeOf(m, opaqueImage(), {1, 1, 1, std::nanf("")}), AlphaMode::Mask);
  EXPECT_EQ(modeOf(m, opaqueImage(), {1, 1, 1, kInf}), AlphaMode::Mask);
  EXPECT_EQ(modeOf(m, opaqueImage(), {1, 1, 1, 1e6F}), AlphaMode::Mask) << "a weight of -1e-7 makes it less";
}

TEST(SceneUseAlpha, ABlendIsOpaqueOnlyWhereItsAlphaIsExactlyOne) {
  EXPECT_EQ(modeOf(alpha(AlphaMode::Blend, 1)), AlphaMode::Opaque);
  EXPECT_EQ(modeOf(alpha(AlphaMode::Blend, std::nextafter(1.0F, 0.0F))), AlphaMode::Blend);
  EXPECT_EQ(modeOf(alpha(AlphaMode::Blend, 1, true)), AlphaMode::Opaque);
  EXPECT_EQ(modeOf(alpha(AlphaMode::Blend, 1, true), image(2, 1, {0, 0, 0, 255, 0, 0, 0, 254})),
            AlphaMode::Blend);
  EXPECT_EQ(modeOf(alpha(AlphaMode::Blend, 1), opaqueImage(), {1, 1, 1, 1}), AlphaMode::Blend)
      << "weights do not add up to 1 exactly";
}

TEST(PrunedScene, KeepAllFeaturesKeepsEverything) {
  Scene scene = squares({alpha(AlphaMode::Blend, 1), alpha(AlphaMode::Blend, 1)});
  addMaterial(scene, lambert(glm::vec3(1)));
  scene.images = {opaqueImage(), opaqueImage()};
  scene.positions.emplace_back(0);
  scene.normals.assign(scene.positions.size(), glm::vec3(0, 1, 0));
  scene.lights = {pointLight({0, 1, 0}, 0)};
  Settings settings;
  settings.keepAllFeatures = true;
  const PrunedScene pruned = pruneScene(scene, settings);
  EXPECT_EQ(pruned.materialOf, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(pruned.materials.at(0).alphaMode, AlphaMode::Blend);
  EXPECT_EQ(pruned.images.size(), 2U);
  EXPECT_EQ(pruned.lights.size(), 1U);
  EXPECT_TRUE(pruned.vertexOf.empty());
  EXPECT_EQ(used(scene).materials.size(), 1U);
}

}  // namespace
}  // namespace whittle::test
