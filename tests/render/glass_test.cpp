// Mirrors and glass on the device against their formulas: specular furnace, series between mirrors and in a
// slab, refraction, total reflection, grazing light, absorption.
#include <cmath>
#include <limits>
#include <numbers>

#include "support/record.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Fresnel's equations as printed in optics books: angles, not cosines.
double fresnel(double angle, double eta) {
  const double refracted = std::asin(std::sin(angle) / eta);
  if (angle < 1e-9) return std::pow((1 - eta) / (1 + eta), 2);
  const double s = std::sin(angle - refracted) / std::sin(angle + refracted);
  const double p = std::tan(angle - refracted) / std::tan(angle + refracted);
  return (s * s + p * p) / 2;
}

TEST(DeviceFurnace, NothingIsBrighterAndNearlyAllIsWhite) {
  constexpr int kBounces = 12;
  const RenderResult result = renderOnDevice(ownScene("white_furnace"), smallSettings(kBounces));
  std::size_t white = 0;
  for (const float v : result.radiance.pixels) {
    ASSERT_LE(v, 1 + 2e-6 * kBounces);
    white += std::abs(v - 1) <= 2e-6 * kBounces;
  }
  // Grazing light in the balls and what total reflection holds in the block leave later than at
  // the last bounce.
  EXPECT_GT(double(white), 0.9 * double(result.radiance.pixels.size()));
  EXPECT_GT(result.stats.rays.impulse, 20000U);
}

TEST(DeviceFurnace, PlatesAndMirrorsAreInvisible) {
  Scene scene;
  scene.background.radiance = glm::vec3(1);
  const float tilt = 0.4F;
  addFloor(scene, glass(1.5F, true), 1, true, 40);
  addFloor(scene, glass(1.5F, true), 0, false, 40);
  addQuad(scene, addMaterial(scene, mirror(glm::vec3(1))), {-40, -3, -40}, {0, 0, 80}, {80, 80 * tilt, 0});
  for (const int bounces : {16, 32}) {
    for (const double x : {0.0, 0.5, 1.0}) {
      const glm::vec3 seen = shot(scene, {-20, 5, 0}, {x, -1, 0.1}, bounces);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(seen[c], 1, 2e-6 * bounces) << "x " << x << " bounces " << bounces;
    }
  }
}

TEST(DeviceMirrors, TwoFacingEachOtherAreAGeometricSeries) {
  constexpr double kRho = 0.75, kEmission = 2;  // exact in single precision
  Material material = mirror(glm::vec3(kRho));
  material.emission = glm::vec3(kEmission);
  Scene scene;
  addFloor(scene, material, 0, true);
  addFloor(scene, material, 1, false);
  for (const int reflections : {0, 1, 2, 7, 63}) {
    const double series = kEmission * (1 - std::pow(kRho, reflections + 1)) / (1 - kRho);
    const glm::vec3 seen = shot(scene, {0.1, 0.5, 0.2}, {0, 1, 0}, reflections + 1);
    EXPECT_NEAR(seen.x, series, 1e-6 * std::max(1, reflections)) << reflections;
  }
}

TEST(DeviceMirrors, WhatUnderflowsIsNotTracedOn) {
  Scene scene;
  addFloor(scene, mirror(glm::vec3(1e-3F)), 0, true);
  addFloor(scene, mirror(glm::vec3(1e-3F)), 1, false);
  const RenderResult result = shoot(scene, {0.1, 0.5, 0.2}, {0, 1, 0}, 64);
  EXPECT_EQ(colorOf(result), glm::vec3(0));
  // 1e-3^15 is the last power above half of the smallest subnormal, 2^-149 = 1.4e-45.
  EXPECT_LE(result.stats.rays.impulse, 15U);
  EXPECT_GE(result.stats.rays.impulse, 12U) << "1e-36 is still a number";
}

/// A slab of `material` between y = 0 and −1; what comes from above is red, from below green, 1 each. Origins
/// of secondary rays are 2^-20 of the slab's half side off it.
Scene slabScene(const Material& material, float half = 50) {
  Scene scene;
  addFloor(scene, material, 0, true, half);
  addFloor(scene, material, -1, false, half);
  addFloor(scene, emitter({1, 0, 0}), 10, false);
  addFloor(scene, emitter({0, 1, 0}), -10);
  return scene;
}

