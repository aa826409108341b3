// Glass: Fresnel's equations, slabs, total reflection, absorption.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "reference/fresnel.h"
#include "support/probe.h"

namespace whittle::test {
namespace {

using reference::dielectricReflectance;

constexpr double kDegree = std::numbers::pi / 180;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(Fresnel, KnownValues) {
  EXPECT_NEAR(dielectricReflectance(1, 1.5), 0.04, 1e-15);
  EXPECT_NEAR(dielectricReflectance(1, 1 / 1.5), 0.04, 1e-15);
  EXPECT_NEAR(dielectricReflectance(1, 1.5 / 1.33), 0.0036085, 5e-8);  // glass in water
  // Brewster's angle, tan θ = n: only one polarisation is left, ½((n² − 1)/(n² + 1))² = 0.0739645.
  EXPECT_NEAR(dielectricReflectance(std::cos(std::atan(1.5)), 1.5), 0.5 * std::pow(1.25 / 3.25, 2), 1e-15);
  EXPECT_EQ(dielectricReflectance(0.3, 1), 0);
  EXPECT_EQ(dielectricReflectance(0.3, 0), 1) << "KHR_materials_ior: 0 reflects everything";
}

TEST(Fresnel, RisesToTotalReflectionAtTheCriticalAngle) {
  const double critical = std::asin(1 / 1.5);
  EXPECT_NEAR(critical / kDegree, 41.8103, 5e-5);
  double last = 0;
  for (int k = 1; k <= 14; ++k) {
    const double r = dielectricReflectance(std::cos(critical - std::pow(10.0, -k)), 1 / 1.5);
    EXPECT_GT(r, last) << k;
    EXPECT_LE(r, 1) << k;
    last = r;
    if (k > 12) continue;
    EXPECT_EQ(dielectricReflectance(std::cos(critical + std::pow(10.0, -k)), 1 / 1.5), 1) << k;
  }
  EXPECT_GT(last, 0.99999);
}

TEST(Fresnel, GrazingLightIsReflectedAndNeverMoreThanAll) {
  for (int k = 0; k <= 16; ++k) {
    const double cosine = std::sin(std::pow(10.0, -k) * kDegree);
    const double r = dielectricReflectance(cosine, 1.5);
    EXPECT_LE(r, 1) << k;
    // To first order in cosθ the two polarisations lose 4 cosθ/√(η²−1) times 1 and η².
    const double loss = 2 * cosine / std::sqrt(1.25) * (1 + 2.25);
    EXPECT_NEAR(1 - r, loss, 4 * loss * loss + 1e-15) << k;
  }
}

TEST(Fresnel, SpecularExtensionTintsAndDims) {
  const Vec3 tint(0.5, 1, 30);
  const reference::TintedFresnel tinted(1.5, 0.5, tint);
  const Vec3 facing = tinted.reflectance(1, 1.5);
  EXPECT_NEAR(facing.x, 0.01, 1e-15);
  EXPECT_NEAR(facing.y, 0.02, 1e-15);
  EXPECT_NEAR(facing.z, 0.5, 1e-15);  // min(0.04·30, 1)·0.5
  EXPECT_NEAR(tinted.reflectance(0, 1.5).x, 0.5, 1e-15);
  EXPECT_EQ(tinted.reflectance(0.1, 1 / 1.5), Vec3(1)) << "total reflection is total";
  const reference::TintedFresnel plain(1.5, 1, Vec3(1));
  for (const double c : {1.0, 0.7, 0.2}) {
    EXPECT_NEAR(plain.reflectance(c, 1.5).x, dielectricReflectance(c, 1.5), 1e-15);
  }
}

TEST(Fresnel, OfIorZeroRisesFromTheColourToTheStrength) {
  const reference::TintedFresnel tinted(0, 0.5, Vec3(0.25, 1, 30));
  const double eta = 0;
  EXPECT_EQ(tinted.reflectance(1, eta), Vec3(0.125, 0.5, 0.5)) << "min(k, 1)·s";
  EXPECT_NEAR(tinted.reflectance(0.5, eta).x, 0.125 + 0.375 / 32, 1e-15);  // (1 − 0.5)⁵ = 1/32
  EXPECT_NEAR(tinted.reflectance(0.5, 1 / eta).x, 0.125 + 0.375 / 32, 1e-15) << "the same from behind";
  EXPECT_EQ(tinted.reflectance(0, eta), Vec3(0.5));
  const reference::TintedFresnel plain(0, 1, Vec3(1));
  for (const double c : {1.0, 0.5, 0.0}) EXPECT_EQ(plain.reflectance(c, eta), Vec3(1));
}

/// A slab of `material` between y = 0 and −1; what comes from above is red, from below green, 1 each.
Scene slabScene(const Material& material) {
  Scene scene;
  addFloor(scene, material, 0, true);
  addFloor(scene, material, -1, false);
  addFloor(scene, emitter({1, 0, 0}), 10, false);
  addFloor(scene, emitter({0, 1, 0}), -10);
  return scene;
}

TEST(Slab, SeriesAtEachDepth) {
  Probe probe(slabScene(glass(1.5F, true)));
  const double r = 0.04, t = 0.96;
  double reflected = 0, transmitted = 0;
  for (int depth = 1; depth <= 12; ++depth) {
    if (depth == 2) reflected += r;
    if (depth >= 4 && depth % 2 == 0) reflected += t * t * std::pow(r, depth - 3);
    if (depth >= 3 && depth % 2 == 1) transmitted += t * t * std::pow(r, depth - 3);
    probe.settings().bounces = depth;
    const Vec3 seen = probe.Li({0.1, 5, 0.2}, {0, -1, 0});
    EXPECT_NEAR(seen.x, reflected, 1e-14) << depth;
    EXPECT_NEAR(seen.y, transmitted, 1e-14) << depth;
  }
  EXPECT_NEAR(reflected, 0.076923, 5e-7);
  EXPECT_NEAR(transmitted, 0.923077, 5e-7);
}

TEST(Slab, ShiftsALightRayAt45Degrees) {
  Probe probe(slabScene(glass(1.5F, true)));
  const Vec3 w = glm::normalize(Vec3(1, -1, 0));
  Ray ray{Vec3(-1, 1, 0.3), w};
  for (int side = 0; side < 2; ++side) {
    const auto surfel = probe.surfelAlong(ray);
    ASSERT_TRUE(surfel);
    const auto impulses = reference::impulsesOf(*surfel, -ray.direction);
    ASSERT_EQ(impulses.count, 2);
    ray = {surfel->position - surfel->rayOffset * surfel->facing, impulses.items[1].w_i};
  }
  EXPECT_NEAR(glm::length(ray.direction - w), 0, 1e-14);
  const Vec3 moved = ray.origin - Vec3(-1, 1, 0.3);
  EXPECT_NEAR(glm::length(moved - w * glm::dot(moved, w)), 0.329142, 5e-7);
}

TEST(Slab, TotalReflectionInsideKeepsAllTheLight) {
  Probe probe(slabScene(glass(1.5F, true)));
  const double critical = std::asin(1 / 1.5);
  for (int k = 2; k <= 9; ++k) {  // at 1e-9 rad the 1e-12 m offset does not matter yet
    for (const double sign : {-1.0, 1.0}) {
      const double angle = critical + sign * std::pow(10.0, -k);
      const Ray ray{Vec3(0, -0.5, 0), Vec3(std::sin(angle), std::cos(angle), 0)};
      const auto surfel = probe.surfelAlong(ray);
      ASSERT_TRUE(surfel);
      const auto impulses = reference::impulsesOf(*surfel, -ray.direction);
      Vec3 sum(0);
      for (const auto& impulse : impulses.all()) sum += impulse.magnitude;
      EXPECT_NEAR(sum.x, 1, 1e-15) << k;
      EXPECT_EQ(impulses.count, sign > 0 ? 1 : 2) << k;
    }
  }
}

TEST(Slab, ARoughSolidReflectsInsideToo) {
  Material rough = glass(1.5F, true);
  rough.roughness = 0.8F;
  Probe probe(slabScene(rough));
  const Ray steep{Vec3(0, -0.5, 0), glm::normalize(Vec3(2, 1, 0))};
  const auto inside = reference::impulsesOf(*probe.surfelAlong(steep), -steep.direction);
  ASSERT_EQ(inside.count, 1);
  EXPECT_EQ(inside.items[0].magnitude, Vec3(1));
  const Ray flat{Vec3(0, -0.5, 0), Vec3(0, 1, 0)};
  const auto leaving = reference::impulsesOf(*probe.surfelAlong(flat), -flat.direction);
  ASSERT_EQ(leaving.count, 1);
  EXPECT_TRUE(leaving.items[0].through);
}

TEST(Slab, GlassThatEqualsAirIsInvisible) {
  for (const Vec3& w : {Vec3(0, -1, 0), Vec3(1, -1, 0), Vec3(3, -1, 0.5)}) {
    Probe air(slabScene(glass(1, true)));
    EXPECT_EQ(air.Li({0, 1, 0}, w), Vec3(0, 1, 0));
    for (const float ior : {std::nextafter(1.0F, 0.0F), std::nextafter(1.0F, 2.0F)}) {
      Probe nearly(slabScene(glass(ior, true)));
      const Vec3 seen = nearly.Li({0, 1, 0}, w);
      EXPECT_LT(seen.x, 1e-10) << ior;  // R ~ (Δn/2)²/cos⁴ ~ 4e-15 · 110
      EXPECT_NEAR(seen.y, 1, 1e-10) << ior;
    }
  }
}

TEST(Slab, AbsorbsByBeersLaw) {
  for (const float sigma : {0.0F, 1e-30F, 1.0F, 3.5F, 1e30F, kInfinity}) {
    Material tinted = glass(1, true);
    tinted.sigma_a = glm::vec3(sigma, 0, sigma);
    Scene scene = slabScene(tinted);
    scene.materials.back().emission = glm::vec3(1);
    Probe probe(scene);
    const Vec3 seen = probe.Li({0, 1, 0}, {1, -1, 0});
    EXPECT_NEAR(seen.x, std::exp(-sigma * std::sqrt(2.0)), 1e-11)
        << sigma;  // the ray offset shortens by 1.4e-12 m
    EXPECT_EQ(seen.y, 1) << sigma;
  }
}

TEST(Slab, NothingIsTracedBehindBlackGlass) {
  Material black = glass(1, true);
  black.sigma_a = glm::vec3(kInfinity);
  Probe probe(slabScene(black));
  EXPECT_EQ(probe.Li({0, 1, 0}, {0, -1, 0}), Vec3(0));
  EXPECT_EQ(probe.rays.impulse, 1) << "into the slab, not out of it";
}

TEST(Slab, NestedSolidsMeetWithTheRatioOfTheirIndices) {
  Scene scene;
  addFloor(scene, glass(1.33F, true), 0);          // air over water
  addFloor(scene, glass(1.5F / 1.33F, true), -1);  // water over glass
  Probe probe(scene);
  const Vec3 w = glm::normalize(Vec3(0.7, -1, 0));
  const auto water = probe.surfelAlong({Vec3(0, 1, 0), w});
  const Vec3 inWater = reference::impulsesOf(*water, -w).items[1].w_i;
  EXPECT_NEAR(inWater.x, w.x / 1.33, 1e-7);
  const auto glassSurface = probe.surfelAlong({water->position - water->rayOffset * water->facing, inWater});
  ASSERT_TRUE(glassSurface);
  const Vec3 inGlass = reference::impulsesOf(*glassSurface, -inWater).items[1].w_i;
  EXPECT_NEAR(inGlass.x, w.x / 1.5, 1e-7)
      << "Snell from air to glass, whatever lies between; indices are floats";
  const Ray down{Vec3(0.3, -0.5, 0.2), Vec3(0, -1, 0)};
  const auto facing = reference::impulsesOf(*probe.surfelAlong(down), -down.direction);
  EXPECT_NEAR(facing.items[0].magnitude.x, 0.0036085, 5e-8);
}

TEST(Slab, IorZeroReflectsItsColourAndMoreAtAnAngle) {
  Material coated = glass(0, true);
  coated.specularColor = {0.25F, 0.5F, 1};
  Probe probe(slabScene(coated));
  const Ray ray{Vec3(0, 1, 0), glm::normalize(Vec3(1, -1, 0))};
  const auto impulses = reference::impulsesOf(*probe.surfelAlong(ray), -ray.direction);
  ASSERT_EQ(impulses.count, 1) << "nothing is refracted";
  const double rise = std::pow(1 - std::sqrt(0.5), 5);
  const Vec3 expected(0.25 + 0.75 * rise, 0.5 + 0.5 * rise, 1);
  EXPECT_NEAR(glm::length(impulses.items[0].magnitude - expected), 0, 1e-14);
  coated.roughness = 1;
  Probe rough(slabScene(coated));
  EXPECT_EQ(reference::impulsesOf(*rough.surfelAlong(ray), -ray.direction).count, 0);
}

TEST(Sheet, IsStraightAndTheSameFromBothSides) {
  Scene scene;
  addFloor(scene, glass(1.5F, false), 0);
  addFloor(scene, emitter({1, 0, 0}), 10, false);
  addFloor(scene, emitter({0, 1, 0}), -10);
  Probe probe(scene);
  const double r = dielectricReflectance(std::sqrt(0.5), 1.5);
  const Vec3 above = probe.Li({0, 1, 0}, {1, -1, 0}), below = probe.Li({0, -1, 0}, {1, 1, 0});
  EXPECT_NEAR(above.x, r, 1e-14);
  EXPECT_NEAR(above.y, 1 - r, 1e-14);
  EXPECT_NEAR(below.x, 1 - r, 1e-14);
  EXPECT_NEAR(below.y, r, 1e-14);
}

}  // namespace
}  // namespace whittle::test
