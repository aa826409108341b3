// Whole pictures: counts of rays, threads, the choice of one impulse.
#include "reference/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "reference/sampler.h"
#include "support/probe.h"

namespace whittle::test {
namespace {

Settings small(int width, int height, int bounces) {
  Settings settings;
  settings.width = width;
  settings.height = height;
  settings.bounces = bounces;
  return settings;
}

/// A mirror on the ground under the camera, a white ceiling above it, two lights of which one casts shadows.
Scene mirroredCeiling() {
  Scene scene;
  addFloor(scene, mirror(glm::vec3(0.5F)), 0);
  addFloor(scene, lambert(glm::vec3(1)), 2, false);
  scene.lights = {pointLight({0, 0.5F, 0}, 1), pointLight({0, 0.75F, 0}, 1)};
  scene.lights[1].castsShadows = false;
  scene.cameras = {lookingDown()};
  return scene;
}

TEST(Counts, MirrorUnderACeiling) {
  const Scene scene = mirroredCeiling();
  const auto counts = [&](int bounces, bool shadows = true, int raysPerPixel = 1) {
    Settings settings = small(4, 3, bounces);
    settings.shadows = shadows;
    settings.raysPerPixel = raysPerPixel;
    const RayCounts rays = renderReference(scene, settings).rays;
    EXPECT_EQ(rays.total(), rays.primary + rays.impulse + rays.shadow);
    return std::array<std::uint64_t, 3>{rays.primary, rays.impulse, rays.shadow};
  };
  using Expected = std::array<std::uint64_t, 3>;
  EXPECT_EQ(counts(1), (Expected{12, 0, 0})) << "a smooth metal has no direct light to shadow";
  EXPECT_EQ(counts(2), (Expected{12, 12, 12})) << "the ceiling meets one light that casts shadows";
  EXPECT_EQ(counts(8), (Expected{12, 12, 12})) << "the ceiling sends nothing on";
  EXPECT_EQ(counts(8, false), (Expected{12, 12, 0}));
  EXPECT_EQ(counts(8, true, 5), (Expected{60, 60, 60}));
}

TEST(Counts, SheetsOfGlassBranch) {
  Scene scene;
  addFloor(scene, glass(1.5F, false), 0.5F);
  addFloor(scene, glass(1.5F, false), 0.25F);
  scene.cameras = {lookingDown()};
  // Each hit lets one ray straight on, at no bounce: the two from above, and one for each reflection between
  // the sheets. Reflections: one that leaves upwards, and those between the sheets: one for each further
  // bounce but the last, since each of these rays has passed a sheet that branched, and only the first
  // carries more than a 64th (0.96 · 0.04).
  for (int bounces = 1; bounces <= 6; ++bounces) {
    const RayCounts rays = renderReference(scene, small(2, 2, bounces)).rays;
    EXPECT_EQ(rays.primary, 4U);
    const int between = std::max(0, bounces - 2);
    EXPECT_EQ(rays.impulse, 4U * (2 + 2 * between + (bounces > 1 ? 1 : 0))) << bounces;
    EXPECT_EQ(rays.shadow, 0U);
  }
}

TEST(Picture, PrimitiveAndDepthBelongToTheFirstSample) {
  Scene scene;
  const std::uint32_t m = addMaterial(scene, lambert(glm::vec3(1)));
  addQuad(scene, m, {-2, 0, -2}, {0, 0, 4}, {2, 0, 0});    // left half of the picture, y = 0
  addQuad(scene, m, {0, 0.5F, -2}, {0, 0, 1}, {2, 0, 0});  // right half, y = 0.5, z below −1 …
  scene.cameras = {lookingDown()};
  Settings settings = small(4, 4, 1);
  const ReferenceResult one = renderReference(scene, settings);
  EXPECT_EQ(one.depth.pixels[0], 1);
  EXPECT_TRUE(one.primitive.pixels[0] == 0 || one.primitive.pixels[0] == 1);
  EXPECT_EQ(one.primitive.pixels[3], -1) << "… which the picture does not reach";
  EXPECT_EQ(one.depth.pixels[3], std::numeric_limits<float>::infinity());
  settings.raysPerPixel = 16;
  const ReferenceResult many = renderReference(scene, settings);
  for (int i = 0; i < 16; ++i) EXPECT_EQ(many.primitive.pixels[i] < 0, i % 4 >= 2);
  EXPECT_EQ(many.primitive.channels, 1);
  EXPECT_EQ(many.depth.width, 4);
  EXPECT_EQ(many.radiance.pixels.size(), 4U * 4 * 3);
}

TEST(Picture, PrimitiveIsThatOfTheFirstSampleAmongMany) {
  Scene scene;  // the left half of the one pixel
  addQuad(scene, addMaterial(scene, lambert(glm::vec3(1))), {-2, 0, -2}, {0, 0, 4}, {2, 0, 0});
  scene.cameras = {lookingDown()};
  Settings settings = small(1, 1, 1);
  settings.raysPerPixel = 8;
  int left = 0;
  for (settings.seed = 0; settings.seed < 40; ++settings.seed) {
    const bool first = reference::samplePosition(settings.sampler, 0, 0, 8, settings.seed).x < 0.5;
    EXPECT_EQ(renderReference(scene, settings).primitive.pixels[0] >= 0, first) << settings.seed;
    left += first;
  }
  EXPECT_TRUE(left > 5 && left < 35) << "both halves should have been first";
}

TEST(Picture, RowZeroIsAtTheTop) {
  Scene scene;
  addQuad(scene, addMaterial(scene, emitter({1, 0, 0})), {-2, 0, -2}, {0, 0, 2},
          {4, 0, 0});  // z < 0: the top
  scene.cameras = {lookingDown()};
  const FloatImage picture = renderReference(scene, small(2, 2, 1)).radiance;
  EXPECT_EQ(picture.pixels, (std::vector<float>{1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(Picture, DoesNotDependOnTheNumberOfThreads) {
  Scene scene = mirroredCeiling();
  addFloor(scene, glass(1.5F, false), 0.25F, true, 0.5F);
  Settings settings = small(24, 16, 5);
  settings.raysPerPixel = 4;
  settings.sampler = Sampler::Sobol;
  settings.impulses = ImpulseMode::One;
  settings.threads = 1;
  const ReferenceResult one = renderReference(scene, settings);
  for (const int threads : {0, 2, 7}) {
    settings.threads = threads;
    const ReferenceResult other = renderReference(scene, settings);
    EXPECT_EQ(one.radiance.pixels, other.radiance.pixels) << threads;
    EXPECT_EQ(one.rays.impulse, other.rays.impulse);
    EXPECT_EQ(one.rays.shadow, other.rays.shadow);
  }
}

TEST(Picture, SaysHowFarItIs) {
  std::vector<int> done;
  renderReference(mirroredCeiling(), small(2, 5, 1), [&](int rows, int of) {
    EXPECT_EQ(of, 5);
    done.push_back(rows);
  });
  EXPECT_EQ(done, (std::vector<int>{1, 2, 3, 4, 5}));
}

TEST(Picture, SamplesThatAreNotFiniteAreCountedAndLeftOut) {
  Scene scene;
  addQuad(scene, addMaterial(scene, emitter({1, 0, 0})), {-2, 0, -2}, {0, 0, 4}, {2, 0, 0});
  addQuad(scene, addMaterial(scene, emitter(glm::vec3(std::nanf("")))), {0, 0, -2}, {0, 0, 4}, {2, 0, 0});
  scene.cameras = {lookingDown()};
  const ReferenceResult result = renderReference(scene, small(2, 1, 1));
  EXPECT_EQ(result.nonFinite, 1U);
  EXPECT_EQ(result.radiance.pixels, (std::vector<float>{1, 0, 0, 0, 0, 0}));
}

TEST(Picture, AnEmptySceneIsItsBackground) {
  Scene scene;
  scene.background.radiance = {0.25F, 0.5F, 1};
  scene.cameras = {lookingDown()};
  const ReferenceResult result = renderReference(scene, small(1, 1, 8));
  EXPECT_EQ(result.radiance.pixels, (std::vector<float>{0.25F, 0.5F, 1}));
  EXPECT_EQ(result.rays.total(), 1U);
}

TEST(OneImpulse, IsRightOnAverage) {
  // A tinted slab of glass between a red and a green emitter, at an angle at which much is reflected.
  Scene scene;
  Material tinted = glass(1.5F, true);
  tinted.baseColor = {0.9F, 0.5F, 0.7F, 1};
  addFloor(scene, tinted, 0);
  addFloor(scene, tinted, -1, false);
  addFloor(scene, emitter({1, 0.25F, 0}), 3, false);
  addFloor(scene, emitter({0.5F, 1, 2}), -3);
  Camera camera;
  camera.orthographic = true;
  camera.ymag = 1e-3F;  // every sample sees the same
  camera.position = {-4, 1, 0};
  camera.forward = glm::vec3(glm::normalize(Vec3(4, -1, 0)));
  camera.up = glm::vec3(glm::normalize(Vec3(1, 4, 0)));
  camera.right = {0, 0, 1};
  scene.cameras = {camera};
  Settings settings = small(1, 1, 6);
  const ReferenceResult all = renderReference(scene, settings);

  settings.impulses = ImpulseMode::One;
  constexpr int kSeeds = 400;
  settings.raysPerPixel = 64;
  Vec3 sum(0), squares(0);
  std::uint64_t impulses = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    settings.seed = static_cast<std::uint32_t>(seed);
    const ReferenceResult one = renderReference(scene, settings);
    const Vec3 seen(one.radiance.pixels[0], one.radiance.pixels[1], one.radiance.pixels[2]);
    sum += seen;
    squares += seen * seen;
    impulses += one.rays.impulse;
  }
  EXPECT_LE(impulses, std::uint64_t{kSeeds} * 64 * 5) << "one impulse a bounce";
  for (int c = 0; c < 3; ++c) {
    const double mean = sum[c] / kSeeds;
    const double sigma = std::sqrt((squares[c] / kSeeds - mean * mean) / (kSeeds - 1));
    EXPECT_GT(sigma, 0);
    EXPECT_LT(sigma, 0.02) << "too noisy to tell";
    EXPECT_NEAR(mean, all.radiance.pixels[c], 4 * sigma) << "channel " << c;
  }
}

}  // namespace
}  // namespace whittle::test
