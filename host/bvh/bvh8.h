// The eight-wide form of a TriTree, for searches that test one ray against eight
// boxes or eight triangles at once.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "bvh/tri_tree.h"
#include "bvh/uninitialized.h"

namespace whittle {

/// Eight children, boxes as a struct of arrays. A child >= 0 is a node, < 0 the leaf ~child = first << 3 |
/// count - 1: triangles order[first], order[first + 1], … of the TriTree, at most eight. Absent children have
/// an empty box (lo = +inf, hi = -inf).
struct Bvh8Node {
  float lo[3][8];
  float hi[3][8];
  std::int32_t child[8];
  std::int32_t pad[8];
};
static_assert(sizeof(Bvh8Node) == 256);

struct Bvh8 {
  UninitializedVector<Bvh8Node> nodes;  ///< nodes[0] is the root
  /// Corners of the triangles, m, leaf by leaf as a struct of arrays: coordinate `axis` of corner k of
  /// triangle first + lane is corners[9 first + (3 k + axis) count + lane]. Eight floats more at the end, so
  /// that a lane beyond the last leaf's count may be read.
  UninitializedVector<float> corners;
  std::size_t leaves = 0;
  int depth = 0;  ///< nodes on the longest way down
};

/// Collapses `tree` so that the expected cost of a search (surface area heuristic) is least: which subtrees
/// become nodes of their own, which are handed up to their parent's free lanes, which become leaves (Ylitie,
/// Karras, Laine 2017). Opening the child of the largest box until there are eight instead leaves half of the
/// lanes empty. Parallel with TBB over the calling arena's threads; the result depends on the input alone.
Bvh8 buildBvh8(const TriTree& tree, std::span<const glm::vec3> positions,
               std::span<const glm::uvec3> triangles);

}  // namespace whittle
