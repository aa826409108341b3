// No code that the scene does not need, and no difference without it: the kernels cut down to a scene's
// features give the bits of the whole ones, and every cut compiles.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "analysis/feature_needs.h"
#include "analysis/scene_features.h"
#include "cl/kernel_source.h"
#include "programs/kernel_programs.h"
#include "support/pictures.h"
#include "support/single_rays.h"
#include "support/test_device.h"
#include "wavefront/stages.h"

namespace whittle::test {
namespace {

class OwnSceneFeatures : public ::testing::TestWithParam<std::string> {};

TEST_P(OwnSceneFeatures, SpecialisedKernelsGiveTheBitsOfTheWholeOnes) {
  const Scene scene = ownScene(GetParam());
  Settings settings = smallSettings(6);
  const RenderResult special = renderOnDevice(scene, settings);
  settings.keepAllFeatures = true;
  const RenderResult whole = renderOnDevice(scene, settings);
  EXPECT_EQ(differingPixels(special.radiance, whole.radiance), 0U);
  EXPECT_EQ(special.stats.rays.total(), whole.stats.rays.total());
  EXPECT_GT(whole.stats.featuresUsed.size(), special.stats.featuresUsed.size());
}

INSTANTIATE_TEST_SUITE_P(Scenes, OwnSceneFeatures, ::testing::ValuesIn(ownScenes()),
                         [](const auto& scene) { return scene.param; });

/// Compiles each of the programs of a set of features once, however many sets ask for it.
class ProgramBuilds {
 public:
  ProgramBuilds() : compute_(openTestDevice()) {}

  /// What the compiler said of the programs that are new; not optimised, they take half the time.
  std::string log(std::uint64_t bits, const char* options = kNotOptimised) {
    const SceneFeatures features = SceneFeatures::ofBits(bits);
    std::string said;
    for (const KernelProgram& program :
         kernelPrograms(features, plannedStages({features, 2, 16}), testKernelFolder())) {
      if (!built_.emplace(program.name, program.features).second) continue;
      compute_.build(program.source,
                     fmt::format("-cl-std=CL1.2 -D SCENE_FEATURES=0x{:x}{}", program.features, options));
      said += compute_.buildLog();
    }
    return said;
  }
  /// Different programs of this name so far.
  std::ptrdiff_t different(const std::string& name) const {
    return std::count_if(built_.begin(), built_.end(),
                         [&](const auto& built) { return built.first == name; });
  }

