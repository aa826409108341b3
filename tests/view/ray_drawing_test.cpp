// Rays over a picture: where points of space lie in it, and what of a line lies before the camera.
#include "view/ray_drawing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/single_rays.h"

namespace whittle::test {
namespace {

using view::DrawnRay;
using view::Line;

/// A camera at the origin that sees 1 m up and 2 m to the side at a distance of 1 m.
Camera wideCamera() {
  Camera camera;
  camera.yfov = static_cast<float>(2 * std::atan(1.0));
  return camera;
}

RayRecord rayTo(const glm::dvec3& from, const glm::dvec3& to) {
  RayRecord ray;
  ray.origin = from;
  ray.direction = glm::normalize(to - from);
  ray.hit = HitRecord{0, 0, 0, 0, to, {0, 0, 1}};
  return ray;
}

Scene unitBox() {
  Scene scene;
  addFloor(scene, lambert(glm::vec3(0.5F)), 0, true, 1);
  return scene;
}

TEST(RayDrawing, AnEyeRayIsThePointThatItMeets) {
  const auto drawn = view::drawnRays({{rayTo({0, 0, 0}, {1, 0.5F, -1})}, {}}, unitBox(), wideCamera(), 2);
  ASSERT_EQ(drawn.size(), 1U);
  EXPECT_EQ(drawn[0].line, Line::Eye);
  EXPECT_NEAR(drawn[0].x0, 0.75, 1e-6);
  EXPECT_NEAR(drawn[0].y0, 0.25, 1e-6);
  EXPECT_EQ(drawn[0].x0, drawn[0].x1);
}

TEST(RayDrawing, ImpulsesAndShadowRaysAreLinesOfTheirOwnKind) {
  RayTree tree{{rayTo({0, 0, 0}, {0, 0, -1})}, {}};
  RayRecord reflected = rayTo({0, 0, -1}, {1, 0, -0.5F}), refracted = rayTo({0, 0, -1}, {0, 1, -2});
  reflected.parent = refracted.parent = 0;
  tree.rays.push_back(reflected);
  tree.rays.push_back(refracted);
  ShadowRecord free{0, {0, 0, -1}, {0, 1, 0}, 1, glm::dvec3(1), glm::dvec3(1)}, blocked = free;
  blocked.arrived = glm::dvec3(0);
  blocked.length = std::numeric_limits<double>::infinity();
  tree.rays[0].shadows = {free, blocked};
  const auto drawn = view::drawnRays(tree, unitBox(), wideCamera(), 2);
  ASSERT_EQ(drawn.size(), 5U);
  EXPECT_EQ(drawn[1].line, Line::Shadow);
  EXPECT_NEAR(drawn[1].y1, 0, 1e-6) << "1 m up, 1 m away";
  EXPECT_EQ(drawn[2].line, Line::Blocked);
  EXPECT_LT(drawn[2].y1, 0) << "as long as the box is large";
  EXPECT_EQ(drawn[3].line, Line::Reflected);
  EXPECT_NEAR(drawn[3].x1, 1, 1e-6) << "1 m to the side, half a metre away";
  EXPECT_EQ(drawn[4].line, Line::Refracted);
  EXPECT_EQ(drawn[4].ray, 2U);
}

TEST(RayDrawing, WhatLiesBehindIsCutOff) {
  RayTree tree{
      {rayTo({0, 0, 0}, {0, 0, -1}), rayTo({0, 0.5F, -1}, {0, 0.5F, 3}), rayTo({0, 0, 2}, {0, 1, 3})}, {}};
  tree.rays[1].parent = tree.rays[2].parent = 0;
  const auto drawn = view::drawnRays(tree, unitBox(), wideCamera(), 2);
  ASSERT_EQ(drawn.size(), 2U) << "the third lies behind";
  EXPECT_NEAR(drawn[1].y0, 0.25, 1e-6);
  EXPECT_TRUE(std::isfinite(drawn[1].y1));
  EXPECT_LT(drawn[1].y1, -100) << "up and away";
}

}  // namespace
}  // namespace whittle::test
