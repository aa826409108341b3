// Terrain and plants.
#include "scenes/surface_checks.h"
#include "shapes/plants.h"
#include "shapes/terrain.h"

namespace generator::test {
namespace {

TerrainSpec smallLand(int droplets) {
  return {.squares = 64, .side = 100, .relief = 20, .droplets = droplets};
}

double meanHeight(const Terrain& land) {
  double sum = 0;
  for (int i = 0; i < 65 * 65; ++i)
    sum += land.heightAt(100.0 * (i % 65) / 64 - 50, 100.0 * (i / 65) / 64 - 50);
  return sum / (65 * 65);
}

TEST(SceneKitTerrain, RainCarriesEarthDownhill) {
  const Terrain dry(smallLand(0)), wet(smallLand(4000));
  // Of all heights: earth moves from high to low, so that their product with the change is negative; some
  // leaves.
  double moved = 0, downhill = 0;
  const double mean = meanHeight(dry);
  for (int i = 0; i < 65 * 65; ++i) {
    const double x = 100.0 * (i % 65) / 64 - 50, z = 100.0 * (i / 65) / 64 - 50;
    const double change = wet.heightAt(x, z) - dry.heightAt(x, z);
    moved += std::abs(change);
    downhill += change * (dry.heightAt(x, z) - mean);
  }
  EXPECT_GT(moved, 65 * 65 * 0.02);
  EXPECT_LT(downhill, 0);
  EXPECT_LE(meanHeight(wet), mean + 1e-9);
  EXPECT_NEAR(meanHeight(wet), mean, 0.05 * smallLand(0).relief);
}

TEST(SceneKitTerrain, IsTheSameAgainAndHasItsTriangles) {
  const TerrainSpec spec = smallLand(2000);
  const Mesh first = meshOf(Terrain(spec), spec), second = meshOf(Terrain(spec), spec);
  EXPECT_EQ(first.positions, second.positions);
  EXPECT_EQ(first.indices.size(), 3U * 2 * 64 * 64);
  EXPECT_EQ(openEdges(first), 4U * 64);  // its border
  for (const glm::vec3& n : first.normals) EXPECT_GT(n.y, 0);
}

TEST(SceneKitPlants, ATreeStandsOnTheGroundAndForks) {
  const TreeSpec spec{.height = 7, .trunkRadius = 0.2, .levels = 3, .children = 4, .series = 1};
  const Tree tree = growTree(spec);
  EXPECT_EQ(openEdges(tree.wood), 0U);  // each branch is a closed body
  // A trunk, and four branches and a tip from each of trunk and branches.
  const std::size_t twigs = 5 * 5, leaves = twigs * 6 * 4;  // six pieces of a twig, a spray on each
  EXPECT_EQ(tree.leaves.indices.size() / 3, 4 * leaves);
  double highest = 0, lowest = 0;
  for (const glm::vec3& p : tree.wood.positions) {
    highest = std::max(highest, static_cast<double>(p.y));
    lowest = std::min(lowest, static_cast<double>(p.y));
  }
  EXPECT_NEAR(highest, spec.height, 0.35 * spec.height);
  EXPECT_GT(lowest, -0.05 * spec.height);
  EXPECT_EQ(growTree(spec).wood.positions, tree.wood.positions);
}

TEST(SceneKitPlants, ATuftHasThreeTrianglesForEachBlade) {
  const Mesh tuft = makeTuft(20, 0.4, 0.2, 3);
  EXPECT_EQ(tuft.indices.size(), 20U * 9);
  for (const glm::vec3& p : tuft.positions) EXPECT_LE(p.y, 0.4F);
}

}  // namespace
}  // namespace generator::test
