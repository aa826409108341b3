// What the window does with the options that say how a scene is read, and where they are refused.
#include <gtest/gtest.h>

#include "gltf/builder.h"
#include "window_fixture.h"

namespace whittle::test {
namespace {

class WindowSceneTest : public WindowTest {
 protected:
  static std::vector<std::string> with(std::vector<std::string> more) {
    more.insert(more.begin(), kSmall.begin(), kSmall.end());
    return more;
  }
};

/// Nothing will come, so that nobody waits; the words are those of the command line.
TEST_F(WindowSceneTest, WhatIsRefusedEndsAScriptThatWaitsForIt) {
  const Outcome option = play("wait refined\n", with({"--ortho-height", "2"}));
  EXPECT_EQ(option.status, 2) << option.err;
  EXPECT_NE(option.err.find("line 1: nothing to wait for: --ortho-height: needs --eye or --orbit"),
            std::string::npos)
      << option.err;
  const Outcome file = play("wait picture\n", kSmall, "nothing.glb");
  EXPECT_EQ(file.status, 2) << file.err;
  EXPECT_NE(file.err.find("nothing.glb"), std::string::npos) << file.err;
  EXPECT_EQ(play("wait refined\n", kSmall, "").status, 2) << "no scene at all";
}

/// Several pixels share one of the window's.
TEST_F(WindowSceneTest, AClickMeetsItsPixelInASmallPicture) {
  std::string script = "wait refined\nresize 760 300\nwait 0.3\nexpect window.pictureWidth < 320\n";
  for (const int x : {0, 101, 102, 103, 319, 639})
    script += fmt::format(
        "click {} {}\nwait 0.2\nexpect view.explainedX == {}\nexpect view.explainedY == {}\nkey Escape\n", x,
        x / 2, x, x / 2);
  expectPlayed(script, {"--width", "640", "--height", "360", "--rays-per-pixel", "1", "--bounces", "1"});
}

TEST_F(WindowSceneTest, WhatSurroundsTheSceneIsASettingToo) {
  expectPlayed(
      "wait refined\nset background 0.5,0.25,0.125\nwait refined\nkey Ctrl+S\n"
      "expect view.options != nothing\nset background auto\nwait refined\nkey Ctrl+S\n",
      kSmall, scene("mirror.glb"));
  std::vector<std::string> args{"render",       scene("mirror.glb"), "-o", "right.png", "--quiet",
                                "--background", "0.5,0.25,0.125"};
  args.insert(args.end(), kSmall.begin(), kSmall.end());
  ASSERT_EQ(runWhittle(args, {folder_.path(), {}}).status, 0);
  EXPECT_EQ(read("mirror-001.png").bytes, read("right.png").bytes);
  EXPECT_NE(read("mirror-002.png").bytes, read("right.png").bytes);
  EXPECT_NE(play("wait refined\nset time -1\n").err.find("line 2: --time: '-1'"), std::string::npos);
  const Outcome run = play("wait refined\nset animation fly\nwait 0.5\nprint view.message\nset time auto\n");
  EXPECT_NE(run.out.find("no animation"), std::string::npos) << run.out << run.err;
}

TEST_F(WindowSceneTest, CamerasAndLensesAreSettings) {
  expectPlayed("wait refined\nset fov 20\nwait picture\nset camera 0\nwait refined\n");
  EXPECT_NE(play("wait refined\nset fov 200\n").err.find("line 2: fov: '200'"), std::string::npos);
  EXPECT_NE(play("wait refined\nset camera 7\n").err.find("line 2: "), std::string::npos);
}

/// A studio's ambient light is chosen anew whenever the file is read, unless a hand chose it.
TEST_F(WindowSceneTest, AnAmbientLightByHandOutlivesAReload) {
  GltfBuilder b;
  const int positions = b.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}})}});
  std::ofstream(folder_ / "triangle.glb", std::ios::binary) << b.glb();
  expectPlayed(
      "wait refined\nexpect stats.settings.ambient > 0\nset ambient 0.25\nwait refined\nkey Ctrl+R\nwait 1\n"
      "wait refined\nexpect stats.settings.ambient == 0.25\nset ambient auto\nwait 0.5\nwait refined\n"
      "expect stats.settings.ambient != 0.25\nexpect stats.settings.ambient > 0\n",
      kSmall, "triangle.glb");
}

}  // namespace
}  // namespace whittle::test
