// Clear coats: what they take from what lies below, what they reflect, and that no light is added or lost.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/sampler.h"
#include "support/probe.h"

namespace whittle::test {
namespace {

/// The extension's reflectance of a coat all over.
double coatAt(double cosine) { return 0.04 + 0.96 * std::pow(1 - cosine, 5); }

Vec3 downAt(double cosine) { return {std::sqrt(1 - cosine * cosine), -cosine, 0}; }

Material coated(Material m, float share, float roughness) {
  m.clearcoat = share;
  m.clearcoatRoughness = roughness;
  return m;
}

/// What a floor at the origin sends along the way back from that angle.
Vec3 seenAt(const Material& floor, double cosine, const std::vector<Light>& lights, double background = 0,
            const Settings& settings = exactSettings()) {
  Scene scene;
  addFloor(scene, floor, 0);
  scene.lights = lights;
  scene.background.radiance = glm::vec3(static_cast<float>(background));
  Probe probe(scene, settings);
  return probe.Li(-downAt(cosine), downAt(cosine));
}

Light fromAbove() {
  Light light;
  light.kind = LightKind::Directional;
  light.direction = {0, -1, 0};
  return light;
}

TEST(Clearcoat, LeavesToTheSurfaceWhatItDoesNotReflect) {
  const Material plain = lambert({0.5F, 0.25F, 0.75F});
  for (const float share : {0.25F, 1.0F})
    for (const double cosine : {1.0, 0.7, 0.2}) {
      const double left = 1 - static_cast<double>(share) * coatAt(cosine);
      const Vec3 expected = left * seenAt(plain, cosine, {fromAbove()});
      const Vec3 seen = seenAt(coated(plain, share, 0), cosine, {fromAbove()});
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 1e-9) << share << ' ' << cosine;
      // Emission lies below it too.
      const Vec3 glow = seenAt(coated(emitter(glm::vec3(2)), share, 0), cosine, {});
      EXPECT_NEAR(glow.x, 2 * left, 1e-9);
    }
}

TEST(Clearcoat, IsAMirrorWhereItIsSmooth) {
  for (const double cosine : {1.0, 0.5, 0.1})
    EXPECT_NEAR(seenAt(coated(lambert(glm::vec3(0)), 0.5F, 0), cosine, {}, 3).x, 3 * 0.5 * coatAt(cosine),
                1e-9);
}

/// Whatever lies below, and however many directions that takes.
TEST(Clearcoat, NoLightIsAddedOrLostInAFurnace) {
  const Material pane = coated(glass(1.5F, false), 0.7F, 0);
  Material veiled = coated(mirror(glm::vec3(1)), 1, 0);
  veiled.alphaMode = AlphaMode::Blend;
  veiled.baseColor.a = 0.3F;
  for (const ImpulseMode mode : {ImpulseMode::All, ImpulseMode::One})
    for (const Material& m : {coated(mirror(glm::vec3(1)), 1, 0), pane, veiled})
      for (const double cosine : {1.0, 0.6, 0.1}) {
        Settings settings = exactSettings();
        settings.impulses = mode;
        EXPECT_NEAR(seenAt(m, cosine, {}, 1, settings).x, 1, 1e-9) << cosine;
      }
}

/// A place on a white rough metal below a coat.
reference::Surfel coatedMetal(double roughness, bool smooth) {
  reference::Surfel s = whiteMetalAt({0, 1, 0}, 0.5);
  s.coat = {.reflectance = 0.3, .roughness = roughness, .n = {0, 1, 0}, .smooth = smooth, .glossy = !smooth};
  return s;
}

TEST(Clearcoat, GoesWithTheReflectionBelowWhereBothGoOneWay) {
  const Vec3 w_o = glm::normalize(Vec3(0.4, 1, 0.2));
  reference::Surfel s = coatedMetal(0, true);
  s.smooth = true, s.glossy = false;
  reference::Impulses impulses = reference::impulsesOf(s, w_o);
  ASSERT_EQ(impulses.count, 1);
  EXPECT_NEAR(impulses.items[0].magnitude.x, 1, 1e-12);
  s.coat.n = glm::normalize(Vec3(0.1, 1, 0));  // a normal map of its own
  impulses = reference::impulsesOf(s, w_o);
  ASSERT_EQ(impulses.count, 2);
  EXPECT_NEAR(impulses.items[0].magnitude.x, 0.3, 1e-12);
  EXPECT_NEAR(glm::dot(impulses.items[0].w_i, s.coat.n), glm::dot(w_o, s.coat.n), 1e-12);
  EXPECT_NEAR(impulses.items[1].magnitude.x, 0.7, 1e-12);
  s.metallic = 0, s.transmission = 1;  // a third way: there is no room for it
  impulses = reference::impulsesOf(s, w_o);
  ASSERT_EQ(impulses.count, 2);
  EXPECT_NEAR(impulses.items[0].magnitude.x + impulses.items[1].magnitude.x, 1, 1e-12);
}

/// What --glossy brings of a white sky by the coat is the integral of the lobe that lights meet.
TEST(Clearcoat, ImpulsesOfARoughOneIntegrateItsHighlight) {
  constexpr int kSteps = 600;
  constexpr std::uint32_t kSamples = 200000;
  for (const double roughness : {0.4, 0.8})
    for (const double cosine : {0.9, 0.3}) {
      reference::Surfel s = coatedMetal(roughness, false);
      s.metallic = 0, s.baseColor = Vec3(0), s.fresnel = {1.5, 0, Vec3(1)};  // black below
      const Vec3 w_o = -downAt(cosine);
      double lobe = 0, sum = 0, squares = 0;
      for (int a = 0; a < kSteps; ++a)
        for (int b = 0; b < kSteps; ++b) {
          const double c = (a + 0.5) / kSteps, angle = 2 * reference::kPi * (b + 0.5) / kSteps;
          const double sine = std::sqrt(1 - c * c);
          const Vec3 w_i(sine * std::cos(angle), c, sine * std::sin(angle));
          lobe += reference::spreadingBsdf(s, w_i, w_o).x * c * 2 * reference::kPi / (kSteps * kSteps);
        }
      for (std::uint32_t i = 0; i < kSamples; ++i) {
        const Vec2 at(reference::unit(reference::hash(i, 0, 0, 3)),
                      reference::unit(reference::hash(i, 0, 1, 3)));
        for (const auto& impulse : reference::impulsesOf(s, w_o, at).all()) {
          sum += impulse.magnitude.x / kSamples;
          squares += impulse.magnitude.x * impulse.magnitude.x / kSamples;
        }
      }
      // Five deviations of the mean, and what the quadrature leaves.
      EXPECT_NEAR(sum, lobe, 5 * std::sqrt((squares - sum * sum) / kSamples) + 1e-4)
          << roughness << ' ' << cosine;
      EXPECT_LT(lobe, 0.3);
    }
}

TEST(Clearcoat, IsNotOnTheInsideOfASolid) {
  Scene scene;
  addFloor(scene, coated(glass(1, true), 1, 0), 0);
  Probe probe(scene);
  EXPECT_GT(probe.surfelAlong({{0, 1, 0}, {0, -1, 0}})->coat.reflectance, 0);
  EXPECT_EQ(probe.surfelAlong({{0, -1, 0}, {0, 1, 0}})->coat.reflectance, 0);
}

}  // namespace
}  // namespace whittle::test
