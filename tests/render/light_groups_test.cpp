// Lights that are shaded together: which ones, and that the picture is the sum of those of each light alone,
// the slow twin, to the bit.
#include "analysis/light_groups.h"

#include <fmt/format.h>

#include "support/pictures.h"
#include "support/probe.h"
#include "support/spheres.h"

namespace whittle::test {
namespace {

/// Lamps in a row, one for each character: s casts shadows, anything else does not.
std::vector<Light> lamps(const std::string& kinds) {
  std::vector<Light> lights;
  for (const char kind : kinds) {
    const auto at = static_cast<float>(lights.size());
    lights.push_back(pointLight({at - 3, 3, 0.5F * at}, 10 + at));
    lights.back().castsShadows = kind == 's';
  }
  return lights;
}

/// Their groups, as "first-end:waiting".
std::string groupsOf(const std::string& kinds, bool shadows = true) {
  Scene scene;
  addFloor(scene, lambert(glm::vec3(1)), 0);
  scene.lights = lamps(kinds);
  Settings settings;
  settings.shadows = shadows;
  const PrunedScene pruned = pruneScene(scene, settings);
  std::string text;
  for (const LightGroup& g : lightGroups(scene, pruned, SceneFeatures::analyse(scene, pruned, settings, {})))
    text += fmt::format(" {}-{}:{}", g.first, g.end, g.waiting);
  return text;
}

TEST(LightGroups, KeepTheOrderOfTheLights) {
  static_assert(kLightsWaiting == 4);
  EXPECT_EQ(groupsOf(""), " 0-0:0") << "shade runs without a light";
  EXPECT_EQ(groupsOf("s"), " 0-1:1");
  EXPECT_EQ(groupsOf("ssss"), " 0-4:4");
  EXPECT_EQ(groupsOf("sssss"), " 0-4:4 4-5:1");
  EXPECT_EQ(groupsOf("--s"), " 0-3:1");
  EXPECT_EQ(groupsOf("s--"), " 0-3:3") << "what comes behind a shadow waits for it";
  EXPECT_EQ(groupsOf("-s-ss--s"), " 0-5:4 5-8:1");
  EXPECT_EQ(groupsOf("------"), " 0-6:0") << "what casts no shadow takes no room";
  EXPECT_EQ(groupsOf("s-ssss", false), " 0-6:0");
}

/// A ball and a glossy floor under seven lamps. What a lamp adds to black is exact, so floats of the pictures
/// of each, added in the order of the lamps, are those of all.
TEST(LightGroups, GiveTheSumOfEachLightAlone) {
  Scene scene;
  Material rough = lambert({0.7F, 0.5F, 0.3F});
  rough.roughness = 0.5F;
  addFloor(scene, rough, 0, true, 4);
  addSphere(scene, addMaterial(scene, lambert({0.3F, 0.6F, 0.9F})), {0, 0.8F, 0}, 0.7F, 12, 24);
  scene.cameras = {lookingDown()};
  Settings settings = smallSettings(1);
  for (const std::string kinds : {"sssssss", "s-s-sss", "--sssss", "sssss--"}) {
    const std::vector<Light> lights = lamps(kinds);
    scene.lights = lights;
    const RenderResult all = renderOnDevice(scene, settings);
    FloatImage sum = all.radiance;
    std::fill(sum.pixels.begin(), sum.pixels.end(), 0.0F);
    for (const Light& light : lights) {
      scene.lights = {light};
      const FloatImage one = renderOnDevice(scene, settings).radiance;
      for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += one.pixels[i];
    }
    EXPECT_EQ(differingPixels(all.radiance, sum), 0U) << kinds;
    EXPECT_GT(all.stats.rays.shadow, 0U);
    EXPECT_GT(stageOf(all.stats, "shade_light").launches, 0U) << "or there is one group alone";
  }
}

}  // namespace
}  // namespace whittle::test
