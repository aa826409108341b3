// What a render says about itself adds up, and its JSON has the keys that scripts depend on.
#include "support/pictures.h"

namespace whittle::test {
namespace {

TEST(RenderStats, CountsOfStagesAddUp) {
  for (const char* name : {"cornell_box", "nested_glass", "shadow", "emission"}) {
    Settings settings = smallSettings(6);
    settings.wavefront = 1500;
    settings.raysPerPixel = 2;
    const Stats stats = renderOnDevice(ownScene(name), settings).stats;
    EXPECT_EQ(stats.rays.primary, 2U * 96 * 54) << name;
    EXPECT_EQ(stageOf(stats, "raygen").items, stats.rays.primary) << name;
    EXPECT_EQ(stageOf(stats, "intersect").items, stats.rays.primary + stats.rays.impulse) << name;
    EXPECT_EQ(stageOf(stats, "shade").items, stats.rays.primary + stats.rays.impulse) << name;
    // What eye rays find is their samples' at once.
    EXPECT_EQ(stageOf(stats, "accumulate").items, stats.rays.impulse) << name;
    EXPECT_EQ(stageOf(stats, "occlude").items, stats.rays.shadow) << name;
    EXPECT_EQ(stats.dropped, 0U) << name;
    for (const auto& stage : stats.stages) {
      EXPECT_GT(stage.launches, 0U) << stage.facts.name;
      EXPECT_GE(stage.seconds, 0) << stage.facts.name;
    }
  }
}

TEST(RenderStats, NothingIsTimedWhereNobodyAsks) {
  const Scene scene = ownScene("cornell_box");
  Settings settings = smallSettings(4);
  settings.wavefront = 1500;
  RenderHooks hooks;
  const RenderResult timed = renderOnDevice(scene, settings, hooks);
  hooks.timeStages = false;
  const RenderResult untimed = renderOnDevice(scene, settings, hooks);
  EXPECT_EQ(differingPixels(timed.radiance, untimed.radiance), 0U);
  ASSERT_EQ(timed.stats.stages.size(), untimed.stats.stages.size());
  double seconds = 0.0;
  for (std::size_t i = 0; i < timed.stats.stages.size(); ++i) {
    const StageStats &with = timed.stats.stages[i], &without = untimed.stats.stages[i];
    EXPECT_EQ(with.launches, without.launches) << with.facts.name;
    EXPECT_EQ(with.items, without.items) << with.facts.name;
    EXPECT_EQ(with.bytes, without.bytes) << with.facts.name;
    EXPECT_EQ(without.seconds, 0.0) << without.facts.name;
    seconds += with.seconds;
  }
  EXPECT_GT(seconds, 0.0);
  EXPECT_GT(untimed.stats.time.render, 0.0);
}

TEST(RenderStats, BuffersAreListedByGroup) {
  const Stats stats = renderOnDevice(ownScene("textured"), smallSettings(4)).stats;
  std::map<std::string, std::uint64_t> groups;
  for (const auto& b : stats.buffers) {
    EXPECT_GT(b.bytes, 0U) << b.name;
    groups[b.group] += b.bytes;
  }
  const auto json = statsToJson(stats);
  std::uint64_t total = 0;
  for (const char* group : {"tree", "triangles", "queues", "textures", "film"}) {
    EXPECT_GT(groups[group], 0U) << group;
    EXPECT_EQ(json["memory"][group], groups[group]) << group;
    total += groups[group];
  }
  EXPECT_EQ(groups.size(), 5U);
  EXPECT_EQ(json["memory"]["total"], total);
  EXPECT_EQ(groups["film"], (3U + 1) * 96 * 54 * 4) << "one ray each: the sums and the order of the pixels";
}

TEST(RenderStats, JsonHasEveryKey) {
  Settings settings = smallSettings(3);
  settings.raysPerPixel = 2;
  const auto json = statsToJson(renderOnDevice(ownScene("cornell_box"), settings).stats);
  const auto expectKeys = [](const nlohmann::ordered_json& object, const std::vector<const char*>& keys,
                             const char* where) {
    for (const char* key : keys) EXPECT_TRUE(object.contains(key)) << where << " lacks " << key;
  };
  expectKeys(json,
             {"scene", "settings", "device", "features", "rays", "time", "stages", "memory", "error",
              "cutOffThroughput", "bouncesThroughput", "transparentBouncesThroughput", "biasBound",
              "nonFinite", "dropped"},
             "statistics");
  expectKeys(json["scene"], {"file", "triangles", "materials", "lights", "textures"}, "scene");
  eachSetting(settings,
              [&](const char* name, const auto&) { expectKeys(json["settings"], {name}, "settings"); });
  expectKeys(json["device"], {"platform", "name", "version", "driver", "computeUnits", "threads"}, "device");
  expectKeys(json["features"], {"used", "kept", "leftOut"}, "features");
  expectKeys(json["rays"], {"primary", "impulse", "shadow", "total"}, "rays");
  expectKeys(json["time"], {"load", "build", "compile", "upload", "render", "write", "total"}, "time");
  expectKeys(json["memory"], {"tree", "triangles", "queues", "textures", "film", "total"}, "memory");
  ASSERT_FALSE(json["stages"].empty());
  for (const auto& stage : json["stages"])
    expectKeys(stage, {"name", "launches", "seconds", "items"}, "stage");
  ASSERT_FALSE(json["error"].empty());
  expectKeys(json["error"][0], {"seconds", "raysPerPixel", "estimate", "rmse"}, "error");
  EXPECT_EQ(json["rays"]["total"].get<std::uint64_t>(), json["rays"]["primary"].get<std::uint64_t>() +
                                                            json["rays"]["impulse"].get<std::uint64_t>() +
                                                            json["rays"]["shadow"].get<std::uint64_t>());
  EXPECT_GT(json["time"]["render"].get<double>(), 0);
  EXPECT_GT(json["device"]["computeUnits"].get<int>(), 0);
  EXPECT_FALSE(json["device"]["name"].get<std::string>().empty());
}

}  // namespace
}  // namespace whittle::test
