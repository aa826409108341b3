// What stands between a point and a light is named.
#include "reference/blockers.h"

#include <gtest/gtest.h>

#include "support/probe.h"

namespace whittle::test {
namespace {

/// From the origin straight up to a light at a height of 2, past sheets at these heights.
ShadowRecord blockedBy(const std::vector<std::pair<float, Material>>& sheets, double arrives = 0) {
  Scene scene;
  for (const auto& [height, material] : sheets) addFloor(scene, material, height, true, 5);
  RayTree tree;
  tree.rays.emplace_back();
  tree.rays[0].shadows.push_back(
      {0, {0.1, 0, 0.2}, {0, 1, 0}, 2, glm::dvec3(1), glm::dvec3(arrives), std::nullopt});
  findBlockers(scene, tree);
  ShadowRecord shadow = tree.rays[0].shadows[0];
  // In the place of the triangle its sheet's number.
  if (shadow.blocker) shadow.blocker->primitive = scene.triangles[shadow.blocker->primitive].material;
  return shadow;
}

Material clear() {
  Material m = glass(1.5F, false);
  m.transmission = 1;
  return m;
}

TEST(Blockers, TheNearestThatLetsNothingThroughIsNamed) {
  const Material wall = lambert(glm::vec3(0.5F));
  const auto found = blockedBy({{1.5F, wall}, {0.5F, clear()}, {1.0F, wall}, {3.0F, wall}}).blocker;
  ASSERT_TRUE(found);
  EXPECT_EQ(found->primitive, 2U);
  EXPECT_NEAR(found->distance, 1.0, 1e-6) << "heights are single precision";
}

TEST(Blockers, NothingIsNamedWhereLightArrivesOrNothingIsDark) {
  const Material wall = lambert(glm::vec3(0.5F));
  EXPECT_FALSE(blockedBy({{1.0F, wall}}, 0.5).blocker) << "some arrives";
  EXPECT_FALSE(blockedBy({{1.0F, clear()}}).blocker) << "glass alone";
  EXPECT_FALSE(blockedBy({{2.5F, wall}}).blocker) << "behind the light";
  EXPECT_FALSE(blockedBy({}).blocker);
}

}  // namespace
}  // namespace whittle::test
