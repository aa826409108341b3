// Which general program draws which scene: it can all that the scene needs, and nothing that goes against a
// setting.
#include "analysis/general_features.h"

#include <gtest/gtest.h>

#include "support/pictures.h"

namespace whittle::test {
namespace {

std::string nameFor(const SceneFeatures& features, const Settings& settings) {
  const auto program = generalProgramFor(features, settings);
  return program ? program->name : "";
}

std::string nameFor(const std::string& scene, const Settings& settings = {}) {
  return nameFor(SceneFeatures::analyse(ownScene(scene), settings, {}), settings);
}

TEST(GeneralPrograms, OwnScenesStartOnThePlainOne) {
  for (const std::string& scene : ownScenes()) EXPECT_EQ(nameFor(scene), "plain") << scene;
}

TEST(GeneralPrograms, EachOptionHasTheProgramThatCanIt) {
  const auto with = [](auto&& change) {
    Settings settings;
    change(settings);
    return nameFor("cornell_box", settings);
  };
  EXPECT_EQ(with([](Settings& s) { s.raysPerPixel = 16, s.sampler = Sampler::Sobol; }), "plain");
  EXPECT_EQ(with([](Settings& s) { s.rayOffset = 1e-3F; }), "plain");
  EXPECT_EQ(with([](Settings& s) { s.ambient = 0.2F; }), "plain");
  EXPECT_EQ(with([](Settings& s) { s.lightRadius = 0.1F; }), "rich");
  EXPECT_EQ(with([](Settings& s) { s.aperture = 0.1F; }), "rich");
  EXPECT_EQ(with([](Settings& s) { s.glossy = true; }), "rich");
  EXPECT_EQ(with([](Settings& s) { s.cutoff = 0.1F; }), "rich");
  EXPECT_EQ(with([](Settings& s) { s.aovs = true; }), "rich");
  // These say that something is not to be: a program that has it would draw another picture.
  EXPECT_EQ(with([](Settings& s) { s.shadows = false; }), "");
  EXPECT_EQ(with([](Settings& s) { s.search = Search::Array; }), "");
  EXPECT_EQ(with([](Settings& s) { s.backFaces = BackFaces::Show; }), "");
  EXPECT_EQ(with([](Settings& s) { s.smoothTerminator = false; }), "");
  EXPECT_EQ(with([](Settings& s) { s.impulses = ImpulseMode::One; }), "");
  EXPECT_EQ(with([](Settings& s) { s.bounces = 1; }), "");
  // And these have planes or arithmetic of their own.
  EXPECT_EQ(with([](Settings& s) { s.alpha = true; }), "");
  EXPECT_EQ(with([](Settings& s) { s.costAov = true; }), "");
  EXPECT_EQ(with([](Settings& s) { s.relaxedArithmetic = true; }), "");
  EXPECT_EQ(with([](Settings& s) { s.keepAllFeatures = true; }), "");
}

TEST(GeneralPrograms, TheRichOneCanAllThatThePlainOneCan) {
  for (const bool packets : {false, true}) {
    const auto programs = generalPrograms(packets);
    EXPECT_EQ(programs[0].features & ~programs[1].features, 0U);
    for (const GeneralProgram& program : programs)
      EXPECT_EQ((program.features & bitOf(Feature::PACKETS)) != 0, packets);
  }
}

/// One ray for each work item and sixteen are different programs, of which the device has one.
TEST(GeneralPrograms, LanesAreThoseOfTheScene) {
  Settings settings;
  settings.lanes = Lanes::One;
  const auto features = SceneFeatures::analyse(ownScene("mirror"), settings, {});
  const auto program = generalProgramFor(features, settings);
  ASSERT_TRUE(program);
  EXPECT_EQ(program->features & bitOf(Feature::PACKETS), 0U);
}

}  // namespace
}  // namespace whittle::test
