// Closed forms over many bounces: whatever reflects and refracts without loss is invisible in a uniform
// surrounding; two parallel mirrors are a geometric series.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/probe.h"
#include "support/random_scenes.h"

namespace whittle::test {
namespace {

/// A sphere of flat facets, or smooth over them, its front outwards.
void addSphere(Scene& scene, const Material& material, const glm::vec3& centre, float radius, bool smooth) {
  constexpr int kSlices = 16, kStacks = 8;
  const std::uint32_t m = addMaterial(scene, material);
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  scene.normals.resize(scene.positions.size(), glm::vec3(0));
  for (int stack = 0; stack <= kStacks; ++stack) {
    for (int slice = 0; slice <= kSlices; ++slice) {
      const double theta = std::numbers::pi * stack / kStacks, phi = 2 * std::numbers::pi * slice / kSlices;
      const glm::dvec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
      scene.positions.push_back(centre + radius * glm::vec3(n));
      scene.normals.push_back(smooth ? glm::vec3(n) : glm::vec3(0));
    }
  }
  for (std::uint32_t stack = 0; stack < kStacks; ++stack) {
    for (std::uint32_t slice = 0; slice < kSlices; ++slice) {
      const std::uint32_t a = first + stack * (kSlices + 1) + slice, b = a + kSlices + 1;
      if (stack > 0) scene.triangles.push_back({a, b, a + 1, m});
      if (stack + 1 < kStacks) scene.triangles.push_back({a + 1, b, b + 1, m});
    }
  }
}

Settings deep(int bounces) {
  Settings settings;
  settings.bounces = bounces;
  return settings;
}

void expectFurnace(Probe& probe, double tolerance) {
  Rng rng(7);
  for (int i = 0; i < 300; ++i) {
    const Vec3 w(rng.direction());
    const Vec3 aim(rng.inBox(1.2F));
    const Vec3 seen = probe.Li(aim - 6.0 * w, w);
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(seen[c], 1, tolerance) << "ray " << i;
  }
  EXPECT_GT(probe.rays.impulse, 100) << "most rays should have met something";
}

Scene uniformSurrounding() {
  Scene scene;
  scene.background.radiance = glm::vec3(1);
  return scene;
}

TEST(Furnace, Mirrors) {
  Scene scene = uniformSurrounding();
  addSphere(scene, mirror(glm::vec3(1)), {-0.8F, 0, 0}, 0.7F, false);
  addSphere(scene, mirror(glm::vec3(1)), {0.8F, 0, 0}, 0.7F, true);
  Probe probe(scene, deep(64));
  expectFurnace(probe, 1e-9);
}

TEST(Furnace, Glass) {
  Scene scene = uniformSurrounding();
  addSphere(scene, glass(1.5F, true), {0, 0, 0}, 1, false);
  Probe probe(scene, deep(400));  // facets can hold light by total reflection for long
  expectFurnace(probe, 1e-9);
}

TEST(Furnace, SheetsAndHalfMetals) {
  Scene scene = uniformSurrounding();
  Material half = mirror(glm::vec3(1));
  half.metallic = 0.5F;
  half.transmission = 1;
  half.alphaMode = AlphaMode::Blend;
  half.baseColor.a = 0.6F;
  addFloor(scene, half, 0, true, 1.5F);
  addFloor(scene, glass(1.5F, false), 0.5F, false, 1.5F);
  // The sheets reflect 0.6 (0.5 · 0.04 + 0.5) = 0.312 and 0.04: 0.0125^24 is left after 48
  // bounces between them.
  Probe probe(scene, deep(48));
  Rng rng(3);
  for (int i = 0; i < 50; ++i) {
    const double x = rng.between(-0.2F, 0.2F), z = rng.between(-0.2F, 0.2F);
    EXPECT_NEAR(probe.Li({x, 3, z}, {0, -1, 0}).x, 1, 1e-9);
  }
}

TEST(Mirrors, TwoFacingEachOtherAreAGeometricSeries) {
  constexpr double kRho = 0.75, kEmission = 2;  // exact in single precision
  Material material = mirror(glm::vec3(kRho));
  material.emission = glm::vec3(kEmission);
  Scene scene;
  addFloor(scene, material, 0, true);
  addFloor(scene, material, 1, false);
  Probe probe(scene);
  for (const int reflections : {0, 1, 2, 7, 63}) {
    probe.settings().bounces = reflections + 1;
    const double series = kEmission * (1 - std::pow(kRho, reflections + 1)) / (1 - kRho);
    EXPECT_NEAR(probe.Li({0.1, 0.5, 0.2}, {0, 1, 0}).x, series, 1e-13 * (reflections + 1));
  }
}

TEST(Mirrors, ACornerSendsLightBack) {
  Scene scene;
  const std::uint32_t m = addMaterial(scene, mirror(glm::vec3(1)));
  addQuad(scene, m, {0, 0, 0}, {9, 0, 0}, {0, 9, 0});
  addQuad(scene, m, {0, 0, 0}, {0, 9, 0}, {0, 0, 9});
  addQuad(scene, m, {0, 0, 0}, {0, 0, 9}, {9, 0, 0});
  Probe probe(scene);
  Ray ray{Vec3(2, 3, 4), glm::normalize(Vec3(-1, -0.9, -1.1))};
  const Vec3 start = ray.direction;
  int reflections = 0;
  while (const auto surfel = probe.surfelAlong(ray)) {
    ray = {surfel->position + surfel->rayOffset * surfel->facing,
           reference::impulsesOf(*surfel, -ray.direction).items[0].w_i};
    ++reflections;
    ASSERT_LT(reflections, 5);
  }
  EXPECT_EQ(reflections, 3);
  EXPECT_NEAR(glm::length(ray.direction + start), 0, 1e-15 * 3);
}

}  // namespace
}  // namespace whittle::test
