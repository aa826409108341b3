// Where no surface sends out two impulses, one set of planes holds them.
#include "kernels/shared/layout.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

std::uint64_t bytesOf(const Stats& stats, const std::string& buffer) {
  for (const auto& b : stats.buffers)
    if (b.name == buffer) return b.bytes;
  return 0;
}

std::uint64_t bytesOfPlanes(const Stats& stats, std::uint64_t planes) {
  return 4 * (planes * static_cast<std::uint64_t>(stats.settings.wavefront) + QUEUE_PADDING);
}

std::uint64_t bytesOfSets(const Stats& stats, std::uint64_t sets) {
  return bytesOfPlanes(stats, sets * IMPULSE_PLANES);
}

/// Reflections and things seen through a sheet side by side, one at each hit.
Scene mirrorsAndSheets() {
  Scene scene;
  addFloor(scene, mirror({0.9F, 0.8F, 0.7F}), 0, true, 8);
  Material sheet = glass(1, false);
  sheet.specular = 0;
  sheet.baseColor = {0.5F, 0.9F, 0.7F, 1};
  Material veil = lambert({0.8F, 0.4F, 0.2F});
  veil.alphaMode = AlphaMode::Blend;
  veil.baseColor.a = 0.4F;
  veil.roughness = 1;
  const std::uint32_t sheets = addMaterial(scene, sheet), veils = addMaterial(scene, veil);
  for (int i = 0; i < 12; ++i)
    addQuad(scene, i % 2 ? sheets : veils,
            {0.4F * static_cast<float>(i) - 2.4F, 0.1F, -0.3F * static_cast<float>(i % 3)}, {0.3F, 0, 0},
            {0, 1.5F, 0.2F});
  addQuad(scene, addMaterial(scene, emitter({1, 2, 3})), {-4, 0, -4}, {8, 0, 0}, {0, 1, 0});
  scene.lights = {pointLight({1, 3, 2}, 12)};
  scene.background.radiance = {0.1F, 0.2F, 0.4F};
  Camera camera;
  camera.position = {0.2F, 1, 4};
  aim(camera, {0, -0.15, -1});
  scene.cameras = {camera};
  return scene;
}

/// Less than half the memory of whole kernels, which have room for colours that split, and their bits.
void expectOneSet(const Scene& scene, Settings settings, const std::string& name) {
  const RenderResult one = renderOnDevice(scene, settings);
  EXPECT_GT(one.stats.rays.impulse, 0U) << name;
  EXPECT_EQ(bytesOf(one.stats, "impulses"), bytesOfSets(one.stats, 1)) << name;
  settings.keepAllFeatures = true;
  settings.textureFilter = TextureFilter::None;  // no cones
  const RenderResult two = renderOnDevice(scene, settings);
  EXPECT_EQ(bytesOf(two.stats, "impulses"), bytesOfPlanes(two.stats, 2 * IMPULSE_PLANES + 2 * SPLIT_PLANES))
      << name;
  EXPECT_EQ(differingPixels(one.radiance, two.radiance), 0U) << name;
  EXPECT_EQ(one.stats.rays.total(), two.stats.rays.total()) << name;
}

TEST(ImpulsePlanes, OneSetWhereNoSurfaceSendsOutTwo) {
  expectOneSet(mirrorsAndSheets(), smallSettings(), "mirrors and sheets");
  Settings single = smallSettings();
  single.lanes = Lanes::One;
  expectOneSet(mirrorsAndSheets(), single, "one lane");
  for (const char* name : {"mirror", "mirror_box"}) expectOneSet(ownScene(name), smallSettings(), name);
}

TEST(ImpulsePlanes, OneSetWhereOneIsChosenAtRandom) {
  const Scene scene = ownScene("nested_glass");
  Settings settings = smallSettings();
  EXPECT_EQ(bytesOf(renderOnDevice(scene, settings).stats, "impulses"),
            bytesOfSets(renderOnDevice(scene, settings).stats, 2));
  settings.impulses = ImpulseMode::One;
  const RenderResult one = renderOnDevice(scene, settings);
  EXPECT_EQ(bytesOf(one.stats, "impulses"), bytesOfSets(one.stats, 1));
  EXPECT_EQ(one.stats.dropped, 0U);
}

}  // namespace
}  // namespace whittle::test
