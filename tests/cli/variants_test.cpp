// --variant, as a user meets it.
#include <gtest/gtest.h>

#include <fstream>

#include "gltf/builder.h"
#include "run_whittle.h"

namespace whittle::test {
namespace {

/// Glows red, and in the variant "night" not at all.
std::string twoVariants() {
  GltfBuilder b;
  b.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
  b.node({{"camera", 0}, {"translation", {0.3, 0.3, 1}}});
  b.material({{"emissiveFactor", {1, 0, 0}}});
  b.material({{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}}});
  b.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "day"}}, {{"name", "night"}}};
  const Json mappings{
      {"mappings", {{{"material", 0}, {"variants", {0}}}, {{"material", 1}, {"variants", {1}}}}}};
  b.node(
      {{"mesh", b.triangleMesh({{"material", 0}, {"extensions", {{"KHR_materials_variants", mappings}}}})}});
  return b.glb();
}

TEST(Variants, OneIsChosenListedOrRefused) {
  const Folder folder;
  std::ofstream(folder / "v.glb", std::ios::binary) << twoVariants();
  const auto brightest = [&](const char* variant) {
    const Outcome run =
        runWhittle({"render", "v.glb", "--width", "8", "--height", "8", "--quiet", "-o", "v.exr",
                    "--no-default-lights", "--no-default-background", "--variant", variant},
                   {folder.path(), {}});
    EXPECT_EQ(run.status, 0) << run.err;
    const auto pixels = readFloatImage(folder / "v.exr").pixels;
    return *std::max_element(pixels.begin(), pixels.end());
  };
  EXPECT_EQ(brightest("day"), 1.0F);
  EXPECT_EQ(brightest("1"), 0.0F);
  const Outcome wrong = runWhittle({"info", "v.glb", "--variant", "dusk"}, {folder.path(), {}});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("has no variant \"dusk\" (it has: 0 \"day\", 1 \"night\")"), std::string::npos)
      << wrong.err;
  const Outcome text = runWhittle({"info", "v.glb"}, {folder.path(), {}});
  EXPECT_NE(text.out.find("2 variants of the materials, --variant NAME shows one"), std::string::npos)
      << text.out;
  const auto json = nlohmann::json::parse(runWhittle({"info", "v.glb", "--json"}, {folder.path(), {}}).out);
  EXPECT_EQ(json["variants"], (nlohmann::json{"day", "night"}));
  EXPECT_EQ(json["unpacked"], nlohmann::json::array());
}

}  // namespace
}  // namespace whittle::test
