// `whittle info` on a file with something needless of each kind: what is said to stay on the host, and why.
#include <gtest/gtest.h>

#include <fstream>

#include "report/text.h"
#include "run_whittle.h"

namespace whittle::test {
namespace {

/// Two triangles (one buffer) of materials 0 and 1, which are alike. Of four lights
/// the second is black and the third ends before the triangles; the fourth has no name.
constexpr const char* kFile = R"({"asset": {"version": "2.0"},
  "extensionsUsed": ["KHR_lights_punctual"],
  "extensions": {"KHR_lights_punctual": {"lights": [
    {"type": "point", "name": "lamp"}, {"type": "point", "name": "off", "intensity": 0},
    {"type": "point", "name": "far", "range": 2}, {"type": "directional", "intensity": 0}]}},
  "scenes": [{"nodes": [0, 1, 2, 3, 4]}],
  "nodes": [{"mesh": 0},
    {"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [0, 0, 2]},
    {"extensions": {"KHR_lights_punctual": {"light": 1}}, "translation": [0, 0, 2]},
    {"extensions": {"KHR_lights_punctual": {"light": 2}}, "translation": [0, 0, 9]},
    {"extensions": {"KHR_lights_punctual": {"light": 3}}}],
  "materials": [{"name": "a", "alphaMode": "MASK"}, {"name": "b"}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0},
                             {"attributes": {"POSITION": 0}, "material": 1}]}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                 "min": [0, 0, 0], "max": [1, 1, 0]}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

class PruningReport : public testing::Test {
 protected:
  PruningReport() { std::ofstream(folder / "s.gltf") << kFile; }

  std::string info(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> args{"info", "s.gltf", "--quiet"};
    args.insert(args.end(), more.begin(), more.end());
    const Outcome run = runWhittle(args, {folder.path(), {}});
    EXPECT_EQ(run.status, 0) << run.err;
    return run.out;
  }

  const Folder folder;
};

TEST_F(PruningReport, TextNamesEachThingWithItsReason) {
  const std::string text = info();
  for (const char* part :
       {"Not sent to the device\n", "1 of 2 materials: 1 like another\n",
        "1 alpha mask that cuts nothing out\n", "3 of 4 lights\n", "1  off  gives no light\n",
        "2  far  out of range of every triangle\n", "masks cut nothing out"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in:\n" << text;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(columnsOf(line), 80U) << line;
  EXPECT_NE(info({"--keep-all-features"}).find("Not sent to the device\n  nothing\n"), std::string::npos);
}

TEST_F(PruningReport, JsonHoldsTheSame) {
  const auto trimmed = nlohmann::json::parse(info({"--json"}))["features"]["trimmed"];
  EXPECT_EQ(trimmed["materials"], nlohmann::json({{"all", 2}, {"kept", 1}, {"unused", 0}, {"alike", 1}}));
  EXPECT_EQ(trimmed["lights"]["kept"], 1);
  ASSERT_EQ(trimmed["lights"]["dropped"].size(), 3U);
  EXPECT_EQ(trimmed["lights"]["dropped"][1],
            nlohmann::json({{"index", 2}, {"name", "far"}, {"reason", "out of range of every triangle"}}));
  EXPECT_EQ(trimmed["needlessMasks"], 1);
}

}  // namespace
}  // namespace whittle::test
