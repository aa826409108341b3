// What `whittle info` says of a scene far from the file's origin can be told apart and pasted.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "cli/run_whittle.h"
#include "gltf/builder.h"

namespace whittle::test {
namespace {

/// A triangle with legs of 9 and 12 m, and a camera 12 m before it, turned 0.3 rad to the left.
std::filesystem::path writeFarScene(const Folder& folder) {
  GltfBuilder b;
  const int positions = b.vec3({0, 0, 0, 9, 0, 0, 0, 12, 0});
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}})},
          {"translation", {5000000, 10, -4649777.02}}});
  b.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
  b.node({{"camera", 0},
          {"translation", {5000004.413, 13.6, -4649765.02}},
          {"rotation", {0, std::sin(0.15), 0, std::cos(0.15)}}});
  std::ofstream(folder / "far.glb", std::ios::binary) << b.glb();
  return folder / "far.glb";
}

Json infoJsonOf(std::vector<std::string> args) {
  args.insert(args.begin(), "info");
  args.push_back("--json");
  const Outcome run = runWhittle(args);
  EXPECT_EQ(run.status, 0) << run.err;
  return Json::parse(run.out);
}

/// With single blanks between the words.
std::string unwrapped(const std::string& text) { return std::regex_replace(text, std::regex("\\s+"), " "); }

TEST(FarPlaces, TextShowsThemToAThousandthOfTheScene) {
  const Folder folder;
  const Outcome run = runWhittle({"info", writeFarScene(folder).string()});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string text = unwrapped(run.out);
  // 15 m across: to the centimetre.
  EXPECT_NE(text.find("9 × 12 × 0 m, from (5000000, 10, -4649777.02) to (5000009, 22, -4649777.02)"),
            std::string::npos)
      << run.out;
  EXPECT_NE(text.find("at (5000004.41, 13.6, -4649765.02) m"), std::string::npos) << run.out;
}

TEST(FarPlaces, JsonHasAllDigits) {
  const Folder folder;
  const Json info = infoJsonOf({writeFarScene(folder).string()});
  EXPECT_EQ(info["bounds"]["min"], Json({5000000.0, 10.0, -4649777.02}));
  EXPECT_EQ(info["bounds"]["max"], Json({5000009.0, 22.0, -4649777.02}));
  // A float that counts from the triangle holds 5 m to 2.4e-7.
  const double place[3] = {5000004.413, 13.6, -4649765.02};
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(info["cameras"][0]["position"][axis].get<double>(), place[axis], 1e-6);
}

TEST(FarPlaces, PastedOptionsAreTheSameCamera) {
  const Folder folder;
  const std::string file = writeFarScene(folder).string();
  const std::string text = unwrapped(runWhittle({"info", file}).out);
  std::smatch found;
  ASSERT_TRUE(
      std::regex_search(text, found, std::regex("--eye (\\S+) --look-at (\\S+) --up (\\S+) --fov ([0-9.]+)")))
      << text;
  const Json again = infoJsonOf({file, "--eye=" + found[1].str(), "--look-at=" + found[2].str(),
                                 "--up=" + found[3].str(), "--fov=" + found[4].str()});
  const Json before = infoJsonOf({file});
  EXPECT_EQ(again["cameras"][0]["position"], before["cameras"][0]["position"]);
  // Unit vectors in floats: 6e-8 each, and the angle's rounding.
  const double forward[3] = {-std::sin(0.3), 0, -std::cos(0.3)};
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(again["cameras"][0]["forward"][axis].get<double>(), forward[axis], 2e-7);
}

/// Without perspective the height is given back to the float.
TEST(FarPlaces, PastedOptionsAreTheSameOrthographicCamera) {
  const Folder folder;
  const std::string file = writeFarScene(folder).string();
  const std::vector<std::string> view{file, "--orbit", "20,10", "--ortho-height", "7.3"};
  std::vector<std::string> info{"info"};
  info.insert(info.end(), view.begin(), view.end());
  const std::string text = unwrapped(runWhittle(info).out);
  std::smatch found;
  ASSERT_TRUE(std::regex_search(
      text, found, std::regex("--eye (\\S+) --look-at (\\S+) --up (\\S+) --ortho-height ([0-9.]+)")))
      << text;
  const Json before = infoJsonOf(view)["cameras"][0];
  const Json again = infoJsonOf({file, "--eye=" + found[1].str(), "--look-at=" + found[2].str(),
                                 "--up=" + found[3].str(), "--ortho-height=" + found[4].str()})["cameras"][0];
  EXPECT_TRUE(again["orthographic"].get<bool>());
  EXPECT_EQ(again["ymag"], before["ymag"]);
  EXPECT_NEAR(before["ymag"].get<double>(), 3.65, 1e-6) << "half of what is seen";
  EXPECT_EQ(again["position"], before["position"]);
}

}  // namespace
}  // namespace whittle::test
