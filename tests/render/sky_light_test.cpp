// The background as a light: irradiance against closed forms, how errors fall, and the reference.
#include "scene/sky_light.h"

#include <cmath>
#include <numbers>

#include "analysis/radiance_bound.h"
#include "support/agreement.h"
#include "support/form_factors.h"
#include "support/single_rays.h"
#include "support/spheres.h"

namespace whittle::test {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

Settings withSkyLight(Sampler sampler = Sampler::Sobol) {
  Settings settings;
  settings.skyLight = true;
  settings.sampler = sampler;
  return settings;
}

/// A sky of one colour.
Scene underSky(const glm::vec3& radiance = glm::vec3(1)) {
  Scene scene;
  scene.background.radiance = radiance;
  addSkyLight(scene);
  return scene;
}

/// A sky of that many texels, of radiance `all` but one.
Scene underMap(int width, int height, float all, int x, int y, float one) {
  Scene scene = underSky();
  scene.background.width = width, scene.background.height = height;
  scene.background.map.assign(std::size_t{3} * width * height, all);
  for (std::size_t c = 0; c < 3; ++c)
    scene.background.map[3 * (static_cast<std::size_t>(y) * width + x) + c] = one;
  return scene;
}

void addBlackQuad(Scene& scene, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
  addQuad(scene, addMaterial(scene, lambert(glm::vec3(0))), corner, u, v);
}

/// To the rounding of single precision, with one ray: directions are as frequent as they count.
TEST(SkyLight, AnOpenFloorReturnsItsAlbedo) {
  for (const Sampler sampler : {Sampler::Random, Sampler::Stratified, Sampler::Sobol}) {
    Scene scene = underSky({2, 1, 4});
    addFloor(scene, lambert({0.5F, 0.25F, 0.75F}), 0);
    scene.cameras = {lookingDown()};
    Settings settings = withSkyLight(sampler);
    settings.width = settings.height = 8;
    settings.bounces = 1;
    for (const int rays : {1, 4}) {
      settings.raysPerPixel = rays;
      const RenderResult result = renderOnDevice(scene, settings);
      for (std::size_t i = 0; i < 64; ++i)
        EXPECT_NEAR(glm::length(colorOf(result, i) - glm::vec3(1, 0.25F, 3)), 0, 3e-6) << i;
    }
  }
}

TEST(SkyLight, AWallTakesItsShare) {
  for (const auto& [distance, height] :
       {std::pair(1.0F, 1.0F), std::pair(1.0F, 4.0F), std::pair(2.0F, 0.5F)}) {
    Scene scene = underSky();
    addBlackQuad(scene, {distance, 0, -2000}, {0, 0, 4000}, {0, height, 0});
    const double seen = irradianceAtOrigin(scene, withSkyLight(), 4096) / std::numbers::pi;
    EXPECT_NEAR(seen, irradianceBesideWall(distance, height) / std::numbers::pi, 1e-3)
        << height << " high at " << distance;
  }
}

/// A ceiling that ends far beyond what a form factor of 1e-3 sees (3²/1000² of it), with a hole.
TEST(SkyLight, AnOpeningGivesItsFormFactor) {
  for (const auto& [width, depth, height] : {std::tuple(1.0F, 1.0F, 3.0F), std::tuple(4.0F, 0.5F, 1.0F)}) {
    for (const bool map : {false, true}) {
      Scene scene = map ? underMap(8, 4, 1, 0, 0, 1) : underSky();
      const float far = 1000, x = width / 2, z = depth / 2;
      addBlackQuad(scene, {-far, height, -far}, {2 * far, 0, 0}, {0, 0, far - z});
      addBlackQuad(scene, {-far, height, z}, {2 * far, 0, 0}, {0, 0, far - z});
      addBlackQuad(scene, {-far, height, -z}, {far - x, 0, 0}, {0, 0, depth});
      addBlackQuad(scene, {x, height, -z}, {far - x, 0, 0}, {0, 0, depth});
      const double seen = irradianceAtOrigin(scene, withSkyLight(), 4096) / std::numbers::pi;
      const double expected = rectangleIrradiance(width, depth, height) / std::numbers::pi;
      // Of a map directions are as frequent all over the sphere: sixteen times fewer go through a small hole
      // overhead.
      EXPECT_NEAR(seen, expected, map ? 5e-3 : 1e-3)
          << width << "×" << depth << " at " << height << (map ? ", map" : "");
    }
  }
}

/// What is interpolated about one bright texel is a pyramid, whose mean over the 2×2 texels that it covers is
/// a quarter: E = L ω cosθ of the texel, to the square of its size.
TEST(SkyLight, ASmallSunGivesItsIrradiance) {
  constexpr int kWidth = 1024, kHeight = 512, kRow = 150;
  constexpr double kStep = kTurn / kWidth, kPolar = (kRow + 0.5) * kStep;
  constexpr float kRadiance = 1e5F;
  const double sun = static_cast<double>(kRadiance) * kStep * kStep * std::sin(kPolar) * std::cos(kPolar);
  for (const int column : {0, 300, kWidth - 1}) {
    // Places are as frequent as the map is bright there, so that 16 rays are as good as 1 000.
    const double alone =
        irradianceAtOrigin(underMap(kWidth, kHeight, 0, column, kRow, kRadiance), withSkyLight(), 16);
    EXPECT_NEAR(alone / sun, 1, 1e-3) << column;
    const double inDaylight =
        irradianceAtOrigin(underMap(kWidth, kHeight, 1, column, kRow, kRadiance), withSkyLight(), 4096);
    EXPECT_NEAR(inDaylight / (sun + std::numbers::pi), 1, 2e-3) << column;
  }
}

/// One bright texel is in four cells, two columns of two rows; rows count by their part of the sphere.
TEST(SkyLight, CellsAreChosenByTheirLight) {
  constexpr int kWidth = 8, kHeight = 4;
  constexpr double kStep = 0x1p-24;
  const SkyTable table = skyTableOf(underMap(kWidth, kHeight, 0, 7, 2, 5).background);
  ASSERT_EQ(table.until.size(), 5U + 40U);
  const auto chance = [&](std::size_t first, std::size_t i) {
    return static_cast<double>(table.until[first + i] - (i > 0 ? table.until[first + i - 1] : 0.0F));
  };
  const auto height = [](double row) { return std::cos(row * std::numbers::pi / 4); };
  const double upper = height(1.5) - height(2.5), lower = height(2.5) - height(3.5);
  EXPECT_NEAR(chance(0, 2), upper / (upper + lower), 3 * kStep);
  EXPECT_NEAR(chance(0, 3), lower / (upper + lower), 3 * kStep);
  EXPECT_EQ(chance(0, 0) + chance(0, 1) + chance(0, 4), 0);
  const std::size_t row = 5 + 2 * kWidth;
  EXPECT_NEAR(chance(row, 6), 0.5, 3 * kStep);
  EXPECT_NEAR(chance(row, 7), 0.5, 3 * kStep);
  EXPECT_EQ(chance(row, 0) + chance(row, 3), 0);
  EXPECT_EQ(table.until[4], 1);
  EXPECT_EQ(table.until[row + 7], 1);
  // However bright one texel is, cells that are not black have a chance.
  const SkyTable bright = skyTableOf(underMap(kWidth, kHeight, 1e-20F, 3, 1, 1e20F).background);
  for (std::size_t y = 0; y <= kHeight; ++y)
    for (std::size_t x = 0; x < kWidth; ++x) {
      const std::size_t i = kHeight + 1 + y * kWidth + x;
      EXPECT_GT(bright.until[i], x > 0 ? bright.until[i - 1] : 0.0F) << x << ", " << y;
    }
  EXPECT_TRUE(skyTableOf(underSky().background).until.empty());
}

TEST(SkyLight, ErrorsFallAsTheSamplersPromise) {
  Scene scene = underSky();
  addFloor(scene, lambert(glm::vec3(1)), 0);
  addBlackQuad(scene, {1, 0, -2000}, {0, 0, 4000}, {0, 2, 0});
  scene.cameras = {lookingAtOrigin(0.5F)};
  const double expected = irradianceBesideWall(1, 2) / std::numbers::pi;
  const auto ratioOf = [&](Sampler sampler) {
    return errorOverPixels(scene, withSkyLight(sampler), 16, expected) /
           errorOverPixels(scene, withSkyLight(sampler), 256, expected);
  };
  EXPECT_NEAR(ratioOf(Sampler::Random), 4, 0.6) << "sixteen times the samples";
  // An edge goes through one stratum in m of m²: an error of m^(-3/2), 8 times less with 16 times the
  // samples.
  EXPECT_GT(ratioOf(Sampler::Stratified), 6);
  EXPECT_GT(ratioOf(Sampler::Sobol), 6);
}

/// What is white and sees nothing but a white sky is as bright as that: it vanishes.
TEST(SkyLight, AWhiteBallVanishes) {
  for (const bool map : {false, true}) {
    Scene scene = map ? underMap(16, 8, 1, 0, 0, 1) : underSky();
    addSphere(scene, addMaterial(scene, lambert(glm::vec3(1))), {0, 0, 0}, 1, 12, 24);
    Camera camera;
    camera.position = {0, 0, 4};
    aim(camera, {0, 0, -1});
    scene.cameras = {camera};
    Settings settings = smallSettings(1);
    settings.raysPerPixel = 64;
    settings.sampler = Sampler::Sobol;
    const FloatImage picture = renderOnDevice(scene, settings).radiance;
    for (const float value : picture.pixels) EXPECT_NEAR(value, 1, map ? 0.2 : 1e-5);
    // Of a map half the samples are below the horizon: over 1 500 pixels of 64 the mean is off by 1 /
    // sqrt(96000).
    EXPECT_NEAR(meanRadiance(picture), 1, map ? 3e-3 : 1e-6);
  }
}

TEST(SkyLight, TakesThePlaceOfAmbientLight) {
  Scene scene = underSky();
  addFloor(scene, lambert(glm::vec3(0.5F)), 0);
  scene.cameras = {lookingDown()};
  Settings settings = withSkyLight();
  settings.width = settings.height = 8;
  const RenderResult plain = renderOnDevice(scene, settings);
  settings.ambient = 3;
  const RenderResult both = renderOnDevice(scene, settings);
  EXPECT_EQ(differingPixels(plain.radiance, both.radiance), 0U);
  EXPECT_FALSE(uses(both.stats, "ambient light"));
  EXPECT_TRUE(uses(both.stats, "sky light"));
  EXPECT_GT(both.stats.rays.shadow, 0U);
  EXPECT_EQ(ambientOf(scene, settings), 0);
  scene.lights.clear();
  EXPECT_EQ(ambientOf(scene, settings), 3);
}

/// The bound knows what a floor can send back of it: 0.5 of the brightest, of which a mirror shows all.
TEST(SkyLight, LeavesABound) {
  Scene scene = underSky(glm::vec3(3));
  addFloor(scene, mirror(glm::vec3(1)), 0, true, 4);
  addFloor(scene, lambert(glm::vec3(0.5F)), 2, false, 4);
  scene.cameras = {lookingDown()};
  Settings settings = withSkyLight();
  settings.width = settings.height = 8;
  settings.bounces = 1;
  EXPECT_NEAR(renderOnDevice(scene, settings).stats.biasBound, 3, 1e-3) << "the sky itself";
}

TEST(SkyLight, ABlackSkyIsNoLight) {
  Scene scene = ownScene("cornell_box");
  EXPECT_FALSE(addSkyLight(scene));
  const RenderResult plain = renderOnDevice(scene, smallSettings(2));
  EXPECT_FALSE(uses(plain.stats, "sky light"));
  Scene dark = scene;
  dark.background.radiance = glm::vec3(1);
  ASSERT_TRUE(addSkyLight(dark));
  dark.background.radiance = glm::vec3(0);  // an edit of its strength
  const RenderResult black = renderOnDevice(dark, smallSettings(2));
  EXPECT_EQ(differingPixels(plain.radiance, black.radiance), 0U);
  EXPECT_EQ(plain.stats.rays.shadow, black.stats.rays.shadow);
  ASSERT_EQ(black.stats.pruning.droppedLights.size(), 1U);
  EXPECT_EQ(black.stats.pruning.droppedLights[0].reason, "the background is black");
}

/// One colour or a map, turned; shadows through glass and leaves; glossy and not. The light of the scene
/// itself keeps its own samples.
TEST(SkyLight, AgreesWithTheReference) {
  for (const bool glossy : {false, true})
    for (const char* name : {"nested_glass", "textured"}) {
      Scene scene = ownScene(name);
      scene.background = underMap(16, 8, 0.5F, 3, 1, 20).background;
      if (glossy) scene.background.map.clear(), scene.background.width = scene.background.height = 0;
      scene.background.rotation = 77;
      ASSERT_TRUE(addSkyLight(scene));
      Settings settings = smallSettings(4);
      settings.glossy = glossy;
      settings.raysPerPixel = 2;
      expectAgreement(compareWithReference(scene, settings), name, 60);
    }
}

}  // namespace
}  // namespace whittle::test
