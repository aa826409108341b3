// Shapes of the scene kit: closed, outwards, and as large as a formula says.
#include <numbers>
#include <numeric>

#include "scenes/surface_checks.h"
#include "shapes/gear.h"
#include "shapes/lathe.h"
#include "shapes/lettering.h"
#include "shapes/plate.h"
#include "shapes/sweep.h"
#include "shapes/triangulate.h"

namespace generator::test {
namespace {

using std::numbers::pi;

void expectSolid(const Mesh& mesh, const char* what) {
  EXPECT_EQ(openEdges(mesh), 0U) << what;
  EXPECT_GT(volume(mesh), 0) << what;
  EXPECT_EQ(badNormals(mesh), 0) << what;
}

/// The signed area of a polygon.
double area(const std::vector<glm::dvec2>& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const glm::dvec2 a = loop[i], b = loop[(i + 1) % loop.size()];
    sum += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return sum;
}

std::vector<glm::dvec2> positionsOf(const Outline& outline) { return inset(outline, 0); }

PlateSpec wheelSpec() {
  return {.outline = gearOutline({40, 10}),
          .holes = spokeHoles(5, 2.2, 8, 0.9, 0.4),
          .height = 1,
          .bevel = 0.05,
          .bevelSteps = 3};
}

TEST(SceneKitOutlines, RoundedCornersAreArcsThatTouchBothSides) {
  const Outline square = roundCorners(withRadius({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 1), true, 0.01);
  // A square of side 4 less what four quarters of a circle leave out of their squares.
  EXPECT_NEAR(area(positionsOf(square)), 16 - (4 - pi), 1e-3);
  for (const OutlinePoint& p : square.points) {
    const glm::dvec2 center = glm::clamp(p.position, glm::dvec2(1), glm::dvec2(3));
    EXPECT_NEAR(glm::distance(p.position, center), 1, 1e-12);
    EXPECT_NEAR(glm::distance(p.normal, p.position - center), 0, 1e-12);
  }
}

TEST(SceneKitOutlines, AConcaveCornerIsRoundedToTheOtherSide) {
  const Outline notch = roundCorners({{0, 0, 0}, {2, 0, 0.5}, {2, 2, 0}}, false, 0.01);
  const Outline wedge = roundCorners({{2, 2, 0}, {2, 0, 0.5}, {0, 0, 0}}, false, 0.01);
  ASSERT_EQ(notch.points.size(), wedge.points.size());
  for (std::size_t i = 0; i < notch.points.size(); ++i) {
    const OutlinePoint &a = notch.points[i], &b = wedge.points[wedge.points.size() - 1 - i];
    EXPECT_NEAR(glm::distance(a.position, b.position), 0, 1e-12);
    EXPECT_NEAR(glm::distance(a.normal, -b.normal), 0, 1e-12);
  }
}

TEST(SceneKitOutlines, AHullOfTwoCirclesHasTheirTangents) {
  const Outline hull = hullOutline({{0, 0}, 2}, {{6, 0}, 1}, 0.005);
  // Trapezoids between the tangent points, and the arcs outside of them.
  const double lean = std::asin(1.0 / 6), length = 6 * std::cos(lean);
  const double expected = 3 * length + 4 * (pi / 2 + lean) + 1 * (pi / 2 - lean);
  EXPECT_NEAR(area(positionsOf(hull)), expected, 1e-3);
}

TEST(SceneKitOutlines, ThePointOfAToothLiesAtTheTipRadius) {
  const GearSpec gear{40, 10};
  double highest = 0, lowest = 100;
  for (const OutlinePoint& p : gearOutline(gear).points) {
    highest = std::max(highest, glm::length(p.position));
    lowest = std::min(lowest, glm::length(p.position));
  }
  EXPECT_NEAR(highest, gear.tipRadius(), 0.01);
  EXPECT_NEAR(lowest, gear.rootRadius(), 0.02);
}

TEST(SceneKitTriangles, CoverAPolygonWithHolesOnce) {
  const PlateSpec spec = wheelSpec();
  std::vector<std::vector<glm::dvec2>> loops{positionsOf(spec.outline)};
  for (const Outline& hole : spec.holes) loops.push_back(positionsOf(hole));
  std::vector<glm::dvec2> points;
  double expected = 0;
  for (const auto& loop : loops) {
    expected += area(loop);  // holes run clockwise
    points.insert(points.end(), loop.begin(), loop.end());
  }
  const auto triangles = triangulate(loops);
  EXPECT_EQ(triangles.size(), points.size() + 2 * spec.holes.size() - 2);  // Euler
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const double one = area({points[a], points[b], points[c]});
    EXPECT_GT(one, -1e-12);
    sum += one;
  }
  EXPECT_NEAR(sum, expected, 1e-9 * expected);
}

TEST(SceneKitTriangles, ALoopTheWrongWayAroundIsRefused) {
  EXPECT_THROW(triangulate({{{0, 0}, {0, 1}, {1, 1}, {1, 0}}}), std::logic_error);
}

TEST(SceneKitLathe, TurnsASemicircleIntoABall) {
  Outline half;
  half.isClosed = false;
  for (int k = 0; k <= 90; ++k) {
    const glm::dvec2 n = onCircle(k - 45 + 180, 180);
    half.points.push_back({2.0 * n, n});
  }
  half.points.front().position.x = half.points.back().position.x = 0;
  const Mesh ball = makeLathe(half, 180);
  expectSolid(ball, "ball");
  EXPECT_NEAR(volume(ball), 4.0 / 3 * pi * 8, 0.05);
  EXPECT_EQ(ball.indices.size() / 3, 180U * (2 * 90 - 2));
}

TEST(SceneKitLathe, TurnsAClosedProfileIntoARing) {
  const Mesh ring = makeLathe(circleOutline(1, 64, {5, 0}), 256);
  expectSolid(ring, "ring");
  EXPECT_NEAR(volume(ring), 2 * pi * pi * 5, 0.25);  // Pappus and Guldin
}

TEST(SceneKitSweep, GoesAroundAClosedPathWithoutATwist) {
  SweepSpec spec;
  // A trefoil, whose frames come back turned.
  for (int i = 0; i < 200; ++i) {
    const glm::dvec2 a = onCircle(i, 200), b = onCircle(2 * i, 200), c = onCircle(3 * i, 200);
    spec.path.push_back(3.0 * glm::dvec3(a.y + 2 * b.y, a.x - 2 * b.x, -c.y));
  }
  spec.isClosed = true;
  spec.section = rectangleOutline({-1, -0.4}, {1, 0.4}, 0.2);
  const Mesh loop = makeSweep(spec);
  EXPECT_EQ(openEdges(loop), 0U);
  EXPECT_EQ(badNormals(loop), 0);
  // Rings follow one another evenly, the first after the last as well.
  const std::size_t stride = spec.section.points.size() + 1;
  double longest = 0;
  for (std::size_t i = 0; i + stride < loop.positions.size(); ++i)
    longest =
        std::max(longest, static_cast<double>(glm::distance(loop.positions[i], loop.positions[i + stride])));
  EXPECT_LT(longest, 0.9);  // points of the path are up to 0.5 apart, the section reaches out by 1.1
  spec.path.clear();
  for (int i = 0; i < 200; ++i) spec.path.emplace_back(5 * onCircle(i, 200).x, 0, 5 * onCircle(i, 200).y);
  spec.section = circleOutline(1, 64);
  EXPECT_NEAR(volume(makeSweep(spec)), 2 * pi * pi * 5, 0.25);
}

TEST(SceneKitSweep, EndsInHalfBalls) {
  const Mesh wire = makeWire({{0, 0, 0}, {3, 0, 0}, {6, 0, 0}}, 1, 128);
  expectSolid(wire, "wire");
  // Caps of a few rings are a little smaller than half balls.
  EXPECT_NEAR(volume(wire), pi * 6 + 4.0 / 3 * pi, 0.2);
  SweepSpec flat{.path = {{0, 0, 0}, {6, 0, 0}}, .section = circleOutline(1, 128)};
  const Mesh rod = makeSweep(flat);
  EXPECT_EQ(openEdges(rod), 0U);
  EXPECT_NEAR(volume(rod), pi * 6, 0.02);
}

TEST(SceneKitSweep, ASmoothPathGoesThroughItsPoints) {
  const std::vector<glm::dvec3> points{{0, 0, 0}, {1, 2, 0}, {3, 1, 1}, {4, 0, 0}};
  const std::vector<glm::dvec3> path = smoothPath(points, 10);
  ASSERT_EQ(path.size(), 31U);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(path[10 * i], points[i]);
}

TEST(SceneKitPlates, AreClosedWithTheirHoles) {
  PlateSpec spec = wheelSpec();
  expectSolid(joined(makePlate(spec)), "wheel");
  // Without bevels the volume is that of the outline less the holes.
  double base = area(positionsOf(spec.outline));
  for (const Outline& hole : spec.holes) base += area(positionsOf(hole));
  spec.bevel = 1e-4;
  EXPECT_NEAR(volume(joined(makePlate(spec))), base, 1e-2);
}

TEST(SceneKitPlates, ARoundedBoxHasRoundEdges) {
  const double r = 0.5;
  const Mesh box = makeRoundedBox({1, 2, 3}, {5, 5, 8}, r);
  expectSolid(box, "box");
  // Minkowski's sum of the inner box and a ball.
  const glm::dvec3 d = glm::dvec3(4, 3, 5) - 2 * r;
  const double expected = d.x * d.y * d.z + 2 * r * (d.x * d.y + d.y * d.z + d.z * d.x) +
                          pi * r * r * (d.x + d.y + d.z) + 4.0 / 3 * pi * r * r * r;
  EXPECT_NEAR(volume(box), expected, 0.01 * expected);
  for (const glm::vec3& p : box.positions) {
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(p, glm::vec3(0.9999F, 1.9999F, 2.9999F))));
    EXPECT_TRUE(glm::all(glm::lessThanEqual(p, glm::vec3(5.0001F, 5.0001F, 8.0001F))));
  }
}

