// No code that the scene does not need, and no difference without it: the kernels cut down to a scene's
// features give the bits of the whole ones, and every cut compiles.
#include <fstream>
#include <set>

#include "cl/kernel_source.h"
#include "pictures.h"
#include "render/scene_features.h"
#include "single_rays.h"
#include "support/test_device.h"

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

const std::vector<std::string> kStages{"raygen.cl",  "intersect.cl",  "shade.cl", "compact.cl",
                                       "occlude.cl", "accumulate.cl", "film.cl"};

/// Empty where the whole program compiles for these features without a word.
std::string buildLog(Compute& compute, std::uint64_t bits) {
  char options[96];
  std::snprintf(options, sizeof options, "-cl-std=CL1.2 -D SCENE_FEATURES=0x%llx",
                static_cast<unsigned long long>(bits));
  compute.build(assembleKernelSource(kStages, testKernelFolder()), options);
  return compute.buildLog();
}

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

/// The kernels as they are, but for one feature that is always there.
class ForcedKernels {
 public:
  explicit ForcedKernels(int bit) {
    folder_ = std::filesystem::temp_directory_path() / ("whittle_forced_" + std::to_string(getpid()));
    for (const auto& [name, text] : embeddedKernelFiles()) {
      const auto file = folder_ / name;
      std::filesystem::create_directories(file.parent_path());
      std::ofstream(file) << (name == "shared/features.h" ? forced(text, bit) : text);
    }
  }
  ForcedKernels(const ForcedKernels&) = delete;
  ForcedKernels& operator=(const ForcedKernels&) = delete;
  ~ForcedKernels() { std::filesystem::remove_all(folder_); }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  static std::string forced(std::string text, int bit) {
    const std::string from = "((SCENE_FEATURES >> BIT_##feature) & 1)";
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << "features.h asks in another way now";
    return text.replace(
        at, from.size(),
        "(((SCENE_FEATURES >> BIT_##feature) & 1) || BIT_##feature == " + std::to_string(bit) + ")");
  }

  std::filesystem::path folder_;
};

/// Features that change what a work item is or which data it finds: the host must know of them.
bool isContract(Feature f) { return f == Feature::PACKETS || f == Feature::TREE; }

TEST(Features, EachOneThatASceneDoesNotNeedChangesNothing) {
  const Scene scene = plainScene();
  Settings settings;
  settings.width = settings.height = 8;
  const RenderResult plain = renderOnDevice(scene, settings);
  EXPECT_GT(colorOf(plain, 36).x, 0);
  const SceneFeatures features = SceneFeatures::analyse(scene, settings, {true});
  std::size_t forced = 0;
  for (const auto& line : features.lines()) {
    if (line.used || isContract(line.feature)) continue;
    const ForcedKernels kernels(static_cast<int>(line.feature));
    RenderHooks hooks;
    hooks.kernelFolder = kernels.folder();
    EXPECT_EQ(differingPixels(plain.radiance, renderOnDevice(scene, settings, hooks).radiance), 0U)
        << line.text;
    ++forced;
  }
  EXPECT_GT(forced, 30U);
}

TEST(Features, EachAloneAndAllTogetherCompileWithoutAWarning) {
  Compute compute = openTestDevice();
  EXPECT_EQ(buildLog(compute, 0), "");
  EXPECT_EQ(buildLog(compute, ~std::uint64_t{0} >> 1), "");
#define WHITTLE_BUILD(name, bit, text) EXPECT_EQ(buildLog(compute, std::uint64_t{1} << (bit)), "") << (text);
  WHITTLE_FEATURES(WHITTLE_BUILD)
#undef WHITTLE_BUILD
}

TEST(Features, BothListsOfBitsSayTheSame) {
  const std::string& text = embeddedKernelFiles().at("shared/features.h");
  std::size_t bits = 0;
  for (std::size_t at = text.find("#define BIT_"); at != std::string::npos;
       at = text.find("#define BIT_", at + 1))
    ++bits;
#define WHITTLE_COUNT(name, bit, words) +1
  EXPECT_EQ(bits, std::size_t{0 WHITTLE_FEATURES(WHITTLE_COUNT)});
#undef WHITTLE_COUNT
#define WHITTLE_COMPARE(name, bit, words) \
  EXPECT_NE(text.find("#define BIT_" #name " " #bit "\n"), std::string::npos) << (words);
  WHITTLE_FEATURES(WHITTLE_COMPARE)
#undef WHITTLE_COMPARE
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
  const auto add = [&](const Scene& scene) {
    Settings settings = smallSettings();
    sets.insert(SceneFeatures::analyse(scene, settings, {true}).bits());
    settings.bounces = 1;
    settings.shadows = false;
    sets.insert(SceneFeatures::analyse(scene, settings, {true}).bits());
  };
  for (const auto& name : ownScenes()) add(ownScene(name));
  for (const auto& file : sharedGltfScenes()) add(loadScene(file));
  EXPECT_GT(sets.size(), 20U);
  Compute compute = openTestDevice();
  for (const std::uint64_t bits : sets) EXPECT_EQ(buildLog(compute, bits), "") << std::hex << bits;
}

}  // namespace
}  // namespace whittle::test
