// Figures about a finished tree for reports: expected cost, sizes of leaves, memory.
#pragma once

#include <array>
#include <cstddef>

#include "bvh/tri_tree.h"

namespace whittle {

struct TreeStats {
  /// Expected cost of a random ray that hits the root's box, in triangle tests (MacDonald & Booth 1990): each
  /// node costs `traversalCost`, each leaf its triangles, weighted with the area of its box over the root's.
  double sahCost = 0;
  std::size_t leaves = 0;
  std::size_t triangles = 0;
  std::array<std::size_t, 17> leavesOfSize{};  ///< index: triangles in the leaf
  int depth = 0;                               ///< nodes on the longest path, counted here
  std::size_t nodeBytes = 0;
  std::size_t orderBytes = 0;
};

TreeStats treeStats(const TriTree& tree, float traversalCost = 1.0F);

}  // namespace whittle
