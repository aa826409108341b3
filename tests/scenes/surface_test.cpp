// Surfaces that a formula gives, and balls in a heap.
#include <cmath>
#include <numbers>

#include "scenes/surface_checks.h"
#include "shapes/heap.h"
#include "shapes/surface.h"

namespace generator::test {
namespace {

using std::numbers::pi;

/// A ball whose height grows evenly along v, so that both ends are points to the last bit.
glm::dvec3 onUnitBall(glm::dvec2 uv) {
  const double across = 2 * std::sqrt(uv.y * (1 - uv.y)), around = 2 * pi * uv.x;
  return {across * std::cos(around), 2 * uv.y - 1, -across * std::sin(around)};
}

TEST(SceneKitSurfaces, ARoundOneIsClosedAndLooksOutwards) {
  const Mesh ball = makeSurface({.columns = 96, .rows = 192, .isRound = true, .position = onUnitBall});
  EXPECT_EQ(openEdges(ball), 0U);
  EXPECT_EQ(ball.indices.size(), 3U * 2 * 96 * (192 - 1));  // a row at each end has triangles, not squares
  // Facets lie inside the ball: of a circle of n corners they leave out the share (2π/n)²/6, here 7e-4; rings
  // are finer but for the last, whose cap of height 1/96 loses less than its volume, π/96² of 4π/3.
  EXPECT_NEAR(volume(ball), 4 * pi / 3, 1.5e-3 * 4 * pi / 3);
  for (std::size_t i = 0; i < ball.positions.size(); ++i) {
    // A twentieth of a square to both sides: at the ends, where all is bent most, that far from the axis.
    const double beside = 2 * std::sqrt(0.05 / 192);
    EXPECT_GT(glm::dot(ball.normals[i], ball.positions[i]), 1 - beside * beside) << i;
  }
}

TEST(SceneKitSurfaces, AnOpenOneHasItsBorderItsTextureAndItsColours) {
  const glm::dvec3 u(3, 0, 0), v(0, 1, -2);
  SurfaceSpec spec{.columns = 6, .rows = 4, .position = {}, .color = {}, .repeat = {5, 7}};
  spec.position = [&](glm::dvec2 uv) { return uv.x * u + uv.y * v; };
  spec.color = [](glm::dvec2 uv) { return glm::dvec3(uv, 0.25); };
  const Mesh sheet = makeSurface(spec);
  EXPECT_EQ(openEdges(sheet), 2U * (6 + 4));
  EXPECT_EQ(badNormals(sheet), 0);
  const glm::vec3 normal(glm::normalize(glm::cross(u, v)));
  for (std::size_t i = 0; i < sheet.positions.size(); ++i) {
    EXPECT_NEAR(glm::distance(sheet.normals[i], normal), 0, 1e-6);  // rounded to float
    // A picture stands upright where v points up.
    const glm::dvec2 uv(sheet.uv0[i].x / 5, 1 - sheet.uv0[i].y / 7);
    EXPECT_NEAR(glm::distance(glm::dvec3(sheet.positions[i]), spec.position(uv)), 0, 1e-6);
    EXPECT_NEAR(glm::distance(glm::dvec3(sheet.colors[i]), spec.color(uv)), 0, 1e-6);
  }
}

HeapSpec cherries() {
  HeapSpec spec{
      .count = 24, .radius = 1, .spread = 3, .start = 2, .steps = 500, .series = 77, .distance = {}};
  spec.distance = [](glm::dvec3 p) { return 6 - glm::length(p - glm::dvec3(0, 6, 0)); };  // a round bowl
  return spec;
}

TEST(SceneKitHeaps, BallsRestOnOneAnotherAndOnTheBowl) {
  const HeapSpec spec = cherries();
  const std::vector<glm::dvec3> balls = heapOfBalls(spec);
  ASSERT_EQ(balls.size(), 24U);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    double gap = spec.distance(balls[i]) - spec.radius;
    EXPECT_GT(gap, -0.02) << i;
    double least = gap;
    for (std::size_t k = 0; k < balls.size(); ++k) {
      if (k == i) continue;
      gap = glm::distance(balls[i], balls[k]) - 2 * spec.radius;
      EXPECT_GT(gap, -0.04) << i << " and " << k;  // a fiftieth of a diameter, which nobody sees
      // What holds a ball up is beside it or below.
      if (balls[k].y < balls[i].y) least = std::min(least, gap);
    }
    EXPECT_LT(least, 0.04) << i << " floats";
  }
  EXPECT_EQ(heapOfBalls(spec), balls);
}

}  // namespace
}  // namespace generator::test
