// Renders one after the other: the bits of single ones, and no work twice.
#include "render/render_session.h"

#include "support/pictures.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

Settings sessionSettings() {
  Settings settings = wholeSettings(4);
  settings.raysPerPixel = 4;
  return onTestDevice(settings);
}

TEST(RenderSession, GivesTheBitsOfSingleRenders) {
  RenderSession session;
  const Scene scene = ownScene("cornell_box");
  Settings settings = sessionSettings();
  const auto expectSame = [&](const Settings& s, const char* what) {
    const RenderResult kept = session.render(scene, s, testHooks());
    const RenderResult single = render(scene, s, testHooks());
    EXPECT_EQ(differingPixels(kept.radiance, single.radiance), 0U) << what;
    EXPECT_EQ(kept.stats.rays.total(), single.stats.rays.total()) << what;
    EXPECT_EQ(kept.stats.buffers.size(), single.stats.buffers.size()) << what;
  };
  expectSame(settings, "the first");
  EXPECT_TRUE(session.work().device && session.work().scene && session.work().queues &&
              session.work().picture);
  expectSame(settings, "the same again");
  EXPECT_FALSE(session.work().device || session.work().scene || session.work().queues ||
               session.work().picture);
  EXPECT_EQ(session.work().programs, 0);
  settings.width = 40, settings.height = 30;
  expectSame(settings, "another size");
  EXPECT_TRUE(session.work().picture);
  EXPECT_FALSE(session.work().scene);
  settings.wavefront = 1000;
  expectSame(settings, "another wavefront");
  EXPECT_TRUE(session.work().queues);
  EXPECT_FALSE(session.work().scene || session.work().picture);
  settings.shadows = false;
  expectSame(settings, "no shadows");
  EXPECT_FALSE(session.work().scene) << "the scene's buffers are the same";
  settings.bounces = 2;
  expectSame(settings, "fewer bounces");
  EXPECT_EQ(session.work().programs, 0);
  settings.search = Search::Array;
  expectSame(settings, "without a tree");
  EXPECT_TRUE(session.work().scene);
}

/// Texels and background stay on the device; the tree is that of the new places.
TEST(RenderSession, MovedMeshesHaveTheBitsOfASingleRender) {
  RenderSession session;
  Scene scene = ownScene("textured");
  const Settings settings = sessionSettings();
  const RenderResult before = session.render(scene, settings, testHooks());
  for (glm::vec3& p : scene.positions) p += glm::vec3(0.05F, 0.02F * p.x, 0);
  session.meshesMoved();
  const RenderResult moved = session.render(scene, settings, testHooks());
  EXPECT_TRUE(session.work().scene);
  EXPECT_EQ(session.work().texelReads, 0U);
  EXPECT_EQ(differingPixels(moved.radiance, render(scene, settings, testHooks()).radiance), 0U);
  EXPECT_GT(differingPixels(moved.radiance, before.radiance), 0U) << "or the test shows nothing";
  EXPECT_FALSE((session.render(scene, settings, testHooks()), session.work().scene)) << "once";
}

/// Of a device that can be divided, which PoCL's can: the platform itself reads its number of threads once.
TEST(RenderSession, AnotherNumberOfThreadsHoldsAtOnceAndChangesNoBit) {
  RenderSession session;
  const Scene scene = ownScene("cornell_box");
  Settings settings = sessionSettings();
  const RenderResult all = session.render(scene, settings, testHooks());
  if (all.stats.device.computeUnits < 2) GTEST_SKIP() << "one compute unit cannot be divided";
  settings.threads = 1;
  const RenderResult one = session.render(scene, settings, testHooks());
  EXPECT_TRUE(session.work().device) << "opened for as many";
  if (one.stats.device.computeUnits == all.stats.device.computeUnits)
    GTEST_SKIP() << "the driver does not divide " << one.stats.device.name;
  EXPECT_EQ(one.stats.device.computeUnits, 1U);
  EXPECT_EQ(differingPixels(one.radiance, all.radiance), 0U);
  settings.threads = 0;
  const RenderResult again = session.render(scene, settings, testHooks());
  EXPECT_EQ(again.stats.device.computeUnits, all.stats.device.computeUnits);
  EXPECT_EQ(differingPixels(again.radiance, all.radiance), 0U);
}