TEST(DeviceSlab, SeriesAtEachDepth) {
  const Scene scene = slabScene(glass(1.5F, true));
  const double r = 0.04, t = 0.96;
  double reflected = 0, transmitted = 0;
  for (int depth = 1; depth <= 10; ++depth) {
    if (depth == 2) reflected += r;
    if (depth >= 4 && depth % 2 == 0) reflected += t * t * std::pow(r, depth - 3);
    if (depth >= 3 && depth % 2 == 1) transmitted += t * t * std::pow(r, depth - 3);
    const glm::vec3 seen = shot(scene, {0.1, 5, 0.2}, {0, -1, 0}, depth);
    EXPECT_NEAR(seen.x, reflected, 1e-6) << depth;
    EXPECT_NEAR(seen.y, transmitted, 1e-6) << depth;
  }
  EXPECT_NEAR(reflected, 0.076923, 1e-6);
  EXPECT_NEAR(transmitted, 0.923077, 1e-6);
}

/// A slab of glass over an unlit ground at −`depth` whose red says where it is: x = 8 red/green − 4.
Scene rulerScene(float depth) {
  Scene scene;
  addFloor(scene, glass(1.5F, true), 0, true, 4);
  addFloor(scene, glass(1.5F, true), -1, false, 4);
  Material ruler;
  ruler.unlit = true;
  addQuad(scene, addMaterial(scene, ruler), {-4, -depth, -4}, {0, 0, 8}, {8, 0, 0});
  scene.colors.assign(scene.positions.size(), glm::vec4(1));
  for (std::size_t v = scene.positions.size() - 4; v < scene.positions.size(); ++v)
    scene.colors[v] = {(scene.positions[v].x + 4) / 8, 1, 0, 1};
  return scene;
}

TEST(DeviceSlab, ShiftsALightRayAt45DegreesAndKeepsItsDirection) {
  const auto metX = [](float depth) {
    const glm::vec3 seen = shot(rulerScene(depth), {-4, 1, 0.3}, {1, -1, 0}, 3);
    return 8 * static_cast<double>(seen.x / seen.y) - 4;
  };
  const double shallow = metX(2), deep = metX(5);
  // The undisturbed ray meets the ground at −3 + depth. The two ray offsets of 4e-6 m go along the normal; 8
  // m are rounded.
  Worst shift, parallel;
  shift.absolute((-3 + 2 - shallow) * std::sqrt(0.5), 0.329142);
  record(
      {"16", "slab of 1 m, n = 1.5, 45°", "shifted by 0.329142 m", shift.result(), shift.error(), "m", 8e-6});
  parallel.absolute(deep - shallow, 3);
  record({"16", "the same: met 3 m deeper", "3 m further on: parallel to the entry", parallel.result(),
          parallel.error(), "m", 4e-6});
}

TEST(DeviceSlab, GlassThatEqualsAirIsInvisible) {
  Worst worst;
  for (const glm::dvec3& w : {glm::dvec3(0, -1, 0), glm::dvec3(1, -1, 0), glm::dvec3(3, -1, 0.5)}) {
    for (const float ior : {1.0F, std::nextafter(1.0F, 0.0F), std::nextafter(1.0F, 2.0F)}) {
      const glm::vec3 seen = shot(slabScene(glass(ior, true)), {0, 1, 0}, w, 8);
      worst.absolute(seen.x, 0);
      worst.absolute(seen.y, 1);
    }
  }
  record({"19", "slab of index 1 and its neighbours 1 ± 1 ulp, three angles", "invisible", worst.result(),
          worst.error(), "absolute", 1e-6});
}

TEST(DeviceSlab, AbsorbsByBeersLaw) {
  for (const float sigma : {0.0F, 1e-30F, 1.0F, 3.5F, 1e30F, std::numeric_limits<float>::infinity()}) {
    Material tinted = glass(1, true);
    tinted.sigma_a = glm::vec3(sigma, 0, sigma);
    Scene scene = slabScene(tinted, 4);
    scene.materials.back().emission = glm::vec3(1);
    const glm::vec3 seen = shot(scene, {0, 1, 0}, {1, -1, 0}, 8);
    Worst worst;
    worst.absolute(seen.x, std::exp(-sigma * std::sqrt(2.0)));
    worst.absolute(seen.y, 1);
    record({"21", fmt::format("√2 m of glass, σ = {:g}/m in red, 0 in green", sigma), "e^(−σ √2), 1",
            worst.result(), worst.error(), "absolute", 4e-6});  // the ray offset shortens the way by 5e-6 m
  }
}

