// The eight-wide form of a TriTree, for searches that test one ray against eight boxes or eight triangles at
// once.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "bvh/tri_tree.h"

namespace whittle {

/// Eight children, boxes as a struct of arrays. A child >= 0 is a node, < 0 the block ~child. Absent children
/// have an empty box (lo = +inf, hi = -inf).
struct WideNode {
  float lo[3][8];
  float hi[3][8];
  std::int32_t child[8];
  std::int32_t pad[8];
};
static_assert(sizeof(WideNode) == 256);

/// Up to eight triangles that are neighbours in TriTree::order: order[first], order[first + 1], … Absent
/// lanes are NaN, which no test takes for a hit.
struct TriangleBlock {
  float v[3][3][8];            ///< [corner][axis][lane], metres
  std::uint32_t primitive[8];  ///< index in the scene
  std::uint32_t first;
  std::uint32_t count;
  std::uint32_t pad[6];
};
static_assert(sizeof(TriangleBlock) == 352);

struct WideTree {
  std::vector<WideNode> nodes;  ///< nodes[0] is the root
  std::vector<TriangleBlock> blocks;
  int stack = 0;  ///< entries that a search may have waiting: the most children left over on any way down
};

/// Collapses `tree` so that the expected cost of a search (surface area heuristic) is least: which subtrees
/// become nodes of their own, which are handed up to their parent's free lanes, which become blocks (Ylitie,
/// Karras, Laine 2017). Opening the child of the largest box until there are eight instead leaves half of the
/// lanes empty.
WideTree buildWideTree(const TriTree& tree, std::span<const glm::vec3> positions,
                       std::span<const glm::uvec3> triangles);

}  // namespace whittle
