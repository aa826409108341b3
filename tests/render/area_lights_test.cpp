// Surfaces that glow as lights: irradiance against closed forms, how errors fall, and the reference.
#include <cmath>
#include <numbers>

#include "kernels/shared/layout.h"
#include "scene/emitters.h"
#include "support/agreement.h"
#include "support/form_factors.h"
#include "support/random_scenes.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

Settings withAreaLights(Sampler sampler = Sampler::Sobol) {
  Settings settings;
  settings.areaLights = true;
  settings.sampler = sampler;
  return settings;
}

/// Radiance 1 downwards, a rectangle about the y axis at that height.
Scene glowingRectangle(float width, float depth, float height) {
  Scene scene;
  Material m = emitter({1, 1, 1});
  m.doubleSided = false;
  addQuad(scene, addMaterial(scene, m), {-width / 2, height, -depth / 2}, {width, 0, 0}, {0, 0, depth});
  addSurfaceLight(scene);
  return scene;
}

TEST(AreaLights, ARectangleGivesTheClosedForm) {
  for (const auto& [width, depth, height] :
       {std::tuple(1.0F, 1.0F, 2.0F), std::tuple(4.0F, 0.5F, 1.0F), std::tuple(2.0F, 2.0F, 1.5F)}) {
    const double expected = rectangleIrradiance(width, depth, height);
    const double seen = irradianceAtOrigin(glowingRectangle(width, depth, height), withAreaLights(), 4096);
    EXPECT_NEAR(seen / expected, 1, 1e-3) << width << "×" << depth << " at " << height;
  }
}

/// E = π L R² / (R² + h²), of a disk of many triangles, some of them as thin as needles.
TEST(AreaLights, ADiskGivesTheClosedForm) {
  constexpr int kSides = 512;
  constexpr double kRadius = 0.7, kHeight = 1.3;
  Scene scene;
  Material m = emitter({1, 1, 1});
  m.doubleSided = false;
  const auto material = addMaterial(scene, m);
  scene.positions.push_back({0, kHeight, 0});
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    scene.positions.push_back({kRadius * std::cos(angle), kHeight, kRadius * std::sin(angle)});
    scene.triangles.push_back(
        {0, static_cast<std::uint32_t>(i + 1), static_cast<std::uint32_t>((i + 1) % kSides + 1), material});
  }
  addSurfaceLight(scene);
  const double expected = std::numbers::pi * kRadius * kRadius / (kRadius * kRadius + kHeight * kHeight);
  EXPECT_NEAR(irradianceAtOrigin(scene, withAreaLights(), 4096) / expected, 1, 1e-3);
}

/// Twice as bright or twice as large is twice as often chosen, and what is dark never.
TEST(AreaLights, EmittersAreChosenByTheirPower) {
  Scene scene;
  addFloor(scene, emitter({1, 1, 1}), 0, true, 1);
  addFloor(scene, emitter({0, 4, 0}), 1, true, 1);
  addFloor(scene, lambert(glm::vec3(1)), 2, true, 1);
  Material masked = emitter({9, 9, 9});
  masked.alphaMode = AlphaMode::Mask;
  addFloor(scene, masked, 3, true, 1);
  const auto emitters = emittersOf(scene);
  ASSERT_EQ(emitters.size(), 4U);
  EXPECT_FLOAT_EQ(emitters[0].until, 0.1F);
  EXPECT_FLOAT_EQ(emitters[1].until, 0.2F);
  EXPECT_FLOAT_EQ(emitters[2].until, 0.6F);
  EXPECT_EQ(emitters[3].until, 1.0F);
  EXPECT_NEAR(emitters[0].inverseDensity, 2 / 0.1, 1e-5);
  EXPECT_NEAR(emitters[3].inverseDensity, 2 / 0.4, 1e-5);
  Scene dark;
  addFloor(dark, lambert(glm::vec3(1)), 0);
  EXPECT_FALSE(addSurfaceLight(dark));
  EXPECT_TRUE(dark.lights.empty());
}

/// The root of the mean squared error over many pixels: with the root of the samples where they are
/// independent, faster where they are not.
TEST(AreaLights, ErrorsFallAsTheSamplersPromise) {
  Scene scene = glowingRectangle(1, 1, 1);
  addFloor(scene, lambert(glm::vec3(1)), 0);
  scene.cameras = {lookingAtOrigin(0.5F)};
  const double expected = rectangleIrradiance(1, 1, 1) / std::numbers::pi;
  const auto errorOf = [&](Sampler sampler, int samples) {
    return errorOverPixels(scene, withAreaLights(sampler), samples, expected);
  };
  const double random = errorOf(Sampler::Random, 16) / errorOf(Sampler::Random, 256);
  EXPECT_NEAR(random, 4, 0.6) << "sixteen times the samples";
  // Strata of side 1/m leave an error of 1/m² for a smooth integrand: 16 times less with 16 times the
  // samples.
  EXPECT_GT(errorOf(Sampler::Stratified, 16) / errorOf(Sampler::Stratified, 256), 9);
  EXPECT_GT(errorOf(Sampler::Sobol, 16) / errorOf(Sampler::Sobol, 256), 9);
}

