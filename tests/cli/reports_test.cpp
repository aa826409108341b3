// info, devices and compare: text for people, JSON for scripts.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "image/image_io.h"
#include "report/text.h"
#include "run_whittle.h"

namespace whittle::test {
namespace {

using Json = nlohmann::json;

/// What info says as JSON; cases that ask for the same share one run.
const Json& infoOf(const std::vector<std::string>& args) {
  static std::map<std::vector<std::string>, Json> known;
  if (const auto found = known.find(args); found != known.end()) return found->second;
  std::vector<std::string> all{"info", "--json"};
  all.insert(all.end(), args.begin(), args.end());
  const Outcome run = runWhittle(all);
  EXPECT_EQ(run.status, 0) << run.err;
  return known[args] = Json::parse(run.out);
}

TEST(Info, TextHasItsSections) {
  const Outcome run = runWhittle({"info", scene()});
  ASSERT_EQ(run.status, 0) << run.err;
  for (const char* part : {"What is in it", "Needed", "Left out", "Stages that will run", "Buffers on ",
                           "1 camera", "2 lights", "perspective", "no texture images"})
    EXPECT_NE(run.out.find(part), std::string::npos) << part << " in:\n" << run.out;
}

TEST(Info, TextFitsATerminal) {
  for (const char* name : {"cornell_box.glb", "textured.glb", "height_field.glb"})
    for (const char* keep :
         {"", "normal map,absorption,sobol sampler,shadows through transparent surfaces"}) {
      std::istringstream text(
          runWhittle({"info", scene(name), "--bounces", "1", "--keep-features", keep}).out);
      for (std::string line; std::getline(text, line);) EXPECT_LE(columnsOf(line), 80U) << line;
    }
}

TEST(Info, EveryFeatureIsUsedOrLeftOutForAReason) {
  const Json& info = infoOf({scene()});
  for (const char* key : {"file", "triangles", "vertices", "materials", "textures", "lights", "cameras",
                          "features", "stages", "buffers", "device", "warnings", "notes"})
    EXPECT_TRUE(info.contains(key)) << key;
  EXPECT_EQ(info["lights"].size(), 2U);
  EXPECT_FALSE(info["features"]["used"].empty());
  for (const auto& line : info["features"]["leftOut"])
    EXPECT_FALSE(line["reason"].get<std::string>().empty()) << line;
  EXPECT_EQ(infoOf({scene(), "--keep-all-features", "--bounces", "1"})["file"], scene());
}

TEST(Info, KeptFeaturesHaveASectionOfTheirOwn) {
  const std::vector<std::string> keep{"--keep-features", "Normal Map"};
  const Json& features = infoOf({scene(), keep[0], keep[1]})["features"];
  EXPECT_EQ(features["kept"], Json({"textures", "first UV set", "normal map"}));
  EXPECT_EQ(infoOf({scene()})["features"]["kept"], Json::array());
  std::set<std::string> used;
  for (const auto& name : features["used"]) used.insert(name);
  for (const auto& name : features["kept"]) EXPECT_TRUE(used.contains(name)) << name;
  const std::string text = runWhittle({"info", scene(), keep[0], keep[1]}).out;
  const auto needed = text.find("\nNeeded\n"), kept = text.find("\nKept because asked for\n"),
             leftOut = text.find("\nLeft out\n"), named = text.find("normal map");
  ASSERT_TRUE(needed < kept && kept < leftOut && leftOut != std::string::npos) << text;
  EXPECT_TRUE(kept < named && named < leftOut) << text;
  EXPECT_NE(text.find("textures (needed by normal map)"), std::string::npos) << text;
}

TEST(Info, SaysWhichKeptFeaturesASettingRulesOut) {
  const Outcome run = runWhittle({"info", scene(), "--no-shadows", "--keep-features", "shadow rays"});
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.err.find("note: --keep-features: 'shadow rays' stays out: shadows are switched off\n"),
            std::string::npos)
      << run.err;
}

/// The plan is a promise: stages and buffers of a real render are those that info names.
class Plan : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(Plan, IsWhatARenderDoes) {
  const Folder folder;
  std::vector<std::string> args{"--width", "24", "--height", "16"};
  args.insert(args.end(), GetParam().begin(), GetParam().end());
  const Json& info = infoOf(args);
  args.insert(args.begin(), "render");
  args.insert(args.end(), {"--stats", "s.json", "--quiet"});
  const Outcome run = runWhittle(args, {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
  const Json stats = readJson(folder / "s.json");
  std::set<std::string> planned, launched;
  for (const auto& name : info["stages"]) planned.insert(name);
  for (const auto& stage : stats["stages"]) launched.insert(stage["name"]);
  for (const auto& name : launched) EXPECT_TRUE(planned.contains(name)) << name << " ran unannounced";
  // A stage of an empty queue is planned and not launched; these always have entries.
  for (const char* name : {"raygen", "intersect", "shade", "film"})
    EXPECT_TRUE(planned.contains(name) && launched.contains(name)) << name;
  if (!planned.contains("occlude")) {
    EXPECT_EQ(stats["rays"]["shadow"], 0);
  }
  if (!planned.contains("compact_impulse")) {
    EXPECT_EQ(stats["rays"]["impulse"], 0);
  }
  std::map<std::string, std::uint64_t> bytes;
  for (const auto& b : info["buffers"]) bytes[b["name"]] = b["bytes"];
  for (const auto& b : stats["memory"]["buffers"]) {
    // Ray queues come on demand, one more whenever a segment is cut or a bounce follows.
    if (b["name"] == "rays") continue;
    EXPECT_EQ(bytes[b["name"]], b["bytes"]) << b["name"];
  }
  std::set<std::string> named;
  for (const auto& b : stats["memory"]["buffers"]) named.insert(b["name"]);
  for (const auto& b : info["buffers"])
    EXPECT_TRUE(named.contains(b["name"])) << b["name"] << " is not there";
  EXPECT_EQ(info["features"]["used"], stats["features"]["used"]);
  EXPECT_EQ(info["features"]["kept"], stats["features"]["kept"]);
}

INSTANTIATE_TEST_SUITE_P(
    Cli, Plan,
    testing::Values(std::vector<std::string>{scene()}, std::vector<std::string>{scene(), "--no-shadows"},
                    std::vector<std::string>{scene(), "--bounces", "1"},
                    std::vector<std::string>{scene(), "--keep-features", "alpha mask"},
                    std::vector<std::string>{scene(), "--aov", "depth=d.exr"},
                    std::vector<std::string>{scene(), "--adaptive", "--rays-per-pixel", "18"},
                    std::vector<std::string>{scene(), "--target-error", "200%"},
                    std::vector<std::string>{scene("emission.glb")},
                    std::vector<std::string>{scene("textured.glb")},
                    std::vector<std::string>{scene("spot_cone.glb")}));

TEST(Info, TakesAnAuxiliaryOutputWithoutAFile) {
  const auto names = [](const Json& info) {
    std::set<std::string> found;
    for (const auto& b : info["buffers"]) found.insert(b["name"]);
    return found;
  };
  EXPECT_TRUE(names(infoOf({scene(), "--aov", "depth"})).contains("aovs"));
  EXPECT_FALSE(names(infoOf({scene()})).contains("aovs"));
}

TEST(Devices, JsonListsThem) {
  const Outcome run = runWhittle({"devices", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const Json json = Json::parse(run.out);
  ASSERT_TRUE(json["devices"].is_array());
  for (const auto& d : json["devices"]) {
    for (const char* key : {"index", "kind", "platform", "name", "version", "driver", "computeUnits",
                            "globalMemory", "usable", "reason"})
      EXPECT_TRUE(d.contains(key)) << key;
    EXPECT_EQ(d["usable"].get<bool>(), d["reason"].get<std::string>().empty());
  }
}

/// An empty folder of drivers: the loader finds no platform.
class WithoutDevice : public testing::Test {
 protected:
  const Folder folder;
  const RunOptions options{folder.path(),
                           {{"OCL_ICD_VENDORS", folder.path().string() + "/"}, {"OCL_ICD_FILENAMES", ""}}};

  void SetUp() override {
    const Outcome run = runWhittle({"devices", "--json"}, options);
    if (run.status == 0 && !Json::parse(run.out)["devices"].empty())
      GTEST_SKIP() << "this OpenCL loader ignores OCL_ICD_VENDORS";
  }
};

TEST_F(WithoutDevice, DevicesSaysWhatToInstall) {
  const Outcome run = runWhittle({"devices"}, options);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("apt install pocl-opencl-icd"), std::string::npos) << run.out;
}

TEST_F(WithoutDevice, RenderFailsWithoutBlamingTheUser) {
  const Outcome run = runWhittle(smallRender({"-o", "a.png"}), options);
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("no OpenCL device"), std::string::npos) << run.err;
  EXPECT_TRUE(folder.names().empty());
}

TEST_F(WithoutDevice, ReferenceAndInfoStillWork) {
  EXPECT_EQ(
      runWhittle({"reference", scene(), "--width", "4", "--height", "4", "-o", "r.png"}, options).status, 0);
  const Outcome run = runWhittle({"info", scene(), "--json"}, options);
  ASSERT_EQ(run.status, 0) << run.err;
  const Json info = Json::parse(run.out);
  EXPECT_TRUE(info["buffers"].is_null());
  EXPECT_TRUE(info["device"].is_null());
  EXPECT_FALSE(info["stages"].empty());
}

FloatImage constant(int width, int height, int channels, float value) {
  return {width, height, channels,
          std::vector<float>(static_cast<std::size_t>(width) * height * channels, value)};
}

TEST(Compare, KnowsTheNumbersOfFlatPictures) {
  const Folder folder;
  writeExr(folder / "a.exr", constant(4, 4, 3, 0.5F), {});
  writeExr(folder / "b.exr", constant(4, 4, 3, 0.25F), {});
  const Outcome run = runWhittle({"compare", "a.exr", "b.exr", "--json"}, {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["rmse"], 0.25);
  EXPECT_EQ(json["maxAbs"], 0.25);
  EXPECT_NEAR(json["relMse"].get<double>(), 0.0625 / (0.0625 + 0.01), 1e-12);
  EXPECT_EQ(json["differingPixels"], 16);
  EXPECT_GT(json["flip"], 0.0);
  const Json same = Json::parse(runWhittle({"compare", "a.exr", "a.exr", "--json"}, {folder.path(), {}}).out);
  EXPECT_EQ(same["rmse"], 0.0);
  EXPECT_EQ(same["flip"], 0.0);
  EXPECT_EQ(same["differingPixels"], 0);
}

TEST(Compare, OtherSizesAreStatusOne) {
  const Folder folder;
  writeExr(folder / "a.exr", constant(4, 4, 3, 0.5F), {});
  writeExr(folder / "b.exr", constant(4, 5, 3, 0.5F), {});
  writeExr(folder / "c.exr", constant(4, 4, 1, 0.5F), {});
  for (const char* other : {"b.exr", "c.exr"}) {
    const Outcome run = runWhittle({"compare", "a.exr", other, "--json"}, {folder.path(), {}});
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.out, "");
    EXPECT_NE(run.err.find("a.exr"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find(other), std::string::npos) << run.err;
  }
}

TEST(Compare, AlphaIsNoColour) {
  const Folder folder;
  writeExr(folder / "a.exr", constant(4, 4, 4, 0.5F), {});
  writeExr(folder / "b.exr", constant(4, 4, 3, 0.5F), {});
  const Outcome run = runWhittle({"compare", "a.exr", "b.exr", "--json"}, {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(Json::parse(run.out)["rmse"], 0.0);
}

TEST(Compare, NotANumberIsNullInJson) {
  const Folder folder;
  FloatImage a = constant(4, 4, 3, 0.5F);
  a.pixels[5] = std::numeric_limits<float>::quiet_NaN();
  writeExr(folder / "a.exr", a, {});
  writeExr(folder / "b.exr", constant(4, 4, 3, 0.5F), {});
  const Outcome run = runWhittle({"compare", "a.exr", "b.exr", "--json"}, {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_TRUE(json["rmse"].is_null());
  EXPECT_TRUE(json["maxAbs"].is_null());
  EXPECT_EQ(json["nonFinite"], 1);
  EXPECT_EQ(json["nonFiniteReference"], 0);
  EXPECT_EQ(json["differingPixels"], 1);
  EXPECT_NE(run.err.find("not finite: 1 in a.exr"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace whittle::test
