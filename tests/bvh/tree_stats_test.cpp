// treeStats on trees small enough to count by hand.
#include "bvh/tree_stats.h"

#include <gtest/gtest.h>

#include "bvh/tree_check.h"

namespace whittle::test {
namespace {

/// A leaf of `count` triangles from `first`.
std::int32_t leaf(std::uint32_t first, std::uint32_t count) {
  return static_cast<std::int32_t>(~(first << 4 | (count - 1)));
}

void setBox(TreeNode& node, int k, glm::vec3 lo, glm::vec3 hi) {
  for (int axis = 0; axis < 3; ++axis) {
    node.lo[k][axis] = lo[axis];
    node.hi[k][axis] = hi[axis];
  }
}

TEST(TreeStats, CountsByHand) {
  // The root's box is [0,4]×[0,1]×[0,1], half area 9. Child 0: [0,1]³, half area 3, a leaf of 2.
  // Child 1: [2,4]×[0,1]×[0,1], half area 5, a node of two unit cubes with 1 and 3 triangles.
  TriTree tree;
  tree.nodes.resize(2);
  setBox(tree.nodes[0], 0, {0, 0, 0}, {1, 1, 1});
  setBox(tree.nodes[0], 1, {2, 0, 0}, {4, 1, 1});
  tree.nodes[0].child[0] = leaf(0, 2);
  tree.nodes[0].child[1] = 1;
  setBox(tree.nodes[1], 0, {2, 0, 0}, {3, 1, 1});
  setBox(tree.nodes[1], 1, {3, 0, 0}, {4, 1, 1});
  tree.nodes[1].child[0] = leaf(2, 1);
  tree.nodes[1].child[1] = leaf(3, 3);
  tree.order = {0, 1, 2, 3, 4, 5};
  const TreeStats stats = treeStats(tree);
  EXPECT_DOUBLE_EQ(stats.sahCost, (9 + 3 * 2 + 5 + 3 * 1 + 3 * 3) / 9.0);
  EXPECT_DOUBLE_EQ(treeStats(tree, 3).sahCost, (9 * 3 + 3 * 2 + 5 * 3 + 3 * 1 + 3 * 3) / 9.0);
  EXPECT_EQ(stats.leaves, 3U);
  EXPECT_EQ(stats.triangles, 6U);
  EXPECT_EQ(stats.leavesOfSize[1], 1U);
  EXPECT_EQ(stats.leavesOfSize[2], 1U);
  EXPECT_EQ(stats.leavesOfSize[3], 1U);
  EXPECT_EQ(stats.depth, 2);
  EXPECT_EQ(stats.nodeBytes, 128U);
  EXPECT_EQ(stats.orderBytes, 24U);
}

TEST(TreeStats, TreesOfNoneAndOne) {
  const TreeStats none = treeStats(buildTriTree({}, {}));
  EXPECT_EQ(none.sahCost, 0);
  EXPECT_EQ(none.leaves, 0U);
  EXPECT_EQ(none.depth, 1);
  const TreeStats one = treeStats(build(randomSoup(1, 0.5F, 40)));
  EXPECT_EQ(one.leaves, 1U);
  EXPECT_DOUBLE_EQ(one.sahCost, 2);  // the root, then one triangle in a box as large as the root's
}

}  // namespace
}  // namespace whittle::test
