// Scenes with something needless of each kind: their pictures have the bits of the untrimmed ones.
#include <cmath>
#include <random>

#include "kernels/shared/layout.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

TextureSlot reading(int image) {
  TextureSlot slot;
  slot.image = image;
  return slot;
}

/// 8 × 8 noise with this alpha.
Image noise(std::uint8_t alpha) {
  std::mt19937 bits(7);
  Image image{"noise", 8, 8, {}};
  for (int i = 0; i < 64; ++i) {
    for (int c = 0; c < 3; ++c) image.texels.push_back(static_cast<std::uint8_t>(bits()));
    image.texels.push_back(alpha);
  }
  return image;
}

/// Two walls before a floor, seen from a little above, lit by a point light and a spot. Materials 0 to 2;
/// all of what vertices can carry.
Scene room() {
  Scene scene;
  addFloor(scene, lambert({0.5F, 0.6F, 0.7F}), 0, true, 4);
  addQuad(scene, addMaterial(scene, lambert({0.8F, 0.3F, 0.2F})), {-2, 0, -1.5F}, {2.1F, 0, 0.4F},
          {0, 1.8F, 0.1F});
  addQuad(scene, addMaterial(scene, lambert({0.2F, 0.4F, 0.9F})), {0.3F, 0, -0.2F}, {1.4F, 0, -0.5F},
          {0.1F, 1.3F, 0});
  scene.images = {noise(255), noise(255)};
  for (std::size_t i = 0; i < scene.positions.size(); ++i) {
    const float f = static_cast<float>(i);
    scene.uv0.emplace_back(0.37F * f, static_cast<float>(i % 3) * 1.3F);
    scene.normals.emplace_back(glm::normalize(glm::vec3(0.1F * std::sin(f), 1, 0.5F)));
  }
  scene.lights = {pointLight({1, 3, 2}, 30), pointLight({-2, 2.5F, 1}, 10)};
  scene.lights[1].kind = LightKind::Spot;
  scene.lights[1].direction = glm::normalize(glm::vec3(1, -1.2F, -1));
  Camera camera;
  camera.position = {0.3F, 1.5F, 4};
  aim(camera, {0, -0.2, -1});
  scene.cameras = {camera};
  scene.background.radiance = {0.1F, 0.2F, 0.3F};
  return scene;
}

/// Renders with and without trimming, expects the same picture and rays, and returns the trimmed one.
Stats expectSameBits(const Scene& scene) {
  Settings settings = smallSettings(4);
  const RenderResult trimmed = renderOnDevice(scene, settings);
  settings.keepAllFeatures = true;
  const RenderResult whole = renderOnDevice(scene, settings);
  EXPECT_EQ(differingPixels(trimmed.radiance, whole.radiance), 0U);
  EXPECT_EQ(trimmed.stats.rays.shadow, whole.stats.rays.shadow);
  EXPECT_EQ(trimmed.stats.rays.impulse, whole.stats.rays.impulse);
  EXPECT_GT(trimmed.stats.rays.shadow, 1000U) << "or there is little to compare";
  return trimmed.stats;
}

std::uint64_t bytesOf(const Stats& stats, const std::string& buffer) {
  for (const auto& b : stats.buffers)
    if (b.name == buffer) return b.bytes;
  return 0;
}

TEST(PrunedPictures, UnusedVertices) {
  Scene scene = room();
  scene.materials[0].baseColorTexture = reading(0);
  const std::uint64_t before = bytesOf(expectSameBits(scene), "uv0");
  // As many that nobody uses, in front of and behind those that are used.
  const auto count = static_cast<std::uint32_t>(scene.positions.size());
  const auto pad = [&](auto& values) {
    const auto copy = values;
    values.insert(values.begin(), copy.begin(), copy.end());
    values.insert(values.end(), copy.begin(), copy.end());
  };
  pad(scene.positions), pad(scene.normals), pad(scene.uv0);
  for (Triangle& t : scene.triangles) t.v0 += count, t.v1 += count, t.v2 += count;
  const Stats stats = expectSameBits(scene);
  EXPECT_EQ(bytesOf(stats, "uv0"), before);
  EXPECT_EQ(bytesOf(stats, "normals"), count * sizeof(glm::vec3));
  EXPECT_EQ(stats.pruning.vertices.unused, 2U * count);
}