/// The error of a pixel of that many independent samples whose squares have that mean.
double scatter(double meanOfSquares, double mean, int samples) {
  return std::sqrt((meanOfSquares - mean * mean) / samples) / std::numbers::pi;
}

/// Near a large lamp, points chosen evenly over its area bring anything from little to much: cos⁴θ/h² each.
/// Directions bring their cosine.
TEST(AreaLights, DirectionsScatterLessThanPoints) {
  constexpr int kSteps = 1000, kSamples = 16;
  constexpr double kSide = 4, kHeight = 0.25, kArea = kSide * kSide;
  double mean = 0, squares = 0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const double x = ((i % kSteps + 0.5) / kSteps - 0.5) * kSide,
                 z = ((i / kSteps + 0.5) / kSteps - 0.5) * kSide;
    const double point = kArea * kHeight * kHeight / std::pow(x * x + z * z + kHeight * kHeight, 2);
    mean += point / kSteps / kSteps, squares += point * point / kSteps / kSteps;
  }
  ASSERT_NEAR(mean / rectangleIrradiance(kSide, kSide, kHeight), 1, 1e-3);
  Scene scene = glowingRectangle(kSide, kSide, kHeight);
  addFloor(scene, lambert(glm::vec3(1)), 0);
  scene.cameras = {lookingAtOrigin(0.2F)};
  const double error =
      errorOverPixels(scene, withAreaLights(Sampler::Random), kSamples, mean / std::numbers::pi);
  EXPECT_LT(error, scatter(squares, mean, kSamples) / 5);
}

/// Of many small lamps, those are chosen that bring much: of candidates drawn by power, as good as that many
/// samples.
TEST(AreaLights, AFewCandidatesAreWorthAsManySamples) {
  constexpr int kLamps = 300, kSamples = 16;
  constexpr float kSide = 0.01F;
  Scene scene;
  Material m = emitter({1, 1, 1});
  m.doubleSided = false;
  const std::uint32_t glow = addMaterial(scene, m);
  Rng rng(5);
  double mean = 0, squares = 0;
  for (int i = 0; i < kLamps; ++i) {
    const glm::vec3 p(rng.between(-5, 5), rng.between(0.5F, 2), rng.between(-5, 5));
    addQuad(scene, glow, p - glm::vec3(kSide / 2, 0, kSide / 2), {kSide, 0, 0}, {0, 0, kSide});
    const double d2 = static_cast<double>(glm::dot(p, p)), y = static_cast<double>(p.y);
    const double brings = static_cast<double>(kSide * kSide) * y * y / (d2 * d2);
    mean += brings, squares += kLamps * brings * brings;
  }
  addSurfaceLight(scene);
  addFloor(scene, lambert(glm::vec3(1)), 0);
  scene.cameras = {lookingAtOrigin(0.2F)};
  const double error =
      errorOverPixels(scene, withAreaLights(Sampler::Random), kSamples, mean / std::numbers::pi);
  // All of 576 errors: their mean scatters by 3 %, and lamps hide one another here and there.
  EXPECT_LT(error, 1.15 * scatter(squares, mean, kSamples * EMITTER_CANDIDATES));
}

/// Several emitters, a texture on one, mirrors and glass between, shadows of both; glossy and not.
TEST(AreaLights, AgreeWithTheReference) {
  for (const bool glossy : {false, true})
    for (const char* name : {"cornell_box", "nested_glass"}) {
      Scene scene = ownScene(name);
      addQuad(scene, addMaterial(scene, emitter({0.5F, 2, 1})), {-0.4F, 0.1F, 0.3F}, {0.1F, 0, 0},
              {0, 0.1F, 0.05F});
      if (!scene.normals.empty()) scene.normals.resize(scene.positions.size(), glm::vec3(0));
      if (!scene.uv0.empty()) scene.uv0.resize(scene.positions.size(), glm::vec2(0));
      if (!scene.colors.empty()) scene.colors.resize(scene.positions.size(), glm::vec4(1));
      ASSERT_TRUE(addSurfaceLight(scene));
      Settings settings = smallSettings(4);
      settings.width = 64, settings.height = 36;
      settings.glossy = glossy, settings.areaLights = true;
      if (glossy)
        for (Material& material : scene.materials) material.roughness = std::max(material.roughness, 0.4F);
      settings.raysPerPixel = 2;
      expectAgreement(compareWithReference(scene, settings), name, 1);
    }
}

}  // namespace
}  // namespace whittle::test
