// Turns an array of triangle boxes into nodes: the recursion of the builder. Reads and reorders the boxes,
// writes the nodes in depth-first order and the triangle indices in leaf order.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bvh/bins.h"
#include "bvh/prim_ref.h"
#include "bvh/size_split.h"
#include "bvh/small_split.h"
#include "bvh/tri_tree.h"

namespace whittle {

/// A part of the tree that one task made. Node indices in it count from its own first node.
struct Subtree {
  std::vector<TreeNode> nodes;        ///< depth-first; never empty
  std::unique_ptr<Subtree> parts[2];  ///< where set, the child of nodes[0], which is alone then
  int depth = 0;                      ///< nodes on the longest path from the tree's root
};

/// The triangles of a subtree: a range of the array, their box, and the box of their centroid2.
struct BuildRange {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  Box4 box;
  Box4 centroids;

  std::uint32_t size() const { return end - begin; }
};

class TriTreeBuilder {
 public:
  /// `order` is as long as `refs`.
  TriTreeBuilder(std::span<PrimRef> refs, std::span<std::uint32_t> order, const BuildOptions& options);

  /// The tree over `all`, parallel where it is large.
  std::unique_ptr<Subtree> build(const BuildRange& all) const;

 private:
  struct Children {
    BuildRange range[2];
  };

  /// The subtree of a node at `depth` (root: 1) whose triangles are already divided among its children.
  std::unique_ptr<Subtree> buildParallel(const Children& children, int depth) const;
  /// The same on one thread, appended to `out`; the index of the node.
  std::int32_t buildSerial(const Children& children, int depth, Subtree& out) const;
  /// Splits `range`, the triangles of a node at `depth` (root: 1); false if it becomes a leaf.
  bool split(const BuildRange& range, int depth, Children& children) const;
  /// By area; false if no way is found or none is worth it. Small: at most kSmallRange triangles.
  bool splitSmall(const BuildRange& range, Children& children) const;
  bool splitLarge(const BuildRange& range, Children& children) const;
  bool mayBeLeaf(const BuildRange& range) const;
  bool worthSplitting(const BuildRange& range, const BinSplit& plane) const;
  void splitAtPlane(const BuildRange& range, const BinMap& map, const BinSplit& plane,
                    Children& children) const;
  void splitSorted(const BuildRange& range, const SmallSplit& split, Children& children) const;
  void splitBySize(const BuildRange& range, const SizeSplit& sizes, Children& children) const;
  void splitAtMedian(const BuildRange& range, Children& children) const;
  std::int32_t makeLeaf(const BuildRange& range) const;
  std::span<PrimRef> refs(const BuildRange& range) const { return refs_.subspan(range.begin, range.size()); }

  std::span<PrimRef> refs_;
  std::span<std::uint32_t> order_;
  BuildOptions options_;
};

}  // namespace whittle
