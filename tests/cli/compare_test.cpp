// compare on pictures for the eye: FLIP of the codes that are in the files.
#include <gtest/gtest.h>

#include "image/image_io.h"
#include "run_whittle.h"

namespace whittle::test {
namespace {

/// Pictures that differ in alpha alone are the same to compare, so it says what it leaves out.
TEST(CompareCodes, SaysThatAlphaIsLeftOut) {
  const Folder folder;
  writeCodes(folder / "half.png", {1, 1, 4, {9, 9, 9, 128}}, {});
  writeCodes(folder / "full.png", {1, 1, 4, {9, 9, 9, 255}}, {});
  writeCodes(folder / "none.png", {1, 1, 3, {9, 9, 9}}, {});
  const auto said = [&](const char* a, const char* b) {
    const Outcome run = runWhittle({"compare", a, b, "--json"}, {folder.path(), {}});
    EXPECT_EQ(run.status, 0) << run.err;
    return run.err;
  };
  EXPECT_NE(said("half.png", "full.png").find("alpha is left out"), std::string::npos);
  EXPECT_NE(said("half.png", "none.png").find("only one of these has an alpha"), std::string::npos);
  EXPECT_EQ(said("none.png", "none.png"), "");
}

using Json = nlohmann::json;

void writeFlat(const std::filesystem::path& file, std::uint8_t code) {
  writeCodes(file, {16, 16, 3, std::vector<std::uint8_t>(std::size_t{16} * 16 * 3, code)}, {});
}

Json compared(const Folder& folder, const char* a, const char* b) {
  const Outcome run = runWhittle({"compare", a, b, "--json"}, {folder.path(), {}});
  EXPECT_EQ(run.status, 0) << run.err;
  return Json::parse(run.out);
}

/// 0.96738 by the paper's formulas, lightness 0 against 100 without chroma (tests/image/flip_test.cpp), and
/// 0.9675 in the published tool. Any tone map before it makes white darker.
TEST(CompareCodes, BlackAgainstWhite) {
  const Folder folder;
  for (const char* extension : {".png", ".jpg"}) {
    const std::string black = std::string("black") + extension, white = std::string("white") + extension;
    writeFlat(folder / black, 0);
    writeFlat(folder / white, 255);
    const Json json = compared(folder, black.c_str(), white.c_str());
    EXPECT_NEAR(json["flip"].get<double>(), 0.96738, 5e-6) << extension;
    EXPECT_EQ(json["rmse"], 1.0) << extension;
  }
}

/// A picture and what a person sees of it differ in radiance, and not to the eye.
TEST(CompareCodes, RadianceBesideItsOwnToneMap) {
  const Folder folder;
  for (const char* map : {"filmic", "none"}) {
    const Outcome run =
        runWhittle(smallRender({"-o", "a.exr", "-o", "a.png", "--exposure", "0", "--tone-map", map}),
                   {folder.path(), {}});
    ASSERT_EQ(run.status, 0) << run.err;
    const Outcome mixed = runWhittle({"compare", "a.png", "a.exr", "--json"}, {folder.path(), {}});
    EXPECT_NE(mixed.err.find("note: one picture is linear"), std::string::npos) << mixed.err;
    const double flip = Json::parse(mixed.out)["flip"];
    if (map == std::string("filmic"))
      EXPECT_EQ(flip, 0.0);
    else
      EXPECT_GT(flip, 0.0) << "cut off where the tone map rolls off";
  }
}

}  // namespace
}  // namespace whittle::test
