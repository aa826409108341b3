// Direct light against closed forms: Lambert's plane, cones, ranges, the glTF microfacet lobe.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/probe.h"

namespace whittle::test {
namespace {

constexpr double kPi = std::numbers::pi;

Scene plane(const Material& material, const Light& light) {
  Scene scene;
  addFloor(scene, material, 0);
  scene.lights.push_back(light);
  return scene;
}

/// Radiance of the floor at (x, 0, 0), seen from straight above and below every light.
double floorAt(Probe& probe, double x) { return probe.Li({x, 1e-4, 0}, {0, -1, 0}).x; }

TEST(Lights, InverseSquareOverALambertPlane) {
  for (const float h : {1e-3F, 0.25F, 1.0F, 8.0F, 1e3F, 1e6F}) {
    Probe probe(plane(lambert(glm::vec3(0.6F)), pointLight({0, h, 0}, 5)));
    for (const double x : {0.0, 0.5, 3.0, 40.0}) {
      const double rho = 0.6F, height = h;
      const double expected = rho * 5 * height / (kPi * std::pow(height * height + x * x, 1.5));
      EXPECT_NEAR(floorAt(probe, x) / expected, 1, 1e-12) << "h " << h << " x " << x;
    }
  }
}

TEST(Lights, ALightOnTheSurfaceIsFinite) {
  Probe probe(plane(lambert(glm::vec3(0.5F)), pointLight({0, 0, 0}, 5)));
  EXPECT_EQ(floorAt(probe, 0), 0);
  EXPECT_EQ(floorAt(probe, 1), 0);  // grazing: no cosine
}

TEST(Lights, RangeEndsTheLightSmoothly) {
  Light light = pointLight({0, 2, 0}, 8);
  light.range = 4;
  Probe probe(plane(lambert(glm::vec3(1)), light));
  // Straight below: 8/2² · (1 − (2/4)⁴) / π.
  EXPECT_NEAR(floorAt(probe, 0), 2 * (1 - 1.0 / 16) / kPi, 1e-12);
  EXPECT_EQ(floorAt(probe, 3.5), 0);  // 4.03 m away
  EXPECT_GT(floorAt(probe, 3.4), 0);  // 3.94 m away
}

TEST(Lights, DirectionalLightComesFromInfinity) {
  Light sun;
  sun.kind = LightKind::Directional;
  sun.direction = {0.6F, -0.8F, 0};
  sun.intensity = glm::vec3(3);
  Probe probe(plane(lambert(glm::vec3(0.5F)), sun));
  // ρ E cos / π; 0.6F and 0.8F are off by 3e-8.
  EXPECT_NEAR(floorAt(probe, 0), 0.5 * 3 * 0.8 / kPi, 1e-7);
  EXPECT_EQ(floorAt(probe, 7), floorAt(probe, 0));
  EXPECT_EQ(probe.Li({0, -1, 0}, {0, 1, 0}).x, 0) << "the side away from the sun";
}

Light spot(float height, float inner, float outer) {
  Light light = pointLight({0, height, 0}, 1);
  light.kind = LightKind::Spot;
  light.direction = {0, -1, 0};
  light.innerConeAngle = inner;
  light.outerConeAngle = outer;
  return light;
}

TEST(Lights, SpotFadesFromTheInnerToTheOuterCone) {
  const float inner = 0.3F, outer = 0.6F;
  Probe lit(plane(lambert(glm::vec3(1)), spot(2, inner, outer)));
  Probe bare(plane(lambert(glm::vec3(1)), pointLight({0, 2, 0}, 1)));
  const auto window = [&](double angle) {
    return floorAt(lit, 2 * std::tan(angle)) / floorAt(bare, 2 * std::tan(angle));
  };
  EXPECT_NEAR(window(0), 1, 1e-12);
  EXPECT_NEAR(window(0.299), 1, 1e-12);
  EXPECT_EQ(window(0.601), 0);
  const double ci = std::cos(double(inner)), co = std::cos(double(outer));
  const double between = (std::cos(0.45) - co) / (ci - co);
  EXPECT_NEAR(window(0.45), between * between, 1e-12);
}

TEST(Lights, AConeOfAHundredthOfADegreeLightsItsInsideOnly) {
  const double half = 0.01 * kPi / 180;
  Probe hard(plane(lambert(glm::vec3(1)), spot(100, static_cast<float>(half), static_cast<float>(half))));
  for (const double edge : {1e-5, 1e-8}) {  // radians; the angle itself is rounded to 1e-11
    EXPECT_GT(floorAt(hard, 100 * std::tan(half - edge)), 0) << edge;
    EXPECT_EQ(floorAt(hard, 100 * std::tan(half + edge)), 0) << edge;
  }
}

TEST(Lights, MicrofacetLobeAtNormalIncidence) {
  // w_i = w_o = n: D = 1/(π α²), V = 1/4, F = F0 = 0.04 for ior 1.5, α = r².
  Material rough = lambert(glm::vec3(0.5F));
  rough.specular = 1;
  rough.roughness = 0.5F;
  const double lobe = 1 / (kPi * 0.0625) / 4;
  Probe dielectric(plane(rough, pointLight({0, 2, 0}, 4)));
  EXPECT_NEAR(floorAt(dielectric, 0), 0.96 * 0.5 / kPi + 0.04 * lobe, 1e-12);
  rough.metallic = 1;
  Probe metal(plane(rough, pointLight({0, 2, 0}, 4)));
  EXPECT_NEAR(floorAt(metal, 0), 0.5 * lobe, 1e-12);
}

TEST(Lights, MicrofacetLobeIsReciprocal) {
  Scene scene;
  Material rough = lambert(glm::vec3(0.2F, 0.5F, 0.9F));
  rough.specular = 1;
  rough.metallic = 0.3F;
  rough.roughness = 0.6F;
  addFloor(scene, rough, 0);
  Probe probe(scene);
  const Vec3 a = glm::normalize(Vec3(0.3, 0.4, -0.2)), b = glm::normalize(Vec3(-0.7, 0.2, 0.5));
  const auto surfel = probe.surfelAlong({a, -a});
  ASSERT_TRUE(surfel);
  const Vec3 there = reference::spreadingBsdf(*surfel, a, b), back = reference::spreadingBsdf(*surfel, b, a);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(there[i], back[i], 1e-14);
}

TEST(Lights, SmoothDielectricDiffusesWhatItDoesNotReflect) {
  Material smooth = lambert(glm::vec3(0.5F));
  smooth.specular = 1;
  smooth.roughness = 0.1F;
  Probe probe(plane(smooth, pointLight({0, 2, 0}, 4)));
  probe.settings().bounces = 1;
  EXPECT_NEAR(floorAt(probe, 0), 0.96 * 0.5 / kPi, 1e-12);
  smooth.metallic = 1;
  Probe metal(plane(smooth, pointLight({0, 2, 0}, 4)));
  EXPECT_EQ(floorAt(metal, 0), 0);
  EXPECT_EQ(metal.rays.shadow, 0) << "no light to be shadowed";
}

}  // namespace
}  // namespace whittle::test
