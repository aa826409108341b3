// --background and what goes with it: the sky that a file means, and the words about one that it cannot mean.
#include <gtest/gtest.h>
#include <OpenImageIO/imageio.h>

#include <cmath>
#include <limits>

#include "image/image_io.h"
#include "run_whittle.h"

namespace whittle::test {
namespace {

using Json = nlohmann::json;
using Args = std::vector<std::string>;

/// A picture of one pixel from a point outside the box, along -Z, away from it: the sky straight ahead.
Args aheadWith(const char* command, const Args& more) {
  Args args{command,    scene(), "--eye",   "0,0,-50", "--look-at", "0,0,-60",   "--width", "1",
            "--height", "1",     "--quiet", "-o",      "a.exr",     "--bounces", "1"};
  args.insert(args.end(), more.begin(), more.end());
  return args;
}

/// What the device sees there; the reference sees the same.
std::vector<float> ahead(const Folder& folder, const Args& more) {
  const Outcome render = runWhittle(aheadWith("render", more), {folder.path(), {}});
  EXPECT_EQ(render.status, 0) << render.err;
  const std::vector<float> seen = readFloatImage(folder / "a.exr").pixels;
  const Outcome reference = runWhittle(aheadWith("reference", more), {folder.path(), {}});
  EXPECT_EQ(reference.status, 0) << reference.err;
  const std::vector<float> right = readFloatImage(folder / "a.exr").pixels;
  EXPECT_EQ(seen.size(), 3U);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], right[c], 1e-5 * (1 + right[c]));
  return seen;
}

/// A sky of one row of four texels with these values; u = 1/2, straight ahead, is between the middle ones.
void writeSky(const Folder& folder, const std::vector<float>& greys) {
  writeExr(folder / "sky.exr", {4, 1, 1, greys}, {}, {"Y"});
}

TEST(Background, IsTurnedAndScaled) {
  const Folder folder;
  writeSky(folder, {0, 1, 2, 3});
  EXPECT_NEAR(ahead(folder, {"--background", "sky.exr"})[0], 1.5, 1e-5);
  EXPECT_NEAR(ahead(folder, {"--background", "sky.exr", "--background-rotation", "45"})[1], 2, 1e-5);
  EXPECT_NEAR(ahead(folder, {"--background", "sky.exr", "--background-rotation", "-45"})[2], 1, 1e-5);
  EXPECT_NEAR(ahead(folder, {"--background", "sky.exr", "--background-strength", "0.5"})[0], 0.75, 1e-5);
  EXPECT_EQ(ahead(folder, {"--background", "1,2,3", "--background-strength", "2"}),
            (std::vector<float>{2, 4, 6}));
  EXPECT_EQ(ahead(folder, {"--background", "1,2,3", "--background-strength", "0"}),
            (std::vector<float>{0, 0, 0}));
}

TEST(Background, SettingsAreInStatisticsAndInfo) {
  const Folder folder;
  writeSky(folder, {0, 1, 2, 3});
  const Args options{"--background", "sky.exr", "--background-rotation", "30", "--background-strength", "2"};
  Args args = smallRender(options);
  args.insert(args.end(), {"--stats", "s.json", "--quiet"});
  ASSERT_EQ(runWhittle(args, {folder.path(), {}}).status, 0);
  const Json settings = readJson(folder / "s.json")["settings"];
  EXPECT_EQ(settings["backgroundRotation"], 30);
  EXPECT_EQ(settings["backgroundStrength"], 2);
  args = {"info", scene(), "--json"};
  args.insert(args.end(), options.begin(), options.end());
  const Json info = Json::parse(runWhittle(args, {folder.path(), {}}).out)["background"];
  EXPECT_EQ(info["rotation"], 30);
  EXPECT_EQ(info["radiance"], Json({2, 2, 2}));
  EXPECT_EQ(info["mapWidth"], 4);
}

TEST(Background, NothingAskedForKeepsEveryBit) {
  const Folder folder;
  writeSky(folder, {0.1F, 1, 2.3F, 3});
  for (const Args& more : {Args{}, Args{"--background-rotation", "0", "--background-strength", "1"},
                           Args{"--background-rotation", "360"}}) {
    Args args{"render", scene("mirror.glb"), "--width", "48",           "--height", "27", "--quiet", "-o",
              "b.exr",  "--stats",           "s.json",  "--background", "sky.exr"};
    args.insert(args.end(), more.begin(), more.end());
    ASSERT_EQ(runWhittle(args, {folder.path(), {}}).status, 0);
    if (more.empty()) std::filesystem::rename(folder / "b.exr", folder / "plain.exr");
  }
  const Outcome same = runWhittle({"compare", "b.exr", "plain.exr", "--json"}, {folder.path(), {}});
  ASSERT_EQ(same.status, 0) << same.err;
  EXPECT_EQ(Json::parse(same.out)["differingPixels"], 0);
}

/// Options that change nothing say so, those that do are silent.
TEST(Background, OptionsThatChangeNothingAreSaid) {
  const Folder folder;
  writeSky(folder, {0.1F, 1, 2.3F, 3});
  const auto said = [&](Args more) {
    Args args{"info", scene("mirror.glb")};
    args.insert(args.end(), more.begin(), more.end());
    const Outcome run = runWhittle(args, {folder.path(), {}});
    EXPECT_EQ(run.status, 0) << run.err;
    return run.out + run.err;
  };
  const std::string noTurn = "--background-rotation changes nothing",
                    noScale = "--background-strength changes nothing";
  const std::string grey =
      said({"--background", "1,1,1", "--background-rotation", "30", "--background-strength", "2"});
  EXPECT_NE(grey.find(noTurn), std::string::npos) << grey;
  EXPECT_EQ(grey.find(noScale), std::string::npos) << grey;
  const std::string black = said({"--background", "0,0,0", "--background-strength", "2"});
  EXPECT_NE(black.find(noScale), std::string::npos) << black;
  const std::string map =
      said({"--background", "sky.exr", "--background-rotation", "30", "--background-strength", "2"});
  EXPECT_EQ(map.find("changes nothing"), std::string::npos) << map;
}

