// Lights and materials edited in a window, and the copies of files that it writes.
#include <chrono>
#include <fstream>
#include <thread>

#include "window_fixture.h"

namespace whittle::test {
namespace {

class WindowEditTest : public WindowTest {
 protected:
  /// The .png of `whittle render` of this file, with the settings of the window.
  Codes rendered(const std::string& file) {
    std::vector<std::string> args{"render", file, "-o", "render.png", "--quiet"};
    args.insert(args.end(), kSmall.begin(), kSmall.end());
    const Outcome run = runWhittle(args, {folder_.path(), {}});
    EXPECT_EQ(run.status, 0) << run.err;
    return read("render.png");
  }
};

TEST_F(WindowEditTest, WhatIsSavedIsRenderedAsItWasShown) {
  expectPlayed(
      "wait refined\nset light.0.intensity 2\nset light.0.color 1,0.3,0.1\nset light.1.position 0.4,0.5,0.2\n"
      "set material.1.base-color 0.1,0.2,0.9\nset material.4.roughness 0.4\nset material.5.transmission 0.5\n"
      "set material.0.metallic 0.5\nset material.3.emission 1,2,3\nwait refined\nkey Ctrl+S\nwait 0.2\n"
      "save-scene copy.glb\nsave-scene copy.glb\n");
  const Codes window = read("cornell_box-001.png"), picture = rendered("copy.glb");
  EXPECT_EQ(window.bytes, picture.bytes);
  EXPECT_NE(window.bytes, rendered(scene("cornell_box.glb")).bytes);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "copy-2.glb"));
}

/// Where lights shine, and how much a pane covers.
TEST_F(WindowEditTest, DirectionsAndAlphaAreSavedAsTheyWereShown) {
  const auto expectSaved = [&](const std::string& name, const std::string& edits) {
    const std::string file = scene(name + ".glb");
    expectPlayed(
        "wait refined\n" + edits + "wait refined\nkey Ctrl+S\nwait 0.2\nsave-scene " + name + "-copy.glb\n",
        kSmall, file);
    const Codes window = read(name + "-001.png");
    EXPECT_EQ(window.bytes, rendered(name + "-copy.glb").bytes) << name;
    EXPECT_NE(window.bytes, rendered(file).bytes) << name;
  };
  expectSaved("spot_cone", "set light.0.elevation -80\nset light.1.azimuth 70\nset light.2.elevation -90\n");
  expectSaved("textured", "set material.3.alpha 0.9\nset material.4.alpha 0\n");
}

TEST_F(WindowEditTest, WhatChangesIsUploadedAndNoMore) {
  expectPlayed(
      "wait refined\nset light.0.intensity 2\nwait refined\nexpect view.lights == 1\nexpect view.scene == 0\n"
      "expect view.materials == 0\nexpect view.triangles == 0\nexpect view.programs == 0\n"
      "set material.1.base-color 0.1,0.2,0.9\nwait refined\nexpect view.materials == 1\nexpect view.lights "
      "== 0\n"
      "expect view.scene == 0\nset background-strength 2\nset background-rotation 20\nwait refined\n"
      "expect view.scene == 0\nexpect view.lights == 0\nexpect view.materials == 0\n"
      "expect stats.settings.backgroundStrength == 2\n");
}

TEST_F(WindowEditTest, NeedsFollowAndAreSaid) {
  const Outcome run = play(
      "wait refined\nprint stats.features.used\nset material.5.transmission 0\nwait refined\nprint "
      "view.message\n"
      "print stats.features.used\nkey Ctrl+Z\nwait refined\nprint view.message\nset light.0.on off\n"
      "set light.1.on off\nwait refined\nexpect stats.rays.shadow == 0\n");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto left = run.out.find("are now left out"), needed = run.out.find("are now needed");
  ASSERT_TRUE(left != std::string::npos && needed != std::string::npos) << run.out;
  EXPECT_NE(run.out.substr(left - 100, 100).find("refraction"), std::string::npos) << run.out;
  EXPECT_NE(run.out.substr(needed - 100, 100).find("refraction"), std::string::npos) << run.out;
}

TEST_F(WindowEditTest, AHandleIsDraggedAndUndone) {
  const Outcome before = play("wait refined\nprint edit.light.0.x\nprint edit.light.0.y\n");
  const double x = 160 * printed(before, "edit.light.0.x"), y = 90 * printed(before, "edit.light.0.y");
  ASSERT_TRUE(x > 0 && x < 160 && y > 0 && y < 90) << before.out;
  const std::string drag = fmt::format("drag {0} {1} {2} {1}\n", x, y, x + 16);
  const Outcome run =
      play("wait refined\nkey x\n" + drag +
           "wait refined\nprint edit.light.0.x\nprint edit.light.0.y\nexpect edit.steps == 1\n"
           "expect edit.light.0.edited == true\nexpect view.explainedRays == 0\nkey Ctrl+Z\n"
           "expect edit.light.0.edited == false\nwait refined\nscreenshot edit.png\n");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(160 * printed(run, "edit.light.0.x"), x + 16, 0.5);
  EXPECT_NEAR(90 * printed(run, "edit.light.0.y"), y, 0.5);
}

TEST_F(WindowEditTest, AClickChoosesTheMaterial) {
  const Outcome run = play(
      "wait refined\nclick 120 85\nwait 1\nprint edit.chosenMaterial\nclick 20 45\nwait 1\n"
      "print edit.chosenMaterial\n");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("edit.chosenMaterial = 0"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("edit.chosenMaterial = 1"), std::string::npos) << run.out;
}

TEST_F(WindowEditTest, SettingsAreCopiedAsOptions) {
  const Outcome run = play("wait refined\nset background-rotation 30\nset shadows off\nprint view.options\n");
  EXPECT_NE(run.out.find("view.options = --rays-per-pixel 4 --width 160 --height 90 --no-shadows --bounces 3 "
                         "--background-rotation 30\n"),
            std::string::npos)
      << run.out;
}

TEST_F(WindowEditTest, NonsenseIsRefusedAndASceneWithoutLightsToo) {
  EXPECT_NE(play("wait refined\nset light.0.intensity -1\n").err.find("light 0: its intensity is negative"),
            std::string::npos);
  EXPECT_NE(play("wait refined\nset light.0.intensity 1\n", kSmall, scene("white_furnace.glb"))
                .err.find("'light.0.intensity' is no setting"),
            std::string::npos);
  expectPlayed("key x\nwait refined\nkey Ctrl+Z\nsave-scene a.glb\nexpect view.messages > 0\n", kSmall,
               scene("white_furnace.glb"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.glb"));
}

TEST_F(WindowEditTest, AWrittenFileKeepsEdits) {
  std::filesystem::copy_file(scene("cornell_box.glb"), folder_ / "scene.glb");
  expectPlayed(
      "wait refined\nset light.0.intensity 2\nwait refined\nkey Ctrl+R\nwait 1\nwait refined\n"
      "expect edit.light.0.intensity == 2\nexpect edit.light.0.edited == true\n",
      kSmall, (folder_ / "scene.glb").string());
}

}  // namespace
}  // namespace whittle::test
