// Direct light on the device against closed forms, and what no number can hold.
#include <cmath>
#include <limits>
#include <numbers>

#include "support/record.h"
#include "support/single_rays.h"

namespace whittle::test {
namespace {

constexpr double kPi = std::numbers::pi;

Scene plane(const Material& material, const Light& light) {
  Scene scene;
  addFloor(scene, material, 0);
  scene.lights.push_back(light);
  return scene;
}

TEST(DeviceLights, InverseSquareOverALambertPlane) {
  for (const float h : {1e-3F, 0.25F, 1.0F, 8.0F, 1e3F, 1e6F}) {
    const float intensity = 5 * h * h;  // as bright for every height
    const auto row =
        shootRowDown(plane(lambert(glm::vec3(0.6F)), pointLight({0, h, 0}, intensity)), 2, 40, 41, 1);
    for (std::size_t i = 0; i < 41; ++i) {
      const double x = static_cast<double>(i), height = h;
      const double expected = static_cast<double>(0.6F) * static_cast<double>(intensity) * height /
                              (kPi * std::pow(height * height + x * x, 1.5));
      EXPECT_NEAR(colorOf(row, i).x / expected, 1, 1e-5) << "h " << h << " x " << x;
    }
    EXPECT_EQ(row.stats.rays.shadow, 41U) << h;
  }
}

TEST(DeviceLights, AConeOfAHundredthOfADegreeLightsItsInsideOnly) {
  const double half = 0.01 * kPi / 180;
  Light spot = pointLight({0, 100, 0}, 1);
  spot.kind = LightKind::Spot;
  spot.direction = {0, -1, 0};
  spot.innerConeAngle = spot.outerConeAngle = static_cast<float>(half);
  const Scene scene = plane(lambert(glm::vec3(1)), spot);
  const auto lit = [&](double angle) {
    const RenderResult result = shoot(scene, {100 * std::tan(angle), 1, 0}, {0, -1, 0}, 1);
    EXPECT_EQ(result.stats.nonFinite, 0U) << "and not dark for want of a number";
    return colorOf(result).x;
  };
  Worst worst;
  for (const double inside : {0.0, half - 1e-5}) worst.absolute(lit(inside), 1e-4 / kPi);
  record({"24", "a cone of 0.01°, its axis and 1e-5 rad inside its edge", "I/h²/π", worst.result(),
          worst.error(), "absolute", 1e-9});
  record({"24", "the same 1e-5 rad outside", "0", fmt::format("{}", lit(half + 1e-5)), lit(half + 1e-5),
          "absolute", 0});
}

TEST(DeviceLights, ALightOnTheSurfaceIsFinite) {
  const auto row = shootRowDown(plane(lambert(glm::vec3(0.5F)), pointLight({0, 0, 0}, 5)), 2, 8, 9, 1);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(colorOf(row, i), glm::vec3(0)) << i;
  EXPECT_EQ(row.stats.nonFinite, 0U);
}

TEST(DeviceLights, WhatIsNotFiniteIsCountedAndLeftOut) {
  Material bright = lambert(glm::vec3(1e38F));
  bright.emission = glm::vec3(0.25F);
  Scene scene = plane(bright, pointLight({0, 2, 0}, 1e6F));
  auto row = shootRowDown(scene, 2, 8, 9, 1);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(colorOf(row, i), glm::vec3(0)) << i;
  EXPECT_EQ(row.stats.nonFinite, 9U);
  // A light of NaN spoils every sample that it reaches: they count, and are black.
  scene.materials[0] = lambert(glm::vec3(0.5F));
  scene.materials[0].emission = glm::vec3(0.25F);
  scene.lights[0].intensity = glm::vec3(std::numeric_limits<float>::quiet_NaN());
  row = shootRowDown(scene, 2, 8, 9, 1);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(colorOf(row, i), glm::vec3(0)) << i;
  EXPECT_EQ(row.stats.nonFinite, 9U);
}

}  // namespace
}  // namespace whittle::test