/// Light seen reflected in the surface of a solid at y = 0: its share, times nothing else.
double reflectedShare(float ior, const glm::dvec3& origin, const glm::dvec3& direction) {
  Scene scene;
  addFloor(scene, glass(ior, true), 0);
  // What is reflected stays on the side of the origin; the lamp stands there alone.
  const bool above = origin.y > 0;
  const float height = above ? 60.0F : -60.0F;
  const std::uint32_t lamp = addMaterial(scene, emitter(glm::vec3(1)));
  addQuad(scene, lamp, {40, 0, -50}, {0, 0, 100}, {0, height, 0});
  addQuad(scene, lamp, {-40, height, -50}, {0, 0, 100}, {80, 0, 0});
  return shot(scene, origin, direction, 2).x;
}

TEST(DeviceFresnel, OfIorZeroRisesFromTheColourToOne) {
  Material m = glass(0, false);
  m.transmission = 0;
  m.baseColor = glm::vec4(0, 0, 0, 1);
  m.specularColor = {0.25F, 0.5F, 0};
  Scene scene;
  scene.background.radiance = glm::vec3(1);
  addFloor(scene, m, 0);
  Worst worst;
  for (const double degrees : {0.0, 60.0, 85.0}) {
    const double cosine = std::cos(degrees * kDegree), weight = std::pow(1 - cosine, 5);
    const glm::vec3 seen = shot(scene, {0, 1, 0}, {std::sin(degrees * kDegree), -cosine, 0}, 2);
    for (int c = 0; c < 3; ++c) {
      const double f0 = static_cast<double>(m.specularColor[c]);
      worst.absolute(seen[c], f0 + (1 - f0) * weight);
    }
  }
  record({"20", "ior 0, specular colour k, smooth, three angles", "k + (1 − k)(1 − cos)⁵", worst.result(),
          worst.error(), "absolute", 1e-6});
}

TEST(DeviceFresnel, Brewster) {
  const double angle = std::atan(1.5);
  EXPECT_NEAR(angle / kDegree, 56.3099, 5e-5);
  Worst worst;
  worst.absolute(reflectedShare(1.5F, {0, 1, 0}, {std::sin(angle), -std::cos(angle), 0}), 0.0739645);
  record({"20", "Brewster's angle, n = 1.5, unpolarised", "0.0739645", worst.result(), worst.error(),
          "absolute", 5e-7});
}

TEST(DeviceFresnel, GlassInWater) {
  EXPECT_NEAR(reflectedShare(1.5F / 1.33F, {0, 1, 0}, {0, -1, 0}), 0.0036085, 2e-7);
}

TEST(DeviceFresnel, RisesToTotalReflectionAtTheCriticalAngle) {
  const double critical = std::asin(1 / 1.5);
  EXPECT_NEAR(critical / kDegree, 41.8103, 5e-5);
  double last = 0;
  for (int k = 1; k <= 6; ++k) {
    const double away = std::pow(10.0, -k);
    const auto inside = [&](double angle) {
      return reflectedShare(1.5F, {0, -0.5, 0}, {std::sin(angle), std::cos(angle), 0});
    };
    const double below = inside(critical - away);
    // R = 1 − O(√away): an angle rounded by 1e-7 moves it by 1e-6/√away.
    Worst worst;
    worst.absolute(below, fresnel(critical - away, 1 / 1.5));
    record({"17", fmt::format("10^-{} rad below the critical angle (41.8103°)", k),
            "Fresnel, rising; 1 as far above", worst.result(),
            below > last && inside(critical + away) == 1 ? worst.error() : INFINITY, "absolute",
            1e-6 + 2e-6 / std::sqrt(away)});
    last = below;
  }
  EXPECT_LE(last, 1);
}

TEST(DeviceFresnel, GrazingLightIsReflectedAndNeverMoreThanAll) {
  double last = 0;
  for (int k = 0; k <= 4; ++k) {
    const double grazing = std::pow(10.0, -k) * kDegree;
    const double r =
        reflectedShare(1.5F, {-20, 20 * std::tan(grazing), 0}, {std::cos(grazing), -std::sin(grazing), 0});
    EXPECT_LE(r, 1) << k;
    EXPECT_GT(r, last) << k;
    Worst worst;
    worst.absolute(r, fresnel(std::numbers::pi / 2 - grazing, 1.5));
    record({"18", fmt::format("10^-{}° above the surface, n = 1.5", k), "Fresnel, rising, at most 1",
            worst.result(), r <= 1 && r > last ? worst.error() : INFINITY, "absolute", 2e-6});
    last = r;
  }
}

}  // namespace
}  // namespace whittle::test
