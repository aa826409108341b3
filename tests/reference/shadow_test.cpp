// What stands between a surface and a light.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/probe.h"

namespace whittle::test {
namespace {

/// A white floor at y = 0, a light of 4 W/sr at y = 2 above it, sheets of `materials` at `heights`
/// in that order.
Probe underSheets(const std::vector<std::pair<float, Material>>& sheets, bool castsShadows = true) {
  Scene scene;
  addFloor(scene, lambert(glm::vec3(1)), 0);
  for (const auto& [height, material] : sheets) addFloor(scene, material, height, true, 5);
  scene.lights.push_back(pointLight({0.25F, 2, 0.125F}, 4));
  scene.lights.back().castsShadows = castsShadows;
  return Probe(scene);
}

constexpr double kLit = 1 / std::numbers::pi;  // 4/2² · 1/π

Vec3 below(Probe probe) { return probe.Li({0.25, 1e-3, 0.125}, {0, -1, 0}); }

Material sheet(const glm::vec3& colour, float transmission, float ior = 1) {
  Material m = glass(ior, false);
  m.baseColor = glm::vec4(colour, 1);
  m.transmission = transmission;
  return m;
}

TEST(Shadows, AnOpaqueSheetBlocksFromEitherSide) {
  EXPECT_NEAR(below(underSheets({})).x, kLit, 1e-12);
  EXPECT_EQ(below(underSheets({{1.0F, lambert(glm::vec3(1))}})).x, 0);
}

TEST(Shadows, WhatLiesBehindTheLightCastsNone) {
  EXPECT_NEAR(below(underSheets({{2.0001F, lambert(glm::vec3(1))}})).x, kLit, 1e-12);
  EXPECT_NEAR(below(underSheets({{2.0F, lambert(glm::vec3(1))}})).x, kLit, 1e-12) << "a lamp on the ceiling";
  EXPECT_EQ(below(underSheets({{1.9999F, lambert(glm::vec3(1))}})).x, 0);
}

TEST(Shadows, SwitchedOffByTheLightOrTheSettings) {
  EXPECT_NEAR(below(underSheets({{1.0F, lambert(glm::vec3(1))}}, false)).x, kLit, 1e-12);
  Probe probe = underSheets({{1.0F, lambert(glm::vec3(1))}});
  probe.settings().shadows = false;
  EXPECT_NEAR(probe.Li({0.25, 1e-3, 0.125}, {0, -1, 0}).x, kLit, 1e-12);
  EXPECT_EQ(probe.rays.shadow, 0);
}

TEST(Shadows, SheetsTintAndDimTheLight) {
  // ior 1 reflects nothing, so a sheet keeps τ·c; -log2 is rounded to 2⁻¹⁶: a relative error of ln 2 · 2⁻¹⁷.
  const Vec3 kept = below(underSheets({{1.0F, sheet({0.5F, 0.25F, 0}, 0.5F)}})) / kLit;
  EXPECT_NEAR(kept.x, 0.25, 0.25 * 6e-6);
  EXPECT_NEAR(kept.y, 0.125, 0.125 * 6e-6);
  EXPECT_EQ(kept.z, 0);
  // Normal incidence on n = 1.5: 1 − 0.04.
  EXPECT_NEAR(below(underSheets({{1.0F, sheet(glm::vec3(1), 1, 1.5F)}})).x / kLit, 0.96, 6e-6);
}

TEST(Shadows, BlendedSheetsLetTheRestThrough) {
  Material veil = lambert(glm::vec3(1));
  veil.alphaMode = AlphaMode::Blend;
  veil.baseColor.a = 0.75F;
  EXPECT_NEAR(below(underSheets({{1.0F, veil}})).x / kLit, 0.25, 0.25 * 6e-6);
}

TEST(Shadows, TheOrderOfSheetsDoesNotMatter) {
  const Material a = sheet({0.3F, 0.7F, 0.9F}, 0.9F), b = sheet({0.11F, 0.57F, 0.33F}, 0.7F, 1.4F),
                 c = sheet({0.83F, 0.21F, 0.6F}, 0.8F, 1.1F);
  const Vec3 one = below(underSheets({{0.5F, a}, {1.0F, b}, {1.5F, c}}));
  EXPECT_EQ(one, below(underSheets({{0.5F, c}, {1.0F, a}, {1.5F, b}})));
  EXPECT_EQ(one, below(underSheets({{1.5F, b}, {0.5F, c}, {1.0F, a}})));
  EXPECT_GT(one.y, 0);
}

TEST(Shadows, SixteenStopsAreDarkness) {
  std::vector<std::pair<float, Material>> sheets;
  for (int i = 0; i < 16; ++i)
    sheets.emplace_back(0.1F * static_cast<float>(i + 1), sheet(glm::vec3(0.5F), 1));
  EXPECT_NEAR(below(underSheets(sheets)).x / kLit, 0x1p-16, 0x1p-30);
  sheets.emplace_back(1.8F, sheet(glm::vec3(0.999F), 1));
  EXPECT_EQ(below(underSheets(sheets)).x, 0);
}

TEST(Shadows, UnlitSurfacesBlockWhateverTheirTransmission) {
  Material unlit = sheet(glm::vec3(1), 1);
  unlit.unlit = true;
  EXPECT_EQ(below(underSheets({{1.0F, unlit}})).x, 0);
}

}  // namespace
}  // namespace whittle::test
