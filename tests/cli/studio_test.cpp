// What the studio brings for a file without lights: an ambient term, which each of its own options turns off.
#include <gtest/gtest.h>

#include <algorithm>

#include "cli/run_whittle.h"
#include "gltf/builder.h"

namespace whittle::test {
namespace {

std::filesystem::path writeTriangle(const Folder& folder, bool hasLamp) {
  GltfBuilder b;
  const int positions = b.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}})}});
  if (hasLamp) {
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}}};
    b.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  }
  std::ofstream(folder / "triangle.glb", std::ios::binary) << b.glb();
  return folder / "triangle.glb";
}

bool hasAmbient(const std::filesystem::path& file, std::vector<std::string> options) {
  options.insert(options.begin(), {"info", file.string(), "--json"});
  const Outcome run = runWhittle(options);
  EXPECT_EQ(run.status, 0) << run.err;
  const Json features = Json::parse(run.out)["features"]["used"];
  const bool used = std::find(features.begin(), features.end(), "ambient light") != features.end();
  EXPECT_EQ(run.err.find("note: --ambient auto") != std::string::npos, used) << run.err;
  return used;
}

TEST(Studio, HasAnAmbientTermUnlessToldOtherwise) {
  const Folder folder;
  const auto file = writeTriangle(folder, false);
  EXPECT_TRUE(hasAmbient(file, {}));
  EXPECT_TRUE(hasAmbient(file, {"--background", "0,0,0"}));
  EXPECT_TRUE(hasAmbient(file, {"--no-default-background"}));
  EXPECT_FALSE(hasAmbient(file, {"--ambient", "0"}));
  EXPECT_FALSE(hasAmbient(file, {"--no-default-lights"}));
}

TEST(Studio, AFileWithALampHasNone) {
  const Folder folder;
  EXPECT_FALSE(hasAmbient(writeTriangle(folder, true), {}));
}

}  // namespace
}  // namespace whittle::test
