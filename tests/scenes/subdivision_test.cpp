// Subdivision surfaces and cloth.
#include "scenes/surface_checks.h"
#include "shapes/cloth.h"

namespace generator::test {
namespace {

TEST(SceneKitSubdivision, FollowsTheRuleOfCatmullAndClark) {
  const Cage cube = makeBoxCage(glm::dvec3(-1), glm::dvec3(1), glm::ivec3(1));
  const Cage once = subdivided(cube);
  EXPECT_EQ(once.points.size(), 8U + 6U + 12U);
  EXPECT_EQ(once.quads.size(), 24U);
  // A corner of three faces: (Q + 2R) / 3 with Q = 1/3 and R = 2/3. An edge: the mean of its ends and two
  // centres.
  for (std::size_t i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(std::abs(once.points[i][k]), 5.0 / 9, 1e-12);
  for (std::size_t i = 14; i < 26; ++i) {
    const glm::dvec3 p = glm::abs(once.points[i]);
    EXPECT_NEAR(p.x + p.y + p.z, 1.5, 1e-12);
  }
}

TEST(SceneKitSubdivision, StaysClosedAndOutwards) {
  Cage cage = makeBoxCage({-1, 0, -2}, {1, 1, 2}, {2, 1, 3});
  EXPECT_GT(volume(meshOf(cage)), 0);
  EXPECT_NEAR(volume(meshOf(cage)), 8, 1e-6);
  for (int i = 0; i < 3; ++i) cage = subdivided(cage);
  const Mesh mesh = meshOf(cage);
  EXPECT_EQ(openEdges(mesh), 0U);
  EXPECT_EQ(badNormals(mesh), 0);
  // Euler: points - edges + faces = 2, with two edges for each quad.
  EXPECT_EQ(cage.points.size() + cage.quads.size(), 2 * cage.quads.size() + 2);
}

TEST(SceneKitSubdivision, AFlatGridStaysFlatWithItsCornersAndTexture) {
  std::vector<glm::dvec3> points;
  for (int row = 0; row <= 2; ++row)
    for (int column = 0; column <= 3; ++column) points.emplace_back(column, 0, row);
  const Cage grid = subdivided(makeGrid(2, 3, points));
  const Mesh mesh = meshOf(grid);
  EXPECT_EQ(badNormals(mesh), 0);
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    EXPECT_EQ(grid.points[i].y, 0);
    EXPECT_EQ(mesh.normals[i], glm::vec3(0, 1, 0));
    EXPECT_NEAR(mesh.tangents[i].x, 1, 1e-6);
    EXPECT_EQ(mesh.tangents[i].w, 1);
  }
  EXPECT_EQ(grid.points[0], glm::dvec3(0));
  EXPECT_EQ(grid.points[11], glm::dvec3(3, 0, 2));
}

TEST(SceneKitSubdivision, ABorderIsACubicSpline) {
  const Cage roof = makeGrid(1, 2, {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {0, 0, 1}, {1, 1, 1}, {2, 0, 1}});
  const Cage once = subdivided(roof);
  EXPECT_EQ(once.points[0], glm::dvec3(0));                                      // a corner of one quad stays
  EXPECT_NEAR(glm::distance(once.points[1], glm::dvec3(1, 0.75, 0)), 0, 1e-12);  // (1, 6, 1) / 8
}

ClothSpec fallingCloth() {
  ClothSpec spec;
  spec.center = {0, 0.12, 0};
  spec.size = 0.3;
  spec.turn = 0.4;
  spec.cells = 20;
  spec.distance = [](glm::dvec3 p) {
    return std::min(distanceToBox(p, {-0.05, 0, -0.05}, {0.05, 0.1, 0.05}, 0.01), p.y) - 1e-3;
  };
  return spec;
}

TEST(SceneKitCloth, HangsOverABoxWithoutStretchingOrEnteringIt) {
  const ClothSpec spec = fallingCloth();
  const Cage cloth = drapeCloth(spec);
  double highest = 0, lowest = 1, worst = 0;
  for (const glm::dvec3& p : cloth.points) {
    EXPECT_GT(spec.distance(p), -2e-3);
    highest = std::max(highest, p.y);
    lowest = std::min(lowest, p.y);
  }
  EXPECT_NEAR(highest, 0.101, 3e-3);  // on top of the box
  EXPECT_LT(lowest, 0.02);            // its corners reach the ground
  const double cell = spec.size / spec.cells;
  for (const auto& quad : cloth.quads) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double length = glm::distance(cloth.points[quad[k]], cloth.points[quad[(k + 1) % 4]]);
      worst = std::max(worst, std::abs(length / cell - 1));
    }
  }
  EXPECT_LT(worst, 0.15);
}

TEST(SceneKitCloth, FallsTheSameWayAgain) {
  const Cage first = drapeCloth(fallingCloth()), second = drapeCloth(fallingCloth());
  EXPECT_EQ(first.points, second.points);
}

TEST(SceneKitCloth, DistanceToABoxIsEuclidean) {
  const glm::dvec3 low(0), high(2, 4, 6);
  EXPECT_NEAR(distanceToBox({1, 5, 3}, low, high, 0.5), 1, 1e-12);
  EXPECT_NEAR(distanceToBox({1, 3, 3}, low, high, 0.5), -1, 1e-12);
  EXPECT_NEAR(distanceToBox({2, 4, 6}, low, high, 0.5), 0.5 * (std::sqrt(3.0) - 1), 1e-12);
}

}  // namespace
}  // namespace generator::test
