// The window's panels: their size, what stands in them, and what its views say as options of the command
// line.
#include <algorithm>
#include <fstream>

#include "image/image_io.h"
#include "window_fixture.h"

namespace whittle::test {
namespace {

class WindowPanelsTest : public WindowTest {
 protected:
  /// The files NAME.png and NAME.exr of `whittle render` of the window's settings and more.
  void render(const std::string& name, const std::vector<std::string>& more,
              const std::string& file = scene("cornell_box.glb")) {
    std::vector<std::string> args{"render", file, "-o", name + ".png", "-o", name + ".exr", "--quiet"};
    args.insert(args.end(), kSmall.begin(), kSmall.end());
    args.insert(args.end(), more.begin(), more.end());
    const Outcome run = runWhittle(args, {folder_.path(), {}});
    ASSERT_EQ(run.status, 0) << run.err;
  }
  void expectSamePicture(const std::string& a, const std::string& b) {
    EXPECT_EQ(read(a + ".png").bytes, read(b + ".png").bytes);
    const FloatImage left = readFloatImage(folder_ / (a + ".exr")),
                     right = readFloatImage(folder_ / (b + ".exr"));
    EXPECT_EQ(left.width, right.width);
    EXPECT_EQ(left.height, right.height);
    EXPECT_EQ(left.pixels, right.pixels);
  }
  /// What a script's line `print PATH` wrote.
  static std::string text(const Outcome& run, const std::string& path) {
    const auto at = run.out.find(path + " = ");
    if (at == std::string::npos) return {};
    const auto begin = at + path.size() + 3;
    return run.out.substr(begin, run.out.find('\n', begin) - begin);
  }
  static std::vector<std::string> words(const std::string& line) {
    std::istringstream in(line);
    std::vector<std::string> out;
    for (std::string word; in >> word;) out.push_back(word);
    return out;
  }
};

TEST_F(WindowPanelsTest, LettersGrowByKeysAndByNumber) {
  expectPlayed(
      "wait picture\nexpect window.uiScale == 1\nkey Ctrl++\nexpect window.uiScale == 1.25\nkey Ctrl+-\n"
      "key Ctrl+-\nexpect window.uiScale == 0.75\nkey Ctrl+0\nexpect window.uiScale == 1\nset ui-scale 4\n"
      "key Ctrl++\nexpect window.uiScale == 4\nset ui-scale auto\nexpect window.uiScale == 1\nwait 0.2\n"
      "screenshot one.png\nset ui-scale 1.5\nwait 0.2\nscreenshot larger.png\nset ui-scale 1\nwait 0.2\n"
      "screenshot again.png\n");
  EXPECT_NE(read("one.png").bytes, read("larger.png").bytes);
  EXPECT_EQ(read("one.png").bytes, read("again.png").bytes) << "letters are drawn anew, not stretched";
  EXPECT_NE(play("set ui-scale 5\n").err.find("ui-scale: '5' is neither auto nor a number from 0.5 to 4"),
            std::string::npos);
  const Outcome run = runWhittle({"view", scene(), "--ui-scale", "0.4"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("--ui-scale: '0.4'"), std::string::npos) << run.err;
}

/// Both panels, one with tabs, none: as there is room for the picture too.
TEST_F(WindowPanelsTest, PanelsGiveWayToThePicture) {
  expectPlayed(
      "wait picture\nexpect window.panels == 2\nset ui-scale 2\nwait 0.2\nexpect window.panels == 1\n"
      "key Tab\nwait 0.2\nexpect window.panels == 0\nkey Tab\nset ui-scale 1\nresize 700 500\nwait 0.3\n"
      "expect window.panels == 1\nexpect window.pictureWidth > 100\nset ui-scale 2\nwait 0.2\n"
      "expect window.panels == 0\n");
}

TEST_F(WindowPanelsTest, MonitorsOfManyRowsHaveLargerLetters) {
  for (const auto& [screen, scale] : {std::pair{"1920x1080x24", "1"}, {"2560x1440x24", "1.25"}}) {
    const VirtualDisplay monitor(screen);
    environment_ = {{"DISPLAY", monitor.name}};
    expectPlayed(std::string("wait picture\nexpect window.uiScale == ") + scale + "\n");
    auto args = kSmall;
    args.insert(args.end(), {"--ui-scale", "1.5"});
    expectPlayed(
        "wait picture\nexpect window.uiScale == 1.5\nkey Ctrl++\nkey Ctrl+0\nexpect window.uiScale == 1.5\n",
        args);
  }
}

/// As on the command line a target takes as many rays as it needs, where nobody gave their number.
TEST_F(WindowPanelsTest, ATargetIsReached) {
  const std::vector<std::string> picture{"--width", "32", "--height", "18"};
  expectPlayed(
      "wait refined\nexpect stats.samples.mean == 64\nset adaptive on\nset target-error 1%\nwait refined\n"
      "expect stats.samples.mean > 64\nset target-error 0\nset adaptive off\nwait refined\n"
      "expect stats.samples.mean == 64\nset rays-per-pixel 8\nset target-error 1%\nwait refined\n"
      "expect stats.samples.mean == 8\n",
      picture);
}

/// In 720 rows, also below the figures of a comparison; and nobody must scroll to see the rest.
TEST_F(WindowPanelsTest, TheErrorPlotFitsBelowTheStages) {
  expectPlayed(
      "wait refined\nwait 0.2\nexpect stats.error.1.raysPerPixel > 1\nexpect window.statisticsCut == 0\n"
      "key k\nset compare difference\nwait compared\nwait 0.2\nexpect window.statisticsCut == 0\n",
      {"--width", "160", "--height", "90", "--rays-per-pixel", "16"}, scene("textured.glb"));
}

/// A hand that drags a number must not see it jump away.
TEST_F(WindowPanelsTest, AnEditMovesNothingInItsPanel) {
  expectPlayed(
      "key x\nwait refined\nwait 0.2\nscreenshot before.png\nset light.0.intensity 2\nwait refined\nwait "
      "0.2\n"
      "screenshot after.png\n");
  const Codes before = read("before.png"), after = read("after.png");
  // Below the lights, left of the picture: materials.
  std::size_t different = 0;
  for (int y = 400; y < 690; ++y)
    for (int x = 0; x < 280; ++x) different += before.at(x, y) != after.at(x, y);
  EXPECT_EQ(different, 0U);
  EXPECT_NE(before.bytes, after.bytes);
}

TEST_F(WindowPanelsTest, TheLargestShareOfAPixelIsListedFirst) {
  render("any", {});
  std::vector<std::string> args{"render", scene(), "--explain", "88,60", "--json", "--quiet"};
  args.insert(args.end(), kSmall.begin(), kSmall.end());
  const Outcome told = runWhittle(args, {folder_.path(), {}});
  ASSERT_EQ(told.status, 0) << told.err;
  const auto rays = nlohmann::json::parse(told.out)["samples"][0]["rays"];
  std::size_t largest = 0;
  std::vector<double> adds;
  double red = 0, green = 0, blue = 0;
  for (const auto& ray : rays) {
    std::array<double, 3> share{};
    for (std::size_t i = 0; i < 3; ++i)
      share[i] = ray["throughput"][i].get<double>() * ray["radiance"][i].get<double>();
    red += share[0], green += share[1], blue += share[2];
    adds.push_back(std::max({share[0], share[1], share[2]}));
    if (adds.back() > adds[largest]) largest = adds.size() - 1;
  }
  const double least = 0.01 * std::max({red, green, blue});
  const auto listed = std::count_if(adds.begin(), adds.end(), [&](double add) { return add >= least; });
  ASSERT_LT(listed, static_cast<std::ptrdiff_t>(adds.size())) << "a pixel with small shares, too";
  ASSERT_NE(largest, 0U) << "nor may the first of the tree be the largest";
  expectPlayed(
      fmt::format("wait refined\nclick 88 60\nwait 1\nwait 0.2\nexpect window.firstRay == 0\n"
                  "set ray-order share\nwait 0.2\nexpect window.firstRay == {}\n"
                  "expect window.listedRays == {}\nset hide-small-rays on\nwait 0.2\n"
                  "expect window.listedRays == {}\nset ray-order tree\nwait 0.2\n"
                  "expect window.firstRay == 0\n",
                  largest, adds.size(), listed));
  EXPECT_NE(play("set ray-order size\n").err.find("ray-order: 'size' is not one of tree|share"),
            std::string::npos);
}

/// Key 5, a height by hand, another place: what is copied is that view.
TEST_F(WindowPanelsTest, AnOrthographicViewIsCopiedAsOptions) {
  const Outcome run = play(
      "wait refined\nkey 5\nset ortho-height 1.7\nwait refined\ndrag 80 40 100 45 left\nwait refined\n"
      "print view.camera\nkey Ctrl+S\nwait 0.2\nkey Ctrl+C\nkey r\nwait refined\nkey Ctrl+V\nwait refined\n"
      "key Ctrl+S\nwait 0.2\n");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto options = words(text(run, "view.camera"));
  ASSERT_TRUE(std::find(options.begin(), options.end(), "--ortho-height") != options.end()) << run.out;
  render("render", options);
  expectSamePicture("cornell_box-002", "render");  // pasted
  // Axes in floats, read back from a text, may round the other way: an edge may move over a pixel's middle.
  const Codes moved = read("cornell_box-001.png"), again = read("render.png");
  std::size_t different = 0;
  for (std::size_t i = 0; i < again.bytes.size(); ++i)
    different += std::abs(moved.bytes.at(i) - again.bytes[i]) > 2;
  EXPECT_LT(different, again.bytes.size() / 500);
  EXPECT_NE(play("set ortho-height 0\n").err.find("ortho-height: '0' is no height in metres"),
            std::string::npos);
}

}  // namespace
}  // namespace whittle::test
