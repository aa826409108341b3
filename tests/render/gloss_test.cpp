// Glossy impulses on the device: what a white sky gives, against quadrature of the lobe, and the reference.
#include <cmath>

#include "analysis/feature.h"
#include "reference/bsdf.h"
#include "support/agreement.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

Material roughMetal(float roughness) {
  Material m = mirror(glm::vec3(1));
  m.roughness = roughness;
  return m;
}

/// A white sky in a white metal floor is the lobe's albedo for that angle.
TEST(DeviceGloss, AWhiteSkyGivesTheAlbedoOfTheLobe) {
  for (const float roughness : {0.4F, 0.8F})
    for (const double cosine : {0.9, 0.4}) {
      Scene scene;
      addFloor(scene, roughMetal(roughness), 0);
      scene.background.radiance = glm::vec3(1);
      Camera camera;
      const glm::dvec3 towards(std::sqrt(1 - cosine * cosine), -cosine, 0);
      aim(camera, towards);
      camera.orthographic = true;
      camera.ymag = 1e-4F;
      camera.position = glm::vec3(-3.0 * towards);
      scene.cameras = {camera};
      Settings settings;
      settings.width = settings.height = 1;
      settings.bounces = 2;
      settings.raysPerPixel = 16384;
      settings.sampler = Sampler::Sobol;
      settings.glossy = true;
      const double seen = static_cast<double>(colorOf(renderOnDevice(scene, settings)).x);

      const reference::Surfel s = whiteMetalAt({0, 1, 0}, static_cast<double>(roughness));
      double albedo = 0;
      constexpr int kSteps = 800;
      for (int a = 0; a < kSteps; ++a)
        for (int b = 0; b < kSteps; ++b) {
          const double c = (a + 0.5) / kSteps, sine = std::sqrt(1 - c * c);
          const double angle = 2 * reference::kPi * (b + 0.5) / kSteps;
          const reference::Vec3 w_i(sine * std::cos(angle), c, sine * std::sin(angle));
          albedo += reference::spreadingBsdf(s, w_i, -towards).x * c * 2 * reference::kPi / kSteps / kSteps;
        }
      EXPECT_NEAR(seen / albedo, 1, 2e-3) << "roughness " << roughness << " cosine " << cosine;
    }
}

TEST(DeviceGloss, IsLeftOutAndKeptChangesNothing) {
  Scene scene = ownScene("cornell_box");
  for (Material& m : scene.materials) m.roughness = std::max(m.roughness, 0.3F);
  Settings settings = smallSettings(3);
  const RenderResult plain = renderOnDevice(scene, settings);
  const auto& used = plain.stats.featuresUsed;
  EXPECT_EQ(std::count(used.begin(), used.end(), "glossy impulses"), 0);
  settings.keepFeatures = bitOf(Feature::GLOSS);
  EXPECT_EQ(renderOnDevice(scene, settings).radiance.pixels, plain.radiance.pixels);
  settings.glossy = true;
  EXPECT_NE(renderOnDevice(scene, settings).radiance.pixels, plain.radiance.pixels);
}

/// Rough mirrors, frosted glass with volumes, one impulse or both.
TEST(DeviceGloss, AgreesWithTheReference) {
  for (const char* name : {"cornell_box", "nested_glass"})
    for (const ImpulseMode mode : {ImpulseMode::All, ImpulseMode::One}) {
      Scene scene = ownScene(name);
      for (Material& m : scene.materials) m.roughness = std::max(m.roughness, 0.35F);
      Settings settings = wholeSettings(4);
      settings.glossy = true;
      settings.impulses = mode;
      settings.raysPerPixel = 2;
      expectAgreement(compareWithReference(scene, settings), name, 1);
    }
}

/// Light from all sides is shared between what a rough surface spreads and its impulses.
TEST(DeviceGloss, AgreesWithTheReferenceInAmbientLight) {
  Scene scene = ownScene("cornell_box");
  for (Material& m : scene.materials) m.roughness = std::max(m.roughness, 0.35F), m.specular = 1;
  Settings settings = smallSettings(2);
  settings.glossy = true;
  settings.ambient = 0.5F;
  expectAgreement(compareWithReference(scene, settings), "ambient", 1);
}

}  // namespace
}  // namespace whittle::test
