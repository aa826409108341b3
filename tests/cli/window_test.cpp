// `whittle view` in a real window: scripts drive it as hands would.
#include <fmt/ranges.h>

#include <chrono>
#include <sstream>
#include <thread>

#include "window_fixture.h"

namespace whittle::test {
namespace {

/// With options that decide others, as --glossy does how smooth a mirror is, and with larger letters. Silver
/// of roughness 0.1 is one of the two, as that says.
TEST_F(WindowTest, StandingStillItIsThePictureOfRender) {
  using Words = std::vector<std::string>;
  expectPlayed("wait refined\nset material.4.roughness 0.1\nsave-scene silver.glb\n");
  const auto rendered = [&](const Words& more) {
    Words args{"render", "silver.glb", "-o", "render.png", "--quiet"};
    args.insert(args.end(), kSmall.begin(), kSmall.end());
    args.insert(args.end(), more.begin(), more.end());
    const Outcome run = runWhittle(args, {folder_.path(), {}});
    EXPECT_EQ(run.status, 0) << run.err;
    return read("render.png");
  };
  ASSERT_NE(rendered({"--glossy"}).bytes, rendered({"--glossy", "--mirror-roughness", "0.2"}).bytes);
  for (const Words& more : {Words{}, Words{"--glossy"}, Words{"--area-lights"},
                            Words{"--bloom", "0.3,0.2", "--dither", "--sky", "30,20,2"}}) {
    Words view = kSmall;
    view.insert(view.end(), {"--ui-scale", "1.25"});
    view.insert(view.end(), more.begin(), more.end());
    const Outcome run = play(
        "wait refined\nscreenshot window.png\nprint window.pictureX\nprint window.pictureY\n"
        "print window.pictureWidth\nquit\n",
        view, "silver.glb");
    ASSERT_EQ(run.status, 0) << run.err;
    const Codes window = read("window.png"), picture = rendered(more);
    const int x0 = static_cast<int>(printed(run, "window.pictureX")),
              y0 = static_cast<int>(printed(run, "window.pictureY"));
    const int scale = static_cast<int>(printed(run, "window.pictureWidth")) / picture.width;
    ASSERT_GE(scale, 1);
    std::size_t different = 0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
        for (int k = 0; k < scale; ++k)
          different += picture.at(x, y) != window.at(x0 + x * scale + k, y0 + y * scale + k);
    EXPECT_EQ(different, 0U) << fmt::format("{}", fmt::join(more, " "));
  }
}

TEST_F(WindowTest, EverySettingGoesThroughTheCommandLinesChecks) {
  expectPlayed(
      "wait refined\nexpect stats.rays.shadow > 0\nset shadows off\nwait refined\nexpect stats.rays.shadow "
      "== 0\n"
      "set shadows on\nset bounces 1\nwait refined\nexpect stats.rays.impulse == 0\n"
      "set search array\nset search tree\nset sampler sobol\nset impulses one\nset cutoff 0.01\nset lanes 1\n"
      "set wavefront 4096\nset work-group 4\nset seed 7\nset ambient 0.1\nset back-faces show\nset exposure "
      "1\n"
      "set tone-map none\nset transparent-bounces 3\nset mirror-roughness 0.1\nset background-rotation 30\n"
      "set bloom 0.1,0.05\nset dither on\nset background-strength 2\nset rays-per-pixel 2\nset target-error "
      "1%\nset width 80\nset height 45\n"
      "wait refined\nexpect stats.settings.width == 80\nexpect stats.settings.sampler == sobol\n"
      "expect view.width == 80\n");
  EXPECT_NE(play("wait refined\nset bounces 0\n").err.find("line 2: --bounces: '0' is not a whole number"),
            std::string::npos);
}

TEST_F(WindowTest, WhatLoadingAddsComesAndGoes) {
  expectPlayed(
      "wait refined\nexpect stats.scene.lights == 2\nset sky 20,30\nwait refined\n"
      "expect stats.scene.lights == 3\nexpect stats.settings.sky == 20,30,3\n"
      "expect stats.settings.ambient == 0\n"  // no sky reaches what is in the box
      "set sky none\nwait refined\nexpect stats.scene.lights == 2\nexpect stats.settings.ambient == 0\n"
      "set area-lights on\nwait refined\nexpect stats.scene.lights == 3\n");
  EXPECT_NE(play("wait refined\nset sky 91,0\n").err.find("line 2: --sky: '91,0'"), std::string::npos);
}

TEST_F(WindowTest, ExposureTracesNothingAndACameraCompilesNothing) {
  expectPlayed(
      "wait refined\nset exposure 2\nwait 0.2\nexpect view.finished == true\n"
      "set bloom 0.2\nset dither on\nwait 0.2\nexpect view.finished == true\n"
      "drag 80 40 100 45 left\nwait refined\nexpect view.programs == 0\nexpect view.scene == 0\n"
      "key 5\nwait refined\nexpect view.programs == 0\nkey 7\nkey 1\nkey f\nkey r\nwheel 80 45 3\n"
      "drag 80 40 60 40 right\ndrag 80 40 60 40 middle\nwait refined\nexpect view.programs == 0\n");
}

TEST_F(WindowTest, ShowsWhatPixelsMeet) {
  expectPlayed(
      "wait refined\nset show depth\nwait refined\nscreenshot depth.png\nset show normal\nscreenshot "
      "normal.png\n"
      "set show albedo\nset show primitive\nset show samples\nexpect view.finished == true\nset show beauty\n"
      "expect view.finished == true\nwait refined\n");
  EXPECT_NE(read("depth.png").bytes, read("normal.png").bytes);
  EXPECT_NE(play("set show nothing\n").err.find("'nothing' is not one of beauty|depth"), std::string::npos);
}

TEST_F(WindowTest, AClickShowsTheRaysOfAPixel) {
  expectPlayed(
      "wait refined\nclick 88 60\nwait 1\nexpect view.explainedRays > 1\nscreenshot rays.png\nkey Escape\n"
      "expect view.explainedRays == 0\nexpect view.finished == true\nset bounces 2\nclick 20 20\nwait "
      "refined\n");
}

TEST_F(WindowTest, AnySize) {
  expectPlayed(
      "wait picture\nresize 1 1\nwait 0.3\nresize 200 100\nwait 0.3\nresize 1280 720\nwait refined\n");
}

TEST_F(WindowTest, BadFilesAreSaidAndEndNothing) {
  std::ofstream(folder_ / "bad.glb") << "no file of glTF";
  expectPlayed(
      "wait refined\ndrop bad.glb\nwait 0.5\nexpect view.messages > 0\nexpect view.finished == true\n"
      "set bounces 2\nwait refined\nexpect stats.settings.bounces == 2\n");
  expectPlayed("wait 0.3\ndrop " + scene("mirror.glb") + "\nwait refined\nexpect stats.rays.primary > 0\n",
               kSmall, "");
}

/// With the camera as it is: what an artist sees who exports again and again.
TEST_F(WindowTest, AWrittenFileIsReadAgain) {
  const auto copyTo = [&](const char* from) {
    std::filesystem::copy_file(scene(from), folder_ / "scene.glb",
                               std::filesystem::copy_options::overwrite_existing);
  };
  copyTo("mirror.glb");
  std::ofstream(folder_ / "script")
      << "wait refined\nprint stats.scene.triangles\nscreenshot first.png\nwait 4\n"
         "wait refined\nprint stats.scene.triangles\nquit\n";
  std::vector<std::string> args{"view", "scene.glb", "--script", "script"};
  args.insert(args.end(), kSmall.begin(), kSmall.end());
  Process window(args, {folder_.path(), {{"DISPLAY", display_.name}, {"LIBGL_ALWAYS_SOFTWARE", "1"}}});
  for (int i = 0; i < 600 && !std::filesystem::exists(folder_ / "first.png"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  std::this_thread::sleep_for(std::chrono::seconds(1));  // it has looked at the file
  copyTo("cornell_box.glb");
  const Outcome run = window.finish();
  ASSERT_EQ(run.status, 0) << run.err;
  const auto first = run.out.find("triangles = "), second = run.out.rfind("triangles = ");
  ASSERT_NE(first, second) << run.out;
  EXPECT_NE(std::atoi(run.out.c_str() + first + 12), std::atoi(run.out.c_str() + second + 12)) << run.out;
}

TEST_F(WindowTest, ClosesWhileItCompiles) {
  const Folder cache;
  std::ofstream(folder_ / "script") << "wait 0.2\nquit\n";
  const Outcome run =
      runWhittle({"view", scene("cornell_box.glb"), "--script", "script"},
                 {folder_.path(), {{"DISPLAY", display_.name}, {"POCL_CACHE_DIR", cache.path().string()}}});
  EXPECT_EQ(run.status, 0) << run.err;
}

TEST_F(WindowTest, SavesWhatItShows) {
  expectPlayed("wait refined\nkey Ctrl+S\nwait 0.2\n");
  const Codes png = read("cornell_box-001.png");
  EXPECT_EQ(png.width, 160);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "cornell_box-001.exr"));
}

/// Rendering, codes, comparison, edits and reading at once: what the sanitizers run too (tests/README.md).
TEST_F(WindowTest, EveryThreadAtWork) {
  std::ifstream script(std::string(WHITTLE_SCENES) + "/../tests/view/every_thread.script");
  std::stringstream text;
  text << script.rdbuf();
  ASSERT_FALSE(text.str().empty());
  expectPlayed(text.str());
  EXPECT_NE(read("first.png").bytes, read("last.png").bytes);
}

TEST_F(WindowTest, WithoutADisplayItSaysSo) {
  const Outcome run = runWhittle({"view", scene("cornell_box.glb")},
                                 {folder_.path(), {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}}});
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("whittle: there is no display"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace whittle::test
