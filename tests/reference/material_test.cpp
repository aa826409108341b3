// Alpha, emission, unlit surfaces, vertex colours and normals, normal maps.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/probe.h"

namespace whittle::test {
namespace {

using Rgba = std::array<std::uint8_t, 4>;

TextureSlot addImage(Scene& scene, int width, int height, const std::vector<Rgba>& texels) {
  Image image{"", width, height, {}};
  for (const Rgba& t : texels) image.texels.insert(image.texels.end(), t.begin(), t.end());
  scene.images.push_back(image);
  TextureSlot slot;
  slot.image = static_cast<int>(scene.images.size()) - 1;
  return slot;
}

/// `material` at y = 1 with u along x and v along z over [-1, 1]², over a green emitter.
Scene overGreen(Scene scene, const Material& material) {
  const std::uint32_t m = addMaterial(scene, material);
  addQuad(scene, m, {-1, 1, -1}, {0, 0, 2}, {2, 0, 0});
  scene.uv0 = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  addFloor(scene, emitter({0, 1, 0}), 0);
  scene.uv0.resize(scene.positions.size(), glm::vec2(0));
  return scene;
}

Vec3 down(Probe& probe, double x, double z) { return probe.Li({x, 2, z}, {0, -1, 0}); }

TEST(Alpha, MaskCutsAtTheCutoff) {
  for (const auto& [factor, visible] : {std::pair{0.5F, true}, {0.49F, false}, {1.0F, true}}) {
    Material m = emitter({1, 0, 0});
    m.alphaMode = AlphaMode::Mask;
    m.baseColor.a = factor;
    Probe probe(overGreen({}, m));
    EXPECT_EQ(down(probe, 0.3, 0.2), visible ? Vec3(1, 0, 0) : Vec3(0, 1, 0)) << factor;
    EXPECT_EQ(probe.rays.impulse, 0) << "a hole costs no ray";
  }
}

TEST(Alpha, MaskReadsTheTexture) {
  Scene scene;
  Material m = emitter({1, 0, 0});
  m.alphaMode = AlphaMode::Mask;
  m.baseColorTexture = addImage(scene, 2, 1, {{255, 255, 255, 0}, {255, 255, 255, 255}});
  m.baseColorTexture.filter = Filter::Nearest;
  Probe probe(overGreen(scene, m));
  EXPECT_EQ(down(probe, -0.5, 0.1), Vec3(0, 1, 0));
  EXPECT_EQ(down(probe, 0.5, 0.1), Vec3(1, 0, 0));
}

TEST(Alpha, MaskedHolesCastNoShadow) {
  Material m = lambert(glm::vec3(1));
  m.alphaMode = AlphaMode::Mask;
  for (const float alpha : {0.0F, 1.0F}) {
    m.baseColor.a = alpha;
    Scene scene;
    addFloor(scene, lambert(glm::vec3(1)), 0);
    addFloor(scene, m, 1);
    scene.lights.push_back(pointLight({0, 2, 0}, 4));
    Probe probe(scene);
    EXPECT_NEAR(probe.Li({0, 0.5, 0}, {0, -1, 0}).x, alpha > 0 ? 0 : 1 / std::numbers::pi, 1e-12);
  }
}

TEST(Alpha, BlendMixesWithWhatIsBehind) {
  Material m = emitter({1, 0, 0});
  m.alphaMode = AlphaMode::Blend;
  m.baseColor.a = 0.25F;
  Probe probe(overGreen({}, m));
  EXPECT_EQ(down(probe, 0.3, 0.2), Vec3(0.25, 0.75, 0));
  EXPECT_EQ(probe.rays.impulse, 1);
  probe.settings().bounces = 1;
  EXPECT_EQ(down(probe, 0.3, 0.2), Vec3(0.25, 0.75, 0)) << "the ray straight on is no bounce";
  probe.settings().transparentBounces = 0;
  EXPECT_EQ(down(probe, 0.3, 0.2), Vec3(0.25, 0, 0)) << "but has a limit of its own";
}

TEST(Alpha, ABlendedSheetOfGlassSendsTwoRays) {
  Material m = glass(1.5F, false);
  m.alphaMode = AlphaMode::Blend;
  m.baseColor.a = 0.5F;
  Probe probe(overGreen({}, m));
  EXPECT_NEAR(down(probe, 0.3, 0.2).y, 0.5 + 0.5 * 0.96, 1e-14);
  EXPECT_EQ(probe.rays.impulse, 2) << "straight with the transmission, and the reflection";
}

TEST(Alpha, ABlendedSolidLeavesItsReflectionOut) {
  Material m = glass(1.5F, true);
  m.alphaMode = AlphaMode::Blend;
  m.baseColor.a = 0.5F;
  Probe probe(overGreen({}, m));
  const Ray ray{Vec3(0.3, 2, 0.2), Vec3(0, -1, 0)};
  const auto impulses = reference::impulsesOf(*probe.surfelAlong(ray), -ray.direction);
  ASSERT_EQ(impulses.count, 2);
  EXPECT_TRUE(impulses.items[0].through && impulses.items[1].through);
  EXPECT_NEAR(impulses.items[0].magnitude.x, 0.5, 1e-15);
  EXPECT_NEAR(impulses.items[1].magnitude.x, 0.5 * 0.96, 1e-15);
}

TEST(Surface, UnlitShowsItsColour) {
  Material m = lambert({0.25F, 0.5F, 0.75F});
  m.unlit = true;
  m.emission = glm::vec3(9);
  m.roughness = 0;
  m.transmission = 1;
  Scene scene = overGreen({}, m);
  scene.lights.push_back(pointLight({0, 2, 0}, 4));
  Probe probe(scene);
  EXPECT_EQ(down(probe, 0.3, 0.2), Vec3(0.25, 0.5, 0.75));
  EXPECT_EQ(probe.rays.total(), 0);
}

TEST(Surface, OnlyTheFrontEmitsUnlessDoubleSided) {
  for (const bool doubleSided : {false, true}) {
    Material m = emitter({1, 2, 3});
    m.doubleSided = doubleSided;
    Scene scene;
    addFloor(scene, m, 0);
    Probe probe(scene);
    EXPECT_EQ(probe.Li({0, 1, 0}, {0, -1, 0}), Vec3(1, 2, 3));
    EXPECT_EQ(probe.Li({0, -1, 0}, {0, 1, 0}), doubleSided ? Vec3(1, 2, 3) : Vec3(0));
  }
}

TEST(Surface, VertexColoursAreInterpolated) {
  Material m = lambert({0.5F, 1, 1});
  m.unlit = true;
  Scene scene = overGreen({}, m);
  scene.colors.assign(scene.positions.size(), glm::vec4(1));
  for (const int left : {0, 1}) scene.colors[left] = {0, 0.5F, 1, 1};  // x = -1
  Probe probe(scene);
  const Vec3 seen = down(probe, 0.5, 0.25);  // three quarters of the way
  EXPECT_NEAR(seen.x, 0.375, 1e-14);
  EXPECT_NEAR(seen.y, 0.875, 1e-14);
  EXPECT_NEAR(seen.z, 1, 1e-14);
}

TEST(Surface, InterpolatedNormalsTiltTheCosine) {
  Scene scene = overGreen({}, lambert(glm::vec3(1)));
  scene.normals.assign(scene.positions.size(), glm::vec3(0.6F, 0.8F, 0));
  Light sun;
  sun.kind = LightKind::Directional;
  sun.direction = {0, -1, 0};
  scene.lights.push_back(sun);
  Probe probe(scene);
  const double length = glm::length(Vec3(0.6F, 0.8F, 0));
  EXPECT_NEAR(down(probe, 0.3, 0.2).x, 0.8F / length / std::numbers::pi, 1e-14);
  EXPECT_NEAR(probe.surfelAlong({Vec3(0, 1.5, 0), Vec3(0, -1, 0)})->facing.y, 1, 1e-15);
}

TEST(Surface, LightFromBehindTheTriangleDoesNotCount) {
  Scene scene = overGreen({}, lambert(glm::vec3(1)));
  scene.normals.assign(scene.positions.size(), glm::vec3(0.6F, 0.8F, 0));
  scene.lights = {pointLight({2, 0.9F, 0}, 1)};  // below y = 1, yet on the side of the shading normal
  Probe probe(scene);
  probe.settings().shadows = false;
  probe.settings().smoothTerminator = false;  // else its shadow ray decides
  EXPECT_EQ(down(probe, 0, 0), Vec3(0));
}

TEST(Surface, ANormalSeenFromBehindGivesWay) {
  Scene scene = overGreen({}, lambert(glm::vec3(1)));
  scene.normals.assign(scene.positions.size(), glm::vec3(1, 0, 0));
  Probe probe(scene);
  const Vec3 w = glm::normalize(Vec3(1, -1, 0));
  EXPECT_EQ(probe.surfelAlong({Vec3(-0.5, 1.5, 0), w})->n, Vec3(0, 1, 0));
  EXPECT_EQ(probe.surfelAlong({Vec3(0.5, 1.5, 0), Vec3(-w.x, w.y, 0)})->n, Vec3(1, 0, 0));
}

TEST(Surface, NormalMapsTiltAlongTheTangents) {
  Scene scene;
  Material m = lambert(glm::vec3(1));
  m.normalTexture = addImage(scene, 1, 1, {{255, 204, 255, 255}});  // 1, 0.6, 1
  m.normalScale = 0.5F;
  m.doubleSided = true;
  scene = overGreen(scene, m);
  // Tangent along x; n × T = −z, so that w = −1 makes the bitangent +z.
  scene.tangents.assign(scene.positions.size(), glm::vec4(1, 0, 0, -1));
  const Ray ray{Vec3(0.3, 2, 0.2), Vec3(0, -1, 0)}, from{Vec3(0.3, 0.5, 0.2), Vec3(0, 1, 0)};
  const Vec3 expected = glm::normalize(Vec3(0.5, 1, 0.3));
  Probe probe(scene);
  EXPECT_NEAR(glm::length(probe.surfelAlong(ray)->n - expected), 0, 1e-14);
  EXPECT_NEAR(glm::length(probe.surfelAlong(from)->n + expected), 0, 1e-14) << "turned over on the back";
  scene.tangents.assign(scene.positions.size(), glm::vec4(0, 0, 0, 1));
  EXPECT_EQ(Probe(scene).surfelAlong(ray)->n, Vec3(0, 1, 0)) << "no tangent, no map";
}

TEST(Surface, ASmoothOneOfIorZeroKeepsItsFresnel) {
  Material m = lambert(glm::vec3(1));
  m.roughness = 0;
  m.ior = 0;
  m.specular = 1;
  m.specularColor = {0.25F, 0.5F, 0};
  Scene scene;
  scene.background.radiance = glm::vec3(1);
  addFloor(scene, m, 0);
  Probe probe(scene);
  // At 60° the mirror shows mix(k, 1, (1 − 1/2)⁵) of a white sky.
  const Vec3 seen = probe.Li({0, 1, 0}, {std::sqrt(3.0), -1, 0});
  EXPECT_NEAR(seen.x, 0.25 + 0.75 / 32, 1e-14);
  EXPECT_NEAR(seen.y, 0.5 + 0.5 / 32, 1e-14);
  EXPECT_NEAR(seen.z, 1.0 / 32, 1e-14);
}

TEST(Surface, TheRayOffsetScalesWithTheCoordinates) {
  Scene scene;
  const std::uint32_t m = addMaterial(scene, lambert(glm::vec3(1)));
  addQuad(scene, m, {-300, 2, -400}, {0, 0, 1000}, {1000, 0, 0});
  const Ray ray{Vec3(699, 3, -100), Vec3(0, -1, 0)};
  const auto rayOffset = [&](const Settings& settings) {
    return Probe(scene, settings).surfelAlong(ray)->rayOffset;
  };
  EXPECT_LE(rayOffset(Settings{}), 700 * 0x1p-20);
  EXPECT_GE(rayOffset(Settings{}), 699 * 0x1p-20);
  Settings fixed;
  fixed.rayOffset = 0.125F;
  EXPECT_EQ(rayOffset(fixed), 0.125);
}

TEST(Surface, TexturesReachTheirSlots) {
  Scene scene;
  Material m;
  m.transmissionTexture = m.specularTexture = m.metallicRoughnessTexture =
      addImage(scene, 1, 1, {{51, 102, 153, 204}});  // 0.2, 0.4, 0.6, 0.8
  m.transmission = 1;
  Probe probe(overGreen(scene, m));
  const auto surfel = probe.surfelAlong({Vec3(0.3, 2, 0.2), Vec3(0, -1, 0)});
  EXPECT_NEAR(surfel->transmission, 0.2, 1e-15);
  EXPECT_NEAR(surfel->roughness, 0.4, 1e-15);
  EXPECT_NEAR(surfel->metallic, 0.6, 1e-15);
  EXPECT_NEAR(surfel->fresnel.f90.x, 0.8, 1e-15);
}

}  // namespace
}  // namespace whittle::test