 private:
  Compute compute_;
  std::set<std::pair<std::string, std::uint64_t>> built_;
};

/// A floor with vertex normals, a light without shadows, nothing else.
Scene plainScene() {
  Scene scene;
  addFloor(scene, lambert({0.5F, 0.25F, 0.75F}), 0, true, 4);
  scene.normals.assign(scene.positions.size(), glm::vec3(0, 1, 0));  // what is interpolated needs corners
  scene.lights.push_back(pointLight({1, 2, 0.5F}, 20));
  scene.lights[0].castsShadows = false;
  Camera camera;
  camera.position = {0.3F, 3, 4};
  aim(camera, {0, -0.6, -1});
  scene.cameras = {camera};
  return scene;
}

/// Features that the programs of these settings are told of: their text comes to where it asks for them.
std::uint64_t compiledIn(const SceneFeatures& features) {
  std::uint64_t bits = 0;
  for (const KernelProgram& p : kernelPrograms(features, plannedStages({features, 1, 8}))) bits |= p.features;
  return bits;
}

TEST(Features, EachOneThatIsKeptIsCompiledInWithWhatItNeeds) {
  const Scene scene = plainScene();
  // Without a light nothing of light is there yet.
  Scene dark = scene;
  dark.lights.clear();
  for (const Scene* s : {&scene, static_cast<const Scene*>(&dark)})
    for (const Feature f : allFeatures()) {
      Settings settings;
      if (f == Feature::ONE_IMPULSE) settings.impulses = ImpulseMode::One;
      const std::uint64_t without = SceneFeatures::analyse(*s, settings, {true}).bits();
      settings.keepFeatures = bitOf(f);
      const SceneFeatures features = SceneFeatures::analyse(*s, settings, {true});
      EXPECT_TRUE(features.has(f)) << featureText(f);
      // No text asks for random places: they are what is left of the samplers.
      const std::uint64_t kept = features.bits() & ~without & ~bitOf(Feature::SAMPLER_RANDOM);
      EXPECT_EQ(kept & ~compiledIn(features), 0U) << featureText(f);
      for (const auto& line : features.lines()) {
        EXPECT_EQ(line.forced, line.used && !(without & bitOf(line.feature))) << line.text;
        EXPECT_EQ(!line.neededBy.empty(), line.forced && line.feature != f) << line.text;
      }
    }
}

TEST(Features, ANormalMapBringsTexturesAndAWayToReadThem) {
  Settings settings;
  const Scene scene = plainScene();
  const std::uint64_t without = SceneFeatures::analyse(scene, settings, {true}).bits();
  settings.keepFeatures = bitOf(Feature::NORMAL_TEXTURE);
  EXPECT_EQ(SceneFeatures::analyse(scene, settings, {true}).bits() & ~without,
            bitOf(Feature::NORMAL_TEXTURE) | bitOf(Feature::TEXTURES) | bitOf(Feature::UV0));
  settings.keepFeatures = bitOf(Feature::ABSORPTION);
  EXPECT_EQ(SceneFeatures::analyse(scene, settings, {true}).bits() & ~without,
            bitOf(Feature::ABSORPTION) | bitOf(Feature::TRANSMISSION) | bitOf(Feature::IMPULSES));
}

/// What scenes need holds together by itself: the table asks for nothing that the analysis would leave out.
TEST(Features, OwnScenesNeedNothingMore) {
  for (const auto& name : ownScenes()) {
    const SceneFeatures features = SceneFeatures::analyse(ownScene(name), smallSettings(), {true});
    for (const FeatureNeed& need : featureNeeds())
      if (features.has(need.feature)) {
        EXPECT_TRUE(
            std::any_of(need.oneOf.begin(), need.oneOf.end(), [&](Feature f) { return features.has(f); }))
            << name << ": " << featureText(need.feature);
      }
  }
}

/// Keeping never goes against a setting; a line says so.
TEST(Features, WhatASettingRulesOutIsNotKept) {
  Scene scene = plainScene();
  scene.lights[0].castsShadows = true;
  Settings settings;
  settings.width = settings.height = 8;
  settings.shadows = false;
  const RenderResult plain = renderOnDevice(scene, settings);
  settings.keepFeatures = bitOf(Feature::SHADOWS) | bitOf(Feature::FILTERED_SHADOWS) |
                          bitOf(Feature::ONE_IMPULSE) | bitOf(Feature::METAL);
  EXPECT_EQ(uselessKeeps(settings).size(), 3U);
  const RenderResult kept = renderOnDevice(scene, settings);
  EXPECT_EQ(kept.stats.rays.shadow, 0U);
  EXPECT_EQ(differingPixels(plain.radiance, kept.radiance), 0U);
  EXPECT_EQ(statsToJson(kept.stats)["features"]["kept"],
            nlohmann::json({featureText(Feature::MICROFACET), featureText(Feature::METAL)}));
}

/// In groups: those whose place in the list has one of its lowest three bits set, or not set. So each is
/// tried with and without most of the others, and the groups that fail have the culprit in common.
TEST(Features, ThoseThatASceneDoesNotNeedChangeNothing) {
  const Scene scene = plainScene();
  Settings settings;
  settings.width = settings.height = 8;
  const RenderResult plain = renderOnDevice(scene, settings);
  EXPECT_GT(colorOf(plain, 36).x, 0);
  std::vector<FeatureLine> spare;
  const SceneFeatures features = SceneFeatures::analyse(scene, settings, {true});
  for (const auto& line : features.lines())
    if (!line.used) spare.push_back(line);
  EXPECT_GT(spare.size(), 30U);
  ASSERT_LE(spare.size(), 64U);
  for (std::size_t bit = 0; bit < 3; ++bit)
    for (const std::size_t side : {0U, 1U}) {
      Settings forced = settings;
      std::string names;
      std::vector<std::string> texts;
      for (std::size_t i = 0; i < spare.size(); ++i) {
        if ((i >> bit & 1U) != side) continue;
        if (spare[i].feature == Feature::ONE_IMPULSE) forced.impulses = ImpulseMode::One;
        forced.keepFeatures |= bitOf(spare[i].feature);
        texts.push_back(spare[i].text);
        names += fmt::format("{}, ", spare[i].text);
      }
      const RenderResult more = renderOnDevice(scene, forced);
      EXPECT_EQ(differingPixels(plain.radiance, more.radiance), 0U) << names;
      const auto& kept = more.stats.featuresForced;
      for (const std::string& text : texts)
        EXPECT_NE(std::find(kept.begin(), kept.end(), text), kept.end()) << text;
      EXPECT_EQ(more.stats.featuresUsed.size(), plain.stats.featuresUsed.size() + kept.size()) << names;
    }
}

TEST(Features, EachAloneAndAllTogetherCompileWithoutAWarning) {
  ProgramBuilds builds;
  EXPECT_EQ(builds.log(0, ""), "");  // the optimiser warns as well
  EXPECT_EQ(builds.log(~std::uint64_t{0} >> 1, ""), "");
#define WHITTLE_BUILD(name, bit, text) EXPECT_EQ(builds.log(std::uint64_t{1} << (bit)), "") << (text);
  WHITTLE_FEATURES(WHITTLE_BUILD)
#undef WHITTLE_BUILD
}

std::vector<std::filesystem::path> sharedGltfScenes() {
  std::vector<std::filesystem::path> files;
  const auto root = std::filesystem::path(WHITTLE_SHARED) / "gltf";
  if (!std::filesystem::exists(root)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const auto extension = entry.path().extension();
    const auto folder = entry.path().parent_path().filename();
    if (extension == ".glb" || (extension == ".gltf" && folder == "glTF")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(Features, EverySetThatScenesAskForCompilesWithoutAWarning) {
  std::set<std::uint64_t> sets;
  const auto add = [&](const Scene& scene, const Settings& settings) {
    sets.insert(SceneFeatures::analyse(scene, settings, {true}).bits());
  };
  Settings least = smallSettings();
  least.bounces = 1;
  least.shadows = false;
  for (const auto& name : ownScenes()) add(ownScene(name), smallSettings()), add(ownScene(name), least);
  for (const auto& file : sharedGltfScenes()) add(loadScene(file), smallSettings());
  EXPECT_GT(sets.size(), 20U);
  ProgramBuilds builds;
  for (const std::uint64_t bits : sets) EXPECT_EQ(builds.log(bits), "") << std::hex << bits;
  // Scenes differ in how they shade; what they share is compiled once.
  // Queues differ in what their entries carry: with and without impulses, and their cones where textures are
  // filtered.
  EXPECT_LE(builds.different("queues"), 8);
  EXPECT_LE(builds.different("searches"), static_cast<std::ptrdiff_t>(sets.size() / 2));
  RecordProperty("sets", static_cast<int>(sets.size()));
  for (const char* name : {"queues", "searches", "shading"})
    RecordProperty(name, static_cast<int>(builds.different(name)));
}

}  // namespace
}  // namespace whittle::test