TEST(PrunedPictures, MaterialsAndImagesAlike) {
  Scene scene = room();
  scene.materials[0].baseColorTexture = reading(0);
  scene.materials[1].baseColorTexture = reading(1);
  scene.materials[2] = scene.materials[1];
  scene.materials[2].name = "twin";
  scene.materials[2].baseColorTexture = reading(0);
  scene.materials.insert(scene.materials.begin(), lambert({1, 0, 1}));  // that no triangle has
  for (Triangle& t : scene.triangles) ++t.material;
  const Stats stats = expectSameBits(scene);
  EXPECT_EQ(stats.pruning.materials.kept(), 2U);
  EXPECT_EQ(bytesOf(stats, "texels"), (64U + 16 + 4 + 1) * 4) << "with its smaller levels";
  EXPECT_EQ(bytesOf(stats, "textures"), 56U) << "one slot";
}

TEST(PrunedPictures, TexturesThatAreMultipliedByNothing) {
  Scene scene = room();
  scene.materials[0].emissionTexture = scene.materials[0].specularTexture = reading(0);
  scene.materials[1].transmissionTexture = reading(1);
  scene.materials[2].unlit = true;
  scene.materials[2].metallicRoughnessTexture = reading(1);
  scene.materials[2].emission = {1, 2, 3};
  const Stats stats = expectSameBits(scene);
  EXPECT_EQ(bytesOf(stats, "texels"), 0U);
  EXPECT_FALSE(uses(stats, "texture"));
}

TEST(PrunedPictures, LightsThatReachNothing) {
  Scene scene = room();
  Light far = pointLight({0, 50, 0}, 1000), black = pointLight({0, 1, 0}, -3), past = scene.lights[1];
  far.range = 40;
  past.position = {0, 20, 0};
  past.direction = {0, 1, 0};
  Light shadowless = scene.lights[0];
  shadowless.castsShadows = false;
  shadowless.range = 5;
  scene.lights = {black, scene.lights[0], far, shadowless, past, scene.lights[1]};
  const Stats stats = expectSameBits(scene);
  EXPECT_EQ(stats.pruning.droppedLights.size(), 3U);
  EXPECT_EQ(bytesOf(stats, "lights"), 3U * sizeof(device::DeviceLight));
  EXPECT_EQ(stageOf(stats, "add_light").launches, stageOf(stats, "shade").launches);
}

/// A light whose range, or cone, ends just where the nearest surface begins lights nothing, kept or not.
TEST(PrunedPictures, LightsThatJustReach) {
  for (const float range : {0.999F, 0.99999F, 1.0F, 1.00001F, 1.001F, 1.1F}) {
    Scene scene = room();
    scene.lights.push_back(pointLight({5, 0, 0}, 100));
    scene.lights.back().range = range;
    expectSameBits(scene);
  }
  for (const float angle : {0.2F, 0.3F, 0.4F, 0.5F, 0.6F}) {
    Scene scene = room();
    Light& spot = scene.lights[1];
    spot.position = {0, 8, 12};
    spot.intensity = glm::vec3(1000);
    spot.direction = {0, std::sin(angle), -std::cos(angle)};
    spot.outerConeAngle = 0.4F;
    spot.innerConeAngle = 0.1F;
    expectSameBits(scene);
  }
}

TEST(PrunedPictures, NeedlessAlpha) {
  Scene scene = room();
  scene.materials[0].baseColorTexture = reading(0);
  scene.materials[0].alphaMode = AlphaMode::Blend;
  scene.materials[1].baseColorTexture = reading(1);
  scene.materials[1].alphaMode = AlphaMode::Mask;
  scene.materials[1].alphaCutoff = 1;
  scene.materials[2].alphaMode = AlphaMode::Blend;
  scene.materials[2].transmission = 0.25F;
  scene.materials[2].roughness = 0.1F;
  for (std::size_t i = 0; i < 2; ++i) scene.images[i] = noise(255);
  const Stats stats = expectSameBits(scene);
  EXPECT_EQ(stats.pruning.needlessBlends, 2U);
  EXPECT_EQ(stats.pruning.needlessMasks, 1U);
  EXPECT_FALSE(uses(stats, "mask"));
  EXPECT_FALSE(uses(stats, "blend"));
}

