// Walks a TriTree once and adds up.
#include "bvh/tree_stats.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace whittle {

namespace {

/// Half the area of the box of child k, m²; 0 for the empty box of an absent child.
double childHalfArea(const TreeNode& node, int k) {
  double d[3];
  for (int axis = 0; axis < 3; ++axis) {
    d[axis] = static_cast<double>(node.hi[k][axis]) - static_cast<double>(node.lo[k][axis]);
    if (d[axis] < 0) return 0;
  }
  return d[0] * (d[1] + d[2]) + d[1] * d[2];
}

bool absent(const TreeNode& node, int k) { return node.hi[k][0] < node.lo[k][0]; }

double rootHalfArea(const TreeNode& root) {
  TreeNode both = root;
  for (int axis = 0; axis < 3; ++axis) {
    both.lo[0][axis] = std::min(root.lo[0][axis], root.lo[1][axis]);
    both.hi[0][axis] = std::max(root.hi[0][axis], root.hi[1][axis]);
  }
  return childHalfArea(both, 0);
}

}  // namespace

TreeStats treeStats(const TriTree& tree, float traversalCost) {
  TreeStats stats;
  stats.nodeBytes = tree.nodes.size() * sizeof(TreeNode);
  stats.orderBytes = tree.order.size() * sizeof(std::uint32_t);
  if (tree.nodes.empty()) return stats;
  const double whole = rootHalfArea(tree.nodes[0]);
  double cost = whole * traversalCost;
  std::vector<std::pair<std::int32_t, int>> stack{{0, 1}};  // node, its depth
  while (!stack.empty()) {
    const auto [index, depth] = stack.back();
    stack.pop_back();
    stats.depth = std::max(stats.depth, depth);
    const TreeNode& node = tree.nodes[static_cast<std::size_t>(index)];
    for (int k = 0; k < 2; ++k) {
      if (absent(node, k)) continue;
      if (node.child[k] >= 0) {
        cost += childHalfArea(node, k) * traversalCost;
        stack.emplace_back(node.child[k], depth + 1);
        continue;
      }
      const std::size_t count = (static_cast<std::uint32_t>(~node.child[k]) & 15U) + 1;
      cost += childHalfArea(node, k) * static_cast<double>(count);
      ++stats.leaves;
      ++stats.leavesOfSize[count];
      stats.triangles += count;
    }
  }
  stats.sahCost = whole > 0 ? cost / whole : 0;
  return stats;
}

}  // namespace whittle