TEST(RenderSession, AnotherSceneIsUploadedWhenItIsSaid) {
  RenderSession session;
  const Settings settings = sessionSettings();
  for (const char* name : {"mirror", "cornell_box"}) {
    session.sceneChanged();
    const Scene scene = ownScene(name);
    EXPECT_EQ(differingPixels(session.render(scene, settings, testHooks()).radiance,
                              render(scene, settings, testHooks()).radiance),
              0U)
        << name;
  }
}

TEST(RenderSession, AnotherCameraCostsNothingAndShowsWhatItSees) {
  RenderSession session;
  Scene scene = ownScene("cornell_box");
  const Settings settings = sessionSettings();
  session.render(scene, settings, testHooks());
  Camera camera = scene.cameras[0];
  camera.position += glm::vec3(0.1F, 0.2F, -0.1F);
  RenderHooks hooks = testHooks();
  hooks.camera = &camera;
  const RenderResult moved = session.render(scene, settings, hooks);
  EXPECT_FALSE(session.work().scene || session.work().queues || session.work().picture);
  EXPECT_EQ(session.work().programs, 0);
  scene.cameras[0] = camera;
  EXPECT_EQ(differingPixels(moved.radiance, render(scene, settings, testHooks()).radiance), 0U);
}

/// One, then at least twice as many after each pass: few pictures on the way, each of which takes time.
TEST(RenderSession, PassesMultiplyTheSamplesAndTheLastIsTheResult) {
  RenderSession session;
  const Scene scene = ownScene("cornell_box");
  const Settings settings = sessionSettings();
  std::vector<double> samples;
  FloatImage last;
  RenderHooks hooks = testHooks();
  hooks.shown = [&](RenderResult result) {
    samples.push_back(result.stats.samples.mean);
    last = std::move(result.radiance);
  };
  const RenderResult whole = session.render(scene, settings, hooks);
  ASSERT_FALSE(samples.empty());
  EXPECT_EQ(samples.front(), 1);
  EXPECT_LT(samples.back(), settings.raysPerPixel) << "the last pass is the result, not shown before";
  EXPECT_EQ(whole.stats.samples.mean, settings.raysPerPixel);
  samples.push_back(whole.stats.samples.mean);
  for (std::size_t i = 1; i < samples.size(); ++i)
    EXPECT_GE(samples[i], std::min(2 * samples[i - 1], samples.back())) << i;
  EXPECT_GT(differingPixels(last, whole.radiance), 0U);
  EXPECT_EQ(differingPixels(whole.radiance, render(scene, settings, testHooks()).radiance), 0U);
}

/// As while a hand moves the camera: neither allocates what the other let go.
TEST(RenderSession, PreviewsAndPicturesTakeTurnsAndAllocateNothing) {
  RenderSession session;
  const Scene scene = ownScene("cornell_box");
  const Settings whole = sessionSettings();
  Settings small = whole;
  small.width /= 4, small.height /= 4;
  RenderHooks preview = testHooks();
  preview.isPreview = true;
  for (int turn = 0; turn < 2; ++turn) {
    const RenderResult picture = session.render(scene, whole, testHooks());
    if (turn > 0) {
      EXPECT_FALSE(session.work().queues || session.work().picture);
    }
    EXPECT_EQ(differingPixels(picture.radiance, render(scene, whole, testHooks()).radiance), 0U);
    const RenderResult first = session.render(scene, small, preview);
    if (turn > 0) {
      EXPECT_FALSE(session.work().queues || session.work().picture);
    }
    EXPECT_EQ(first.stats.samples.most, 1U) << "of " << small.raysPerPixel;
    EXPECT_EQ(first.radiance.width, small.width);
    EXPECT_EQ(first.stats.rays.primary, static_cast<std::uint64_t>(small.width) * small.height);
  }
}

TEST(RenderSession, EndsWhenItIsToldToAndGoesOnAsIfNothingHadBeen) {
  RenderSession session;
  const Scene scene = ownScene("cornell_box");
  Settings settings = sessionSettings();
  settings.wavefront = 600;  // many launches
  for (const int after : {0, 1, 5, 20}) {
    int asked = 0;
    RenderHooks hooks = testHooks();
    hooks.keepGoing = [&] { return asked++ < after; };
    const RenderResult cut = session.render(scene, settings, hooks);
    EXPECT_LT(cut.stats.samples.mean, 4) << after;
    EXPECT_EQ(differingPixels(session.render(scene, settings, testHooks()).radiance,
                              render(scene, settings, testHooks()).radiance),
              0U)
        << after;
  }
}

}  // namespace
}  // namespace whittle::test
