// Lights of some size: what they deliver against closed forms, penumbras, samplers, and the reference.
#include <cmath>
#include <numbers>

#include "analysis/feature.h"
#include "support/agreement.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

Settings sized(float radius, float angle, Sampler sampler = Sampler::Sobol) {
  Settings settings;
  settings.lightRadius = radius;
  settings.sunAngle = angle;
  settings.sampler = sampler;
  return settings;
}

Light sunAlong(const glm::vec3& direction, float intensity) {
  Light light;
  light.kind = LightKind::Directional;
  light.direction = glm::normalize(direction);
  light.intensity = glm::vec3(intensity);
  return light;
}

/// A sphere above the horizon gives what its middle would (Lambert 1760; Pharr, Jakob, Humphreys 2023, 12.2):
/// E = I cosθ / d², whatever its radius. Through every sampler.
TEST(LightSize, ASphereAboveTheHorizonGivesWhatItsMiddleWould) {
  for (const Sampler sampler : {Sampler::Random, Sampler::Stratified, Sampler::Sobol})
    for (const float radius : {1e-3F, 0.5F, 1.2F}) {
      Scene scene;
      scene.lights = {pointLight({2, 1.5F, 0}, 10)};
      const double d2 = 2.0 * 2 + 1.5 * 1.5, expected = 10 * 1.5 / std::sqrt(d2) / d2;
      const double tolerance = sampler == Sampler::Random ? 1e-2 : 1e-3;  // 1/sqrt(4096) of the spread
      EXPECT_NEAR(irradianceAtOrigin(scene, sized(radius, 0, sampler), 4096) / expected, 1, tolerance)
          << radius;
    }
}

TEST(LightSize, ASunAboveTheHorizonGivesWhatItsMiddleWould) {
  for (const float angle : {0.53F, 20.0F, 80.0F}) {
    Scene scene;
    scene.lights = {sunAlong({-1, -1, 0}, 3)};
    EXPECT_NEAR(irradianceAtOrigin(scene, sized(0, angle), 4096) / (3 * std::sqrt(0.5)), 1, 1e-3) << angle;
  }
}

/// A sky of one radiance: half of it under the horizon of a floor that stands on edge to its middle.
TEST(LightSize, AHemisphereOnTheHorizonIsHalfSeen) {
  Scene scene;
  scene.lights = {sunAlong({-1, 0, 0}, 1)};
  // 180°: a hemisphere of radiance L = E/π about the horizontal; of cosine-weighted sky above the floor it
  // covers half: E = L π / 2 = 1/2.
  EXPECT_NEAR(irradianceAtOrigin(scene, sized(0, 180), 16384), 0.5, 2e-3);
}

/// A wall's edge through the line from the floor to the lamp's middle hides half of it.
TEST(LightSize, AnEdgeBeforeTheMiddleHidesHalf) {
  for (const bool isSun : {false, true}) {
    Scene scene;
    scene.lights = {isSun ? sunAlong({0, -1, 0}, 8) : pointLight({0, 4, 0}, 8)};
    const double open = isSun ? 8 : 8.0 / 16;
    addQuad(scene, addMaterial(scene, lambert(glm::vec3(0))), {0, 2, -50}, {0, 0, 100}, {50, 0, 0});
    const double seen = irradianceAtOrigin(scene, sized(1, 20), 4096);
    EXPECT_NEAR(seen / open, 0.5, 2e-3);
  }
}

/// Inside a penumbra something of the lamp is seen, and it falls across it; a point has an edge.
TEST(LightSize, ShadowsHavePenumbras) {
  Scene scene;
  addFloor(scene, lambert(glm::vec3(1)), 0);
  addQuad(scene, addMaterial(scene, lambert(glm::vec3(0))), {-50, 2, -50}, {0, 0, 100}, {50, 0, 0});
  scene.lights = {pointLight({0, 4, 0}, 8)};
  const auto rowOf = [&](float radius) {
    Camera camera = lookingDown();
    camera.ymag = 5e-4F;  // 1 mm for each pixel
    scene.cameras = {camera};
    Settings settings = sized(radius, 0);
    settings.width = 2001, settings.height = 1, settings.bounces = 1;
    settings.raysPerPixel = 256;
    return renderOnDevice(scene, settings);
  };
  const RenderResult soft = rowOf(0.5F);
  int between = 0, rises = 0;
  double before = 0;
  for (std::size_t x = 0; x < 2001; x += 40) {
    const double now = static_cast<double>(colorOf(soft, x).x);
    const double open =
        8 * 4 / std::pow(16 + std::pow((static_cast<double>(x) - 1000) * 1e-3, 2), 1.5) / std::numbers::pi;
    between += now > 0.02 * open && now < 0.98 * open;
    rises += now < before - 0.02 * open;
    before = now;
  }
  // Half as high as the lamp, the edge throws a penumbra as wide as the lamp: ±0.5 m, of ±1 m seen.
  EXPECT_NEAR(between, 25, 4);
  EXPECT_EQ(rises, 0) << "it only grows lighter towards the open side";
}

TEST(LightSize, NothingInsideALampAndNothingWithoutASize) {
  Scene scene;
  scene.lights = {pointLight({0, 0.5F, 0}, 10)};
  EXPECT_EQ(irradianceAtOrigin(scene, sized(0.6F, 0), 16), 0);
  Settings settings = smallSettings(4);
  const Scene box = ownScene("cornell_box");
  const RenderResult plain = renderOnDevice(box, settings);
  const auto& used = plain.stats.featuresUsed;
  EXPECT_EQ(std::count(used.begin(), used.end(), "lights of some size"), 0);
  settings.keepFeatures = bitOf(Feature::LIGHT_SIZE);
  EXPECT_EQ(renderOnDevice(box, settings).radiance.pixels, plain.radiance.pixels) << "kept, of size 0";
}

/// Several lights, mirrors and glass, each sampler, one lane and many.
TEST(LightSize, AgreesWithTheReference) {
  for (const Sampler sampler : {Sampler::Random, Sampler::Stratified, Sampler::Sobol})
    for (const char* name : {"cornell_box", "nested_glass"}) {
      Scene scene = ownScene(name);
      scene.lights.push_back(sunAlong({0.2F, -1, -0.3F}, 0.5F));
      Settings settings = wholeSettings(5);
      settings.lightRadius = 0.05F, settings.sunAngle = 4;
      settings.sampler = sampler;
      settings.raysPerPixel = 4;
      expectAgreement(compareWithReference(scene, settings), name, 1);
    }
}

}  // namespace
}  // namespace whittle::test