/// --sky-light: the light that it adds, in the place of others, and words where there is none.
TEST(Background, LightsTheSceneWhereAskedFor) {
  const Folder folder;
  const auto info = [&](Args more) {
    Args args{"info", scene(), "--sky-light", "--json"};
    args.insert(args.end(), more.begin(), more.end());
    return runWhittle(args, {folder.path(), {}});
  };
  const auto lastLight = [](const Outcome& run) { return Json::parse(run.out)["lights"].back()["kind"]; };
  const Outcome dark = info({"--background", "0"});
  EXPECT_EQ(dark.status, 0);
  EXPECT_NE(dark.err.find("--sky-light: what surrounds the scene is black; --background 1 makes it white"),
            std::string::npos)
      << dark.err;
  EXPECT_NE(lastLight(dark), "sky");
  const Outcome white = info({"--background", "1"});
  EXPECT_EQ(white.err.find("--sky-light"), std::string::npos) << white.err;
  EXPECT_EQ(lastLight(white), "sky");
  Args args = smallRender({"--background", "1", "--sky-light", "--ambient", "1", "--stats", "s.json"});
  const Outcome both = runWhittle(args, {folder.path(), {}});
  ASSERT_EQ(both.status, 0) << both.err;
  EXPECT_NE(both.err.find("--ambient adds nothing: --sky-light takes its place"), std::string::npos)
      << both.err;
  const Json stats = readJson(folder / "s.json");
  EXPECT_EQ(stats["settings"]["skyLight"], true);
  const auto& used = stats["features"]["used"];
  EXPECT_NE(std::find(used.begin(), used.end(), "sky lights"), used.end());
  EXPECT_EQ(std::find(used.begin(), used.end(), "ambient light"), used.end());
}

TEST(Background, FlawedTexelsAreMendedAndCountedInOneWarning) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kInf = std::numeric_limits<float>::infinity();
  const Folder folder;
  FloatImage sky{4, 1, 3, std::vector<float>(12, 1.0F)};
  sky.pixels[0] = kNan;
  sky.pixels[1] = sky.pixels[2] = -1;  // one texel of two flaws
  sky.pixels[3] = -kInf;
  sky.pixels[9] = kInf;
  writeExr(folder / "sky.exr", sky, {});
  const Outcome run = runWhittle(aheadWith("reference", {"--background", "sky.exr"}), {folder.path(), {}});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(
      run.err,
      "warning: --background: sky.exr: of 4 texels 1 with NaN (taken as 0), 2 with negative values (taken "
      "as 0), 1 with infinite values (taken as 65504)\n");
  EXPECT_EQ(ahead(folder, {"--background", "sky.exr", "--background-rotation", "135"}),
            (std::vector<float>{65504, 1, 1}))
      << "the texel at u = 7/8";
  EXPECT_EQ(ahead(folder, {"--background", "sky.exr", "--background-rotation", "225"}),
            (std::vector<float>{0, 0, 0}))
      << "the texel at u = 1/8";
  writeSky(folder, {0, -0.0F, 2, 3});
  EXPECT_EQ(runWhittle(aheadWith("reference", {"--background", "sky.exr"}), {folder.path(), {}}).err, "");
}

TEST(Background, SeveralLayersAreStatusTwo) {
  const Folder folder;
  writeExr(folder / "sky.exr", {1, 1, 6, std::vector<float>(6, 1.0F)}, {},
           {"day.R", "day.G", "day.B", "night.R", "night.G", "night.B"});
  const Outcome run = runWhittle(aheadWith("render", {"--background", "sky.exr"}), {folder.path(), {}});
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  for (const char* word : {"--background", "sky.exr", "day, night"})
    EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
}

/// The files of shared/scenes/tried: the same sky in several forms. Its README says what is right.
class TriedSkies : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << kFolder << " is not there";
  }
  static double rmse(const char* a, const char* b) {
    const Outcome run = runWhittle({"compare", kFolder + "/" + a, kFolder + "/" + b, "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
    return Json::parse(run.out)["rmse"];
  }
  inline static const std::string kFolder = WHITTLE_SHARED "/tried/environment-files";
};

TEST_F(TriedSkies, LayersAndScanlineOrdersAreTheSamePicture) {
  EXPECT_EQ(rmse("ao_first.exr", "rgb.exr"), 0);
  EXPECT_EQ(rmse("plusy.hdr", "normal.hdr"), 0);
}

TEST_F(TriedSkies, AWindowIsInItsPlaceAndBlackElsewhere) {
  const auto spec = OIIO::ImageInput::open(kFolder + "/window.exr")->spec();
  const FloatImage window = readFloatImage(kFolder + "/window.exr"),
                   whole = readFloatImage(kFolder + "/rgb.exr");
  ASSERT_EQ(window.width, whole.width);
  ASSERT_EQ(window.height, whole.height);
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width * 3; ++x) {
      const bool hasData = y >= spec.y && y < spec.y + spec.height;
      const std::size_t i = static_cast<std::size_t>(y) * window.width * 3 + x;
      EXPECT_EQ(window.pixels[i], hasData ? whole.pixels[i] : 0.0F) << x / 3 << ", " << y;
    }
}

}  // namespace
}  // namespace whittle::test