TEST(PrunedPictures, MasksNearTheirCutoff) {
  Scene scene = room();
  for (std::size_t i = 0; i < scene.positions.size(); ++i)
    scene.colors.emplace_back(1, 0.9F, 0.8F, 0.501F + 0.1F * static_cast<float>(i % 2));
  for (Material& m : scene.materials) m.alphaMode = AlphaMode::Mask;
  scene.materials[0].baseColor.a = 0.99F;
  scene.materials[1].baseColorTexture = reading(0);
  scene.images[0] = noise(254);
  const Stats stats = expectSameBits(scene);
  EXPECT_EQ(stats.pruning.needlessMasks, 1U) << "the third: the others fall short";
}

/// The room with colours whose alpha decides what is there, so that searches read vertices too.
Scene maskedRoom() {
  Scene scene = room();
  for (std::size_t i = 0; i < scene.positions.size(); ++i)
    scene.colors.emplace_back(1, 0.9F, 0.8F, 0.3F + 0.3F * static_cast<float>(i % 3));
  for (Material& m : scene.materials) m.alphaMode = AlphaMode::Mask;
  return scene;
}

/// `scene` with vertices of triangles behind the camera before its own, `count` of them in all. Black, and
/// with other normals.
Scene withVertices(Scene scene, std::size_t count) {
  const auto hidden = static_cast<std::uint32_t>(count - scene.positions.size());
  const auto put = [&](auto& values, const auto& value) { values.insert(values.begin(), hidden, value); };
  for (Triangle& t : scene.triangles) t.v0 += hidden, t.v1 += hidden, t.v2 += hidden;
  for (std::uint32_t i = 0; i < hidden; i += 3) {
    const std::uint32_t first = std::min(i, hidden - 3);
    scene.triangles.push_back({first, first + 1, first + 2, 0});
  }
  put(scene.positions, glm::vec3(0));
  for (std::uint32_t i = 0; i < hidden; ++i)
    scene.positions[i] = glm::vec3(i % 3, -1e-3F * static_cast<float>(i / 3), 50 + i % 2);
  put(scene.normals, glm::vec3(-1, 0, 0));
  put(scene.colors, glm::vec4(0, 0, 0, 1));
  put(scene.uv0, glm::vec2(0));
  return scene;
}

TEST(PrunedPictures, VertexIndicesAreAsWideAsTheyMustBe) {
  const auto bytesOfCorners = [](const Scene& scene, std::uint64_t each) {
    const std::uint64_t corners = 3 * (scene.triangles.size() + 1);  // and the one that nothing hits
    return (corners * each + 3) / 4 * 4;
  };
  Settings settings = smallSettings(4);
  const RenderResult few = renderOnDevice(maskedRoom(), settings);
  EXPECT_EQ(bytesOf(few.stats, "corners"), bytesOfCorners(maskedRoom(), 2));
  for (const std::size_t count : {std::size_t{65536}, std::size_t{65537}}) {
    const Scene scene = withVertices(maskedRoom(), count);
    for (const Lanes lanes : {Lanes::Auto, Lanes::One}) {
      settings.lanes = lanes;
      const RenderResult many = renderOnDevice(scene, settings);
      EXPECT_EQ(many.stats.pruning.vertices.kept(), count);
      EXPECT_EQ(bytesOf(many.stats, "corners"), bytesOfCorners(scene, count > 65536 ? 4 : 2)) << count;
      EXPECT_EQ(differingPixels(many.radiance, few.radiance), 0U) << count;
    }
    EXPECT_EQ(bytesOf(expectSameBits(scene), "corners"), bytesOfCorners(scene, count > 65536 ? 4 : 2));
  }
}

TEST(PrunedPictures, StatisticsSayWhatStaysOnTheHost) {
  Scene scene = room();
  scene.lights.push_back(pointLight({0, 1, 0}, 0));
  scene.lights.back().name = "off";
  const auto json = statsToJson(expectSameBits(scene))["features"]["trimmed"];
  EXPECT_EQ(json["materials"]["all"], 3);
  EXPECT_EQ(json["textures"]["unused"], 2);
  EXPECT_EQ(json["lights"]["kept"], 2);
  EXPECT_EQ(json["lights"]["dropped"][0]["name"], "off");
  EXPECT_EQ(json["lights"]["dropped"][0]["reason"], "gives no light");
  EXPECT_EQ(json["vertices"]["kept"], 12);
}

}  // namespace
}  // namespace whittle::test
