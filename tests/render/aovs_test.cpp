// Auxiliary outputs that are made of all rays of a sample, against the ray trees of their pixels and against
// what can be counted by hand.
#include "render/aovs.h"

#include <cmath>

#include "render/explanation.h"
#include "render/render_session.h"
#include "support/pictures.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

Settings aovSettings(int bounces, int samples, std::initializer_list<const char*> names) {
  Settings settings = wholeSettings(bounces);
  settings.width = 16, settings.height = 9;
  settings.raysPerPixel = samples;
  for (const char* name : names) askForAov(settings, name);
  return onTestDevice(settings);
}

double luminanceOf(const glm::dvec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

/// 1 for the eye ray, one more for each reflection or refraction on the way.
int bouncesOf(const RayTree& tree, std::size_t ray) {
  int bounces = 1;
  for (int at = static_cast<int>(ray); at > 0; at = tree.rays[static_cast<std::size_t>(at)].parent)
    bounces += !tree.rays[static_cast<std::size_t>(at)].goesStraight;
  return bounces;
}

/// The slow twin: every ray of the pixel's first sample by itself.
double bounceOf(const RayTree& tree) {
  double light = 0, weighted = 0;
  for (std::size_t i = 0; i < tree.rays.size(); ++i) {
    const double share = luminanceOf(shareOf(tree.rays[i]));
    light += share, weighted += share * bouncesOf(tree, i);
  }
  return light > 0 ? weighted / light : 0;
}

/// Through glass, mirrors and layers; more samples than one, and a wavefront that cuts the picture into
/// batches.
TEST(AovsOfRays, BounceIsThatOfTheRayTree) {
  for (const char* name : {"cornell_box", "nested_glass", "textured"}) {
    const Scene scene = ownScene(name);
    Settings settings = aovSettings(8, 3, {"bounce"});
    settings.wavefront = 1024;
    RenderSession session;
    const RenderResult result = session.render(scene, settings, testHooks());
    const FloatImage& bounce = result.aovs.at("bounce");
    for (int y = 0; y < settings.height; ++y)
      for (int x = 0; x < settings.width; ++x) {
        const auto trees = session.explain(scene, settings, x, y, testHooks(), 1);
        const auto seen =
            static_cast<double>(bounce.pixels[static_cast<std::size_t>(y * settings.width + x)]);
        ASSERT_NEAR(seen, bounceOf(trees[0]), 1e-5 * std::max(1.0, seen)) << name << " " << x << "," << y;
      }
  }
}

TEST(AovsOfRays, LightBehindAMirrorIsOfTheSecondBounceBehindAPaneOfTheFirst) {
  Scene scene;
  addFloor(scene, mirror(glm::vec3(0.9F)), 0, true, 4);
  addQuad(scene, addMaterial(scene, veil(0.5F)), {-4, 1, -4}, {0, 0, 8}, {8, 0, 0});
  addFloor(scene, emitter({1, 1, 1}), 5, false, 4);
  scene.cameras = {lookingDown()};
  scene.cameras[0].position = {0, 2, 0};
  const Settings settings = aovSettings(4, 1, {"bounce"});
  RenderSession session;
  const auto middle = [&] {
    return session.render(scene, settings, testHooks()).aovs.at("bounce").pixels[4 * 16 + 8];
  };
  EXPECT_EQ(middle(), 2.0F) << "the veil gives off nothing; the mirror shows the light above";
  scene.cameras[0].position = {0, 4, 0};
  aim(scene.cameras[0], {0, 1, 0});
  EXPECT_EQ(middle(), 1.0F) << "the light itself";
  session.sceneChanged();
  scene.materials[scene.triangles.back().material].emission = glm::vec3(0);
  EXPECT_EQ(middle(), 0.0F) << "no light at all";
}

/// Without a tree every search tests every triangle once.
TEST(AovsOfRays, WithoutATreeEachRayTestsEachTriangle) {
  const Scene scene = ownScene("cornell_box");
  for (const Lanes lanes : {Lanes::One, Lanes::Sixteen}) {
    Settings settings = aovSettings(4, 1, {"cost"});
    settings.search = Search::Array;
    settings.lanes = lanes;
    RenderSession session;
    const RenderResult result = session.render(scene, settings, testHooks());
    const FloatImage& cost = result.aovs.at("cost");
    ASSERT_EQ(cost.channels, 2);
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(8, 5), std::pair(5, 6), std::pair(15, 8)}) {
      const std::size_t rays = session.explain(scene, settings, x, y, testHooks(), 1)[0].rays.size();
      const std::size_t at = 2 * static_cast<std::size_t>(y * settings.width + x);
      EXPECT_EQ(cost.pixels[at], 0.0F) << "nodes";
      EXPECT_EQ(cost.pixels[at + 1], static_cast<float>(rays * scene.triangles.size())) << x << "," << y;
    }
  }
}