TEST(SceneKitLettering, EveryLetterIsDrawnAndOthersAreRefused) {
  const Mesh text = makeText("ABCDEFGHIJKLMNOPQRSTUVWXYZ 0123456789.-", 1, 0.15);
  EXPECT_EQ(openEdges(text), 0U);
  glm::vec3 low(1e9F), high(-1e9F);
  for (const glm::vec3& p : text.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  EXPECT_NEAR(high.z - low.z, 1.15, 1e-3);  // the height and half a stroke on both sides
  EXPECT_NEAR(high.x, -low.x, 0.2);
  EXPECT_THROW(makeText("a", 1, 0.1), std::logic_error);
}

TEST(SceneKitLettering, StrokesAreRoundAtTheirCorners) {
  // An L, 6 high and 4 wide on its grid: each point of it lies half a stroke from one of the two lines that
  // it is drawn along, and looks away from there.
  const Mesh text = makeText("L", 6, 0.9);
  const auto nearestOn = [](glm::vec3 p, glm::vec3 a, glm::vec3 b) {
    return glm::mix(a, b, std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0F, 1.0F));
  };
  const glm::vec3 top(-2, 0, -3), corner(-2, 0, 3), right(2, 0, 3);
  for (std::size_t i = 0; i < text.positions.size(); ++i) {
    const glm::vec3 p = text.positions[i];
    const auto isRound = [&](glm::vec3 a, glm::vec3 b) {
      return glm::distance((p - nearestOn(p, a, b)) / 0.45F, text.normals[i]) < 1e-5F;
    };
    EXPECT_TRUE(isRound(top, corner) || isRound(corner, right)) << i;
  }
}

}  // namespace
}  // namespace generator::test
