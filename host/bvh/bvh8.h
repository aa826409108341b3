// The eight-wide form of a TriTree, for searches that test one ray against eight
// boxes or eight triangles at once.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

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
  std::size_t leaves = 0;
  int depth = 0;  ///< nodes on the longest way down
};

/// Collapses `tree` so that the expected cost of a search (surface area heuristic) is least: which subtrees
/// become nodes of their own, which are handed up to their parent's free lanes, which become leaves (Ylitie,
/// Karras, Laine 2017). Opening the child of the largest box until there are eight instead leaves half of the
/// lanes empty. Parallel with TBB over the calling arena's threads; the result depends on the input alone.
Bvh8 buildBvh8(const TriTree& tree);

/// No tree, but its triangles in leaves of eight, for searches that go from one to the next: the nodes name
/// them in their order and have no boxes.
Bvh8 buildLeaves(const TriTree& tree);

/// Floats of the leaves' corners: nine for each triangle, and as many zeros, so that a lane beyond the last
/// leaf's count may be read, and a triangle that nothing hits.
inline std::size_t leafFloats(const TriTree& tree) { return 9 * tree.order.size() + 9; }

/// Corners, m, of a triangle of those that the tree was built of.
using CornersOf = std::function<std::array<glm::vec3, 3>(std::uint32_t triangle)>;
/// Receives floats [first, first + part.size()) of them.
using TakeLeafFloats = std::function<void(std::size_t first, std::span<const float> part)>;

/// Corners of the triangles, m, leaf by leaf as a struct of arrays: coordinate `axis` of corner k of triangle
/// first + lane is float 9 first + (3 k + axis) count + lane. They are made and handed over some at a time,
/// in their order: all of them are more than the tree. Parallel within a part.
void eachLeafPart(const Bvh8& wide, const TriTree& tree, const CornersOf& cornersOf,
                  const TakeLeafFloats& take);
/// The same floats, made in their places: `out` has leafFloats(tree).
void makeLeaves(const Bvh8& wide, const TriTree& tree, const CornersOf& cornersOf, std::span<float> out);
/// Where each triangle, in leaf order, lies in its leaf: lane | (count - 1) << 3. Parallel.
std::vector<std::uint8_t> leafPlaces(const Bvh8& wide, const TriTree& tree);

}  // namespace whittle