/// A small quad in the middle, and one far away that no ray comes near: rays beside both test nothing, rays
/// into the one do not test the other's triangles.
TEST(AovsOfRays, WithATreeARayTestsWhatLiesOnItsWay) {
  Scene scene;
  const auto material = addMaterial(scene, emitter({1, 1, 1}));
  addQuad(scene, material, {-0.5F, 0, -0.5F}, {0, 0, 1}, {1, 0, 0});
  for (int i = 0; i < 30; ++i)  // enough for a tree with branches
    addQuad(scene, material, {1000.0F + static_cast<float>(i), 0, 0}, {0, 0, 1}, {1, 0, 0});
  scene.cameras = {lookingDown()};
  scene.cameras[0].position = {0, 2, 0};
  for (const Lanes lanes : {Lanes::One, Lanes::Sixteen}) {
    Settings settings = aovSettings(1, 1, {"cost"});
    settings.keepAllFeatures = false;  // four programs that no other test asks for: small ones compile sooner
    settings.width = settings.height = 33;
    settings.search = Search::Tree;
    settings.lanes = lanes;
    RenderSession session;
    const RenderResult with = session.render(scene, settings, testHooks());
    const FloatImage& cost = with.aovs.at("cost");
    const std::size_t middle = 2 * (16 * 33 + 16), corner = 0;
    EXPECT_GE(cost.pixels[middle], 1.0F) << "the root at least";
    EXPECT_GE(cost.pixels[middle + 1], 1.0F);
    EXPECT_LE(cost.pixels[middle + 1], 2.0F) << "its two triangles";
    EXPECT_GE(cost.pixels[corner], 1.0F);
    EXPECT_EQ(cost.pixels[corner + 1], 0.0F) << "beside everything";
    settings.costAov = false;
    EXPECT_EQ(session.render(scene, settings, testHooks()).radiance.pixels, with.radiance.pixels);
  }
}

TEST(AovsOfRays, ErrorIsThatOfTheSamplesMean) {
  const Scene scene = ownScene("nested_glass");
  const Settings settings = aovSettings(4, 5, {"error"});
  RenderSession session;
  const RenderResult result = session.render(scene, settings, testHooks());
  for (const auto& [x, y] : {std::pair(8, 4), std::pair(5, 3), std::pair(10, 6)}) {
    const auto trees = session.explain(scene, settings, x, y, testHooks());
    ASSERT_EQ(trees.size(), 5U);
    double variance = 0;  // of the mean, averaged over the channels
    for (int c = 0; c < 3; ++c) {
      double mean = 0, squares = 0;
      for (const auto& tree : trees) mean += static_cast<double>(tree.radiance[c]) / 5;
      for (const auto& tree : trees) squares += std::pow(static_cast<double>(tree.radiance[c]) - mean, 2);
      variance += squares / 4 / 5 / 3;
    }
    EXPECT_NEAR(result.aovs.at("error").pixels[static_cast<std::size_t>(y * settings.width + x)],
                std::sqrt(variance), 1e-3 * std::sqrt(variance) + 1e-6)
        << x << "," << y;
  }
  Settings one = settings;
  one.raysPerPixel = 1;
  EXPECT_FALSE(session.render(scene, one, testHooks()).aovs.contains("error")) << "nothing is known of it";
}

TEST(AovsOfRays, NamesAreChecked) {
  Settings settings;
  EXPECT_THROW(askForAov(settings, "colour"), std::invalid_argument);
  askForAllAovs(settings);
  EXPECT_TRUE(settings.aovs && settings.bounceAov && settings.costAov);
  EXPECT_FALSE(settings.errorAov) << "one ray for each pixel";
}

}  // namespace
}  // namespace whittle::test
