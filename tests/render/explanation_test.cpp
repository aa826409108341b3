// The ray trees of pixels: their sums are the pixels, their rays those that are counted.
#include "render/explanation.h"

#include <cmath>

#include "render/render_session.h"

#include "support/pictures.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

Settings explainSettings(int bounces, int samples) {
  Settings settings = wholeSettings(bounces);
  settings.width = 16, settings.height = 9;
  settings.raysPerPixel = samples;
  return onTestDevice(settings);
}

void expectSums(const Scene& scene, Lanes lanes, const std::string& name) {
  Settings settings = explainSettings(8, 1);
  settings.lanes = lanes;
  RenderSession session;
  const RenderResult picture = session.render(scene, settings, testHooks());
  std::uint64_t primary = 0, impulse = 0, shadow = 0;
  for (int y = 0; y < settings.height; y += 1)
    for (int x = 0; x < settings.width; x += 1) {
      const auto trees = session.explain(scene, settings, x, y, testHooks());
      ASSERT_EQ(trees.size(), 1U);
      const glm::dvec3 pixel(colorOf(picture, static_cast<std::size_t>(y * settings.width + x)));
      ASSERT_EQ(pixel, trees[0].radiance) << name << " " << x << "," << y;
      const glm::dvec3 sum = sumOf(trees[0]);
      ASSERT_NEAR(glm::length(sum - pixel), 0, 2e-6 * (1 + glm::length(pixel)))
          << name << " " << x << "," << y;
      ++primary;
      impulse += trees[0].rays.size() - 1;
      for (const auto& ray : trees[0].rays) shadow += ray.shadows.size();
    }
  EXPECT_EQ(primary, picture.stats.rays.primary) << name;
  EXPECT_EQ(impulse, picture.stats.rays.impulse) << name;
  EXPECT_EQ(shadow, picture.stats.rays.shadow) << name;
}

/// Every pixel, through glass, mirrors, textures and layers, with both forms of the kernels.
TEST(Explanation, SumsAreThePixelsAndRaysThoseThatAreCounted) {
  for (const char* name : {"cornell_box", "nested_glass", "textured"})
    for (const Lanes lanes : {Lanes::Auto, Lanes::One}) expectSums(ownScene(name), lanes, name);
}

/// One ray becomes three, and a light has two turns.
TEST(Explanation, SumsAreThePixelsWhereColoursSplitAndLightComesThrough) {
  Scene scene = ownScene("nested_glass");
  for (Material& m : scene.materials) {
    m.dispersion = 2;
    m.diffuseTransmission = 0.4F;
  }
  expectSums(scene, Lanes::Auto, "split");
}

TEST(Explanation, SamplesMeanThePixel) {
  const Scene scene = ownScene("nested_glass");
  const Settings settings = explainSettings(6, 5);
  RenderSession session;
  const RenderResult picture = session.render(scene, settings, testHooks());
  const auto trees = session.explain(scene, settings, 8, 4, testHooks());
  ASSERT_EQ(trees.size(), 5U);
  glm::dvec3 mean(0);
  for (const auto& tree : trees) mean += tree.radiance / 5.0;
  EXPECT_NEAR(glm::length(mean - glm::dvec3(colorOf(picture, 4 * 16 + 8))), 0, 1e-6);
}

/// A pane before a mirror: two reflections, one passage, and what each carries.
TEST(Explanation, NamesWhatARayDoes) {
  Scene scene;
  addFloor(scene, emitter({1, 0.5F, 0.25F}), 0, true, 4);
  Material pane = glass(1.5F, false);
  pane.name = "pane";
  addQuad(scene, addMaterial(scene, pane), {-4, 1, -4}, {0, 0, 8}, {8, 0, 0});
  addFloor(scene, mirror(glm::vec3(0.5F)), 3, false, 4);
  scene.cameras = {lookingDown()};
  scene.cameras[0].position = {0, 2, 0};
  Settings settings = explainSettings(4, 1);
  RenderSession session;
  const Explanation e{8, 4, session.explain(scene, settings, 8, 4, testHooks()), {}};
  const auto& rays = e.trees[0].rays;
  ASSERT_GE(rays.size(), 3U);
  ASSERT_TRUE(rays[0].hit);
  EXPECT_EQ(scene.materials[rays[0].hit->material].name, "pane");
  EXPECT_NEAR(rays[0].hit->position.y, 1, 1e-6);
  EXPECT_EQ(rays[0].hit->normal, glm::dvec3(0, 1, 0));
  int reflected = 0, straight = 0;
  for (const auto& ray : rays)
    if (ray.parent == 0) {
      const Passage passage = passageOf(ray, rays[0]);
      reflected += passage == Passage::Reflected;
      straight += passage == Passage::Straight;
      if (passage == Passage::Reflected) {
        EXPECT_NEAR(ray.throughput.x, 0.04, 1e-4) << "Fresnel, head on";
      }
    }
  EXPECT_EQ(reflected, 1);
  EXPECT_EQ(straight, 1);
  const std::string text = explanationText(e, scene, settings);
  for (const char* words : {"pixel 8,4 of 16×9", "eye ray from", "meets \"pane\"", "straight on", "reflected",
                            "without shadow rays 1 0.5 0.25", "sum of"})
    EXPECT_NE(text.find(words), std::string::npos) << words << " in\n" << text;
  const auto json = explanationToJson(e, scene);
  EXPECT_EQ(json["samples"][0]["rays"].size(), rays.size());
  EXPECT_EQ(json["samples"][0]["rays"][0]["kind"], "eye");
}

TEST(Explanation, TellsBlockedShadowRaysAndWhatEnds) {
  Scene scene;
  addFloor(scene, lambert(glm::vec3(0.5F)), 0, true, 4);
  addFloor(scene, lambert(glm::vec3(0.5F)), 2, false, 4);
  scene.lights = {pointLight({0, 4, 0}, 10), pointLight({0, 1, 0}, 10)};
  scene.cameras = {lookingDown()};
  scene.cameras[0].position = {0.1F, 1.5F, 0.1F};
  RenderSession session;
  const auto trees = session.explain(scene, explainSettings(1, 1), 8, 4, testHooks());
  const auto& ray = trees[0].rays[0];
  ASSERT_EQ(ray.shadows.size(), 2U);
  EXPECT_EQ(ray.shadows[0].light, 0U);
  EXPECT_EQ(ray.shadows[0].arrived, glm::dvec3(0));
  EXPECT_EQ(ray.shadows[1].arrived, ray.shadows[1].contribution);
  EXPECT_GT(ray.shadows[1].arrived.x, 0);
}

}  // namespace
}  // namespace whittle::test
