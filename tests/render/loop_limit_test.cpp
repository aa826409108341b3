// On a device whose driver ends loops (cl/device_facts.h) launches are cut, and no bit tells; what would not
// fit is refused. The facts are set by hand, so that any device stands for such a one.
#include <gtest/gtest.h>

#include "programs/kernel_programs.h"
#include "report/stats.h"
#include "scene/input_error.h"
#include "support/pictures.h"
#include "support/probe.h"
#include "support/text.h"

namespace whittle {
namespace {

Settings singleRays() {
  Settings settings = test::smallSettings(3);
  settings.lanes = Lanes::One;
  settings.raysPerPixel = 4;
  return settings;
}

RenderResult renderKnowing(const DeviceFacts& facts, const Scene& scene, const Settings& settings,
                           Trace* trace = nullptr) {
  OpenDevice device{test::openTestDevice()};
  device.compute.know(facts);
  RenderHooks hooks = test::testHooks();
  hooks.device = &device;
  hooks.trace = trace;
  return render(scene, settings, hooks);
}

TEST(LoopLimit, ChangesNoBit) {
  const Scene scene = test::ownScene("cornell_box");
  const RenderResult free = renderKnowing({}, scene, singleRays()),
                     limited = renderKnowing({65535, true}, scene, singleRays());
  EXPECT_EQ(test::differingPixels(free.radiance, limited.radiance), 0U);
  // Budget 93: five samples and one light at once.
  Settings settings = singleRays();
  settings.search = Search::Array;
  settings.raysPerPixel = 16;
  Scene few;
  test::addFloor(few, test::lambert({0.5F, 0.7F, 0.9F}), 0);
  test::addQuad(few, test::addMaterial(few, test::mirror({0.8F, 0.8F, 0.8F})), {-0.5F, 0.5F, -0.5F},
                {0, 0.2F, 1}, {1, 0, 0});
  for (const float x : {-1.0F, 0.3F, 2.0F}) few.lights.push_back(test::pointLight({x, 3, 0}, 20));
  few.cameras.push_back(test::lookingDown());
  EXPECT_EQ(test::differingPixels(renderKnowing({}, few, settings).radiance,
                                  renderKnowing({1500, true}, few, settings).radiance),
            0U);
}

TEST(LoopLimit, TooManyTrianglesWithoutATreeAreRefused) {
  Settings settings = singleRays();
  settings.search = Search::Array;
  const Scene scene = test::ownScene("cornell_box");
  ASSERT_GT(scene.triangles.size(), 4095U);
  try {
    renderKnowing({65535, true}, scene, settings);
    FAIL() << "drawn";
  } catch (const InputError& e) {
    EXPECT_TRUE(test::contains(e.what(), "--search: array takes at most 4,094 triangles")) << e.what();
  }
  settings.search = Search::Tree;
  settings.lanes = Lanes::Sixteen;
  EXPECT_THROW(renderKnowing({65535, true}, scene, settings), InputError) << "packets have no budget";
}

TEST(LoopLimit, AWalkThatWouldBeEndedIsAnError) {
  try {
    renderKnowing({160, true}, test::ownScene("cornell_box"), singleRays());  // ten steps
    FAIL() << "drawn";
  } catch (const ClError& e) {
    EXPECT_TRUE(test::contains(e.what(), "ends loops after 160 iterations")) << e.what();
  }
}

TEST(EventTimes, WhereTheDriverGivesNoneTheHostsClockIsUsedAndStatisticsHaveNull) {
  Trace trace;
  const RenderResult result = renderKnowing({0, false}, test::ownScene("spot_cone"), singleRays(), &trace);
  double sum = 0.0;
  for (const StageStats& stage : result.stats.stages) {
    EXPECT_GT(stage.seconds, 0.0) << stage.facts.name;
    sum += stage.seconds;
  }
  EXPECT_LE(sum, result.stats.time.render * 1.001) << "one after the other, they fit into the whole";
  const auto json = statsToJson(result.stats);
  EXPECT_FALSE(json["device"]["givesTimes"].get<bool>());
  for (const auto& stage : json["stages"]) EXPECT_TRUE(stage["seconds"].is_null()) << stage;
  for (const auto& bounce : json["bounces"])
    for (const auto& stage : bounce["stages"]) EXPECT_TRUE(stage["seconds"].is_null()) << stage;
  EXPECT_TRUE(test::contains(trace.toText(), "device, by the host's clock"));
}

}  // namespace
}  // namespace whittle
