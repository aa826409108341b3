// --sky, --bloom and --dither as a user has them: files, statistics, notes.
#include <gtest/gtest.h>

#include <cmath>

#include "image/image_io.h"
#include "run_whittle.h"

namespace whittle::test {
namespace {

using Json = nlohmann::json;
using Args = std::vector<std::string>;

Args plus(Args args, const Args& more) {
  args.insert(args.end(), more.begin(), more.end());
  return args;
}

FloatImage pictureOf(const Folder& folder, const Args& args, const std::string& file) {
  const Outcome run = runWhittle(plus(args, {"-o", file, "--quiet"}), {folder.path(), {}});
  EXPECT_EQ(run.status, 0) << run.err;
  return readFloatImage(folder / file);
}

Json infoWith(const Args& more) {
  const Outcome run = runWhittle(plus({"info", scene("height_field.glb"), "--json"}, more));
  EXPECT_EQ(run.status, 0) << run.err;
  return Json::parse(run.out);
}

TEST(SkyOption, KernelsAndReferenceDrawTheSameSky) {
  const Folder folder;
  for (const char* sky : {"3,200", "50,20,6"}) {
    const Args options{scene("mirror.glb"), "--sky", sky, "--width", "48", "--height", "27"};
    const FloatImage fast = pictureOf(folder, plus({"render"}, options), "fast.exr");
    const FloatImage right = pictureOf(folder, plus({"reference"}, options), "right.exr");
    double mean = 0, squares = 0;
    for (std::size_t i = 0; i < fast.pixels.size(); ++i) {
      const double off = static_cast<double>(fast.pixels[i]) - static_cast<double>(right.pixels[i]);
      squares += off * off, mean += static_cast<double>(right.pixels[i]);
    }
    const auto count = static_cast<double>(fast.pixels.size());
    // Looking a direction up in single precision is off by 1e-7 radians, a ten-thousandth of a texel.
    EXPECT_LT(std::sqrt(squares / count), 2e-5 * mean / count) << sky;
    EXPECT_GT(mean / count, 1) << "W/(m² sr)";
  }
}

TEST(SkyOption, SunAndSkyStandInTheReports) {
  const Json plain = infoWith({}), sunny = infoWith({"--sky", "40,10"});
  EXPECT_TRUE(plain["sky"].is_null());
  EXPECT_EQ(sunny["sky"], Json({{"elevation", 40}, {"azimuth", 10}, {"turbidity", 3}}));
  ASSERT_EQ(sunny["lights"].size(), plain["lights"].size() + 1);
  const Json sun = sunny["lights"].back();
  EXPECT_EQ(sun["name"], "sun");
  EXPECT_NEAR(sun["direction"][1].get<double>(), -std::sin(40 * std::acos(-1) / 180), 1e-6);
  EXPECT_GT(sunny["background"]["mapWidth"], 0);
  const Folder folder;
  const Outcome run =
      runWhittle({"render", scene("height_field.glb"), "--width", "32", "--height", "24", "--sky", "40,10",
                  "--bloom", "0.1", "--dither", "--stats", "s.json", "-o", "a.png", "--quiet"},
                 {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
  const Json settings = readJson(folder / "s.json")["settings"];
  EXPECT_EQ(settings["sky"], "40,10,3");
  EXPECT_EQ(settings["bloom"], "0.1,0.1");
  EXPECT_EQ(settings["dither"], true);
  EXPECT_GT(settings["ambient"], 0) << "what lies in the shade is not black";
  EXPECT_LT(settings["exposure"], -4) << "noon is bright";
}

/// In a closed room what lies in the shade is as dark as without a sky.
TEST(SkyOption, RoomsAreNotGreyed) {
  const Folder folder;
  const Outcome run = runWhittle({"render", scene("cornell_box.glb"), "--width", "32", "--height", "24",
                                  "--sky", "40,10", "--stats", "s.json", "-o", "a.png"},
                                 {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(readJson(folder / "s.json")["settings"]["ambient"], 0);
  EXPECT_NE(run.err.find("--ambient auto, with the sky, 0 % of it"), std::string::npos) << run.err;
}

TEST(SkyOption, WhatItLeavesOutIsSaid) {
  const auto said = [](const Args& more) {
    return runWhittle(plus({"info", scene("height_field.glb")}, more)).err;
  };
  const std::string turned = said({"--sky", "40,10", "--background-rotation", "30"});
  EXPECT_NE(turned.find("--background-rotation changes nothing: --sky"), std::string::npos) << turned;
  const std::string lit = said({"--sky", "40,10", "--default-lights"});
  EXPECT_NE(lit.find("--default-lights adds nothing"), std::string::npos) << lit;
  EXPECT_NE(said({"--sky", "40,10"}).find("--ambient auto, with the sky"), std::string::npos);
  EXPECT_EQ(said({"--sky", "40,10", "--ambient", "0"}).find("--ambient"), std::string::npos);
}

TEST(BloomOption, LeavesRadianceAloneAndBrightensWhatIsAboutLights) {
  const Folder folder;
  const Args args{"render", scene("emission.glb"), "--width", "64", "--height", "36", "--exposure", "0"};
  const Args glaring = plus(args, {"--bloom", "0.4,0.2"});
  EXPECT_EQ(pictureOf(folder, args, "a.exr").pixels, pictureOf(folder, glaring, "b.exr").pixels);
  const FloatImage plain = pictureOf(folder, args, "a.png"), glare = pictureOf(folder, glaring, "b.png");
  EXPECT_EQ(pictureOf(folder, plus(args, {"--bloom", "0"}), "c.png").pixels, plain.pixels);
  std::size_t brighter = 0;
  for (std::size_t i = 0; i < plain.pixels.size(); ++i) brighter += glare.pixels[i] > plain.pixels[i] ? 1 : 0;
  EXPECT_GT(brighter, plain.pixels.size() / 4);
}

TEST(DitherOption, CodesAreOffByOneAtMost) {
  const Folder folder;
  const Args args{"render", scene("mirror_box.glb"), "--width", "64", "--height", "36"};
  const FloatImage plain = pictureOf(folder, args, "a.png");
  const FloatImage dithered = pictureOf(folder, plus(args, {"--dither"}), "b.png");
  const auto codeOf = [](float v) {
    return std::lround(255 * (v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1 / 2.4F) - 0.055F));
  };
  std::size_t others = 0;
  for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
    const auto off = std::abs(codeOf(plain.pixels[i]) - codeOf(dithered.pixels[i]));
    ASSERT_LE(off, 1) << i;
    others += off > 0 ? 1 : 0;
  }
  // Between rounding and a threshold: on average a quarter of the values go the other way.
  EXPECT_GT(others, plain.pixels.size() / 8);
}

}  // namespace
}  // namespace whittle::test
