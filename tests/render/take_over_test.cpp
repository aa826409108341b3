// General programs draw what a scene's own draw, to the bit, and its own take over before any batch.
#include "render/render_session.h"

#include <gtest/gtest.h>

#include "gltf/loader.h"
#include "scene/emitters.h"
#include "scene/input_error.h"
#include "support/pictures.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

RenderHooks onTier(Tier tier) {
  RenderHooks hooks = testHooks();
  hooks.tier = tier;
  return hooks;
}

/// Small queues, so that there are many batches.
Settings manyBatches(int raysPerPixel = 2) {
  Settings settings = smallSettings(4);
  settings.raysPerPixel = raysPerPixel;
  settings.wavefront = 1024;
  return settings;
}

std::size_t batchesOf(const RenderResult& result) { return stageOf(result.stats, "raygen").launches; }

/// Picture, rays and work of each stage.
void expectAlike(const RenderResult& a, const RenderResult& b, const std::string& what) {
  EXPECT_EQ(differingPixels(a.radiance, b.radiance), 0U) << what;
  for (const auto& [name, image] : a.aovs)
    EXPECT_EQ(differingPixels(image, b.aovs.at(name)), 0U) << what << ", " << name;
  EXPECT_EQ(a.stats.rays.primary, b.stats.rays.primary) << what;
  EXPECT_EQ(a.stats.rays.impulse, b.stats.rays.impulse) << what;
  EXPECT_EQ(a.stats.rays.shadow, b.stats.rays.shadow) << what;
  EXPECT_EQ(a.stats.ended.cutOff, b.stats.ended.cutOff) << what;
  EXPECT_EQ(a.stats.ended.bounces, b.stats.ended.bounces) << what;
  EXPECT_EQ(a.stats.nonFinite, b.stats.nonFinite) << what;
  EXPECT_EQ(b.stats.dropped, 0U) << what;
  ASSERT_EQ(a.stats.stages.size(), b.stats.stages.size()) << what;
  for (std::size_t i = 0; i < a.stats.stages.size(); ++i) {
    const StageStats &one = a.stats.stages[i], &two = b.stats.stages[i];
    EXPECT_EQ(one.launches, two.launches) << what << ", " << one.facts.name;
    EXPECT_EQ(one.items, two.items) << what << ", " << one.facts.name;
    EXPECT_EQ(one.bytes, two.bytes) << what << ", " << one.facts.name;
  }
}

TEST(GeneralTier, DrawsOwnScenesWithTheSameBits) {
  for (const std::string& name : ownScenes()) {
    const Scene scene = ownScene(name);
    const RenderResult own = renderOnDevice(scene, manyBatches());
    const RenderResult general = renderOnDevice(scene, manyBatches(), onTier(Tier::General));
    expectAlike(own, general, name);
    ASSERT_EQ(general.stats.programs.size(), 1U);
    EXPECT_TRUE(general.stats.programs[0].isGeneral);
    EXPECT_FALSE(own.stats.programs.at(0).isGeneral);
  }
}

/// What only some options ask for is compiled into the rich program, and does nothing for those that ask for
/// something else of it.
TEST(GeneralTier, DrawsWhatOptionsAskForWithTheSameBits) {
  const auto expectAlikeWith = [](const std::string& name, const std::string& what, auto&& change) {
    Scene scene = ownScene(name);
    Settings settings = manyBatches();
    change(settings);
    if (settings.areaLights) addSurfaceLight(scene);
    expectAlike(renderOnDevice(scene, settings), renderOnDevice(scene, settings, onTier(Tier::General)),
                name + ", " + what);
  };
  expectAlikeWith("cornell_box", "area lights", [](Settings& s) { s.areaLights = true; });
  expectAlikeWith("textured", "gloss", [](Settings& s) { s.glossy = true; });
  expectAlikeWith("spot_cone", "lights of some size", [](Settings& s) { s.lightRadius = 0.1F; });
  expectAlikeWith("shadow", "a cut-off", [](Settings& s) { s.cutoff = 0.05F; });
  expectAlikeWith("nested_glass", "a lens", [](Settings& s) { s.aperture = 0.05F, s.focusDistance = 3.0F; });
  expectAlikeWith("mirror_box", "auxiliary outputs", [](Settings& s) { s.aovs = true; });
}

/// A scene that needs as good as nothing: no normals, no textures, no lights, too few triangles for a tree.
TEST(GeneralTier, DrawsASceneWithoutAnythingWithTheSameBits) {
  Scene scene;
  addQuad(scene, addMaterial(scene, emitter({0.5F, 0.25F, 1})), {-1, 0, -1}, {2, 0, 0}, {0, 0, 2});
  Camera camera;
  camera.position = {0.1, 2, 0.2};
  aim(camera, {0, -1, 0.1});
  scene.cameras = {camera};
  const RenderResult own = renderOnDevice(scene, manyBatches());
  EXPECT_EQ(own.stats.searchUsed, "array");
  expectAlike(own, renderOnDevice(scene, manyBatches(), onTier(Tier::General)), "one quad");
}

TEST(GeneralTier, RefusesWhatNoGeneralProgramDoes) {
  Settings settings = manyBatches();
  settings.shadows = false;
  EXPECT_THROW(renderOnDevice(ownScene("mirror"), settings, onTier(Tier::General)), InputError);
  const RenderResult own = renderOnDevice(ownScene("mirror"), settings, onTier(Tier::Auto));
  EXPECT_FALSE(own.stats.programs.at(0).isGeneral);
}

/// At every batch there is, of pixels and of samples.
TEST(TakeOver, BeforeAnyBatchGivesTheSameBits) {
  for (const auto& [name, rays] : {std::pair("textured", 1), std::pair("nested_glass", 40)}) {
    const Scene scene = ownScene(name);
    Settings settings = manyBatches(rays);
    if (rays > 1) settings.width = 16, settings.height = 9;
    const RenderResult own = renderOnDevice(scene, settings);
    const std::size_t batches = batchesOf(own);
    ASSERT_GE(batches, 4U) << name;
    for (std::size_t batch = 0; batch < batches; ++batch) {
      RenderHooks hooks = onTier(Tier::General);
      hooks.takeOverBefore = static_cast<std::uint32_t>(batch);
      const RenderResult both = renderOnDevice(scene, settings, hooks);
      expectAlike(own, both, fmt::format("{} at batch {} of {}", name, batch, batches));
      ASSERT_EQ(both.stats.programs.size(), 2U);
      EXPECT_TRUE(both.stats.programs[0].isGeneral);
      EXPECT_FALSE(both.stats.programs[1].isGeneral);
      EXPECT_EQ(both.stats.programs[1].firstBatch, batch);
    }
  }
}

/// The scene stays on the device where its own programs draw the next picture, and a pixel can be explained.
TEST(TakeOver, ASessionGoesOnWithTheSceneThatItHas) {
  const Scene scene = ownScene("mirror_box");
  const Settings settings = onTestDevice(manyBatches());
  RenderSession session;
  const RenderResult general = session.render(scene, settings, onTier(Tier::General));
  const RenderResult own = session.render(scene, settings, testHooks());
  EXPECT_FALSE(session.work().scene || session.work().queues);
  expectAlike(own, general, "mirror_box");
  const auto after = session.explain(scene, settings, 48, 27, testHooks());
  const auto alone = RenderSession().explain(scene, settings, 48, 27, testHooks());
  ASSERT_EQ(after.size(), alone.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(after[i].radiance, alone[i].radiance);
    ASSERT_EQ(after[i].rays.size(), alone[i].rays.size());
  }
}

}  // namespace
}  // namespace whittle::test
