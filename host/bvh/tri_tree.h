// A bounding volume hierarchy over triangles: the data. Built by buildTriTree, traced by kernels/ and by
// tests. Knows neither OpenCL nor glTF.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "bvh/uninitialized.h"

namespace whittle {

/// A node with two children, boxes stored in the parent so that one 64-byte line decides both. A child
/// that is not negative is the index of a node. A negative one is a leaf: ~child packs (first << 4 |
/// count - 1) into TriTree::order, count in 1..16. An absent child (trees of 0 or 1 leaves) has an
/// empty box (lo = +inf, hi = -inf) and child = -1.
struct TreeNode {
  float lo[2][3];  ///< child boxes, world space, metres; already outer bounds of the float vertices
  float hi[2][3];
  std::int32_t child[2];
  std::int32_t pad[2];
};
static_assert(sizeof(TreeNode) == 64);

struct TriTree {
  UninitializedVector<TreeNode> nodes;  ///< depth-first from the root; at least one node
  std::vector<std::uint32_t> order;     ///< triangle indices in leaf order; degenerate triangles left out
  int depth = 0;                        ///< nodes on the longest path, root = 1; never above kMaxTreeDepth
};

/// Traversal stacks are this deep. The builder falls back to median splits so that it holds for any input.
inline constexpr int kMaxTreeDepth = 60;

struct BuildOptions {
  int maxLeafTriangles = 4;    ///< at most 16
  int bins = 64;               ///< at most 64; fewer where there are few triangles
  float traversalCost = 1.0F;  ///< relative to the cost of one triangle test
};

/// Binned-SAH build (Wald 2007) with splits by size where planes help little, parallel with TBB over the
/// calling arena's threads. The result depends on the input alone, never on the number of threads.
/// `triangles` are corner indices into `positions`, three each. Triangles with a non-finite corner are left
/// out. Leaves up to 2^27 triangles.
TriTree buildTriTree(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                     const BuildOptions& options = {});

}  // namespace whittle
