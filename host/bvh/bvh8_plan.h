// What it costs to hand each subtree of a two-wide tree to an eight-wide parent: the dynamic programme of
// Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", 2017,
// section 3. Reads a TriTree; one Plan for each of its nodes.
#pragma once

#include <cstdint>
#include <limits>

#include "bvh/tri_tree.h"
#include "bvh/uninitialized.h"

namespace whittle {

inline constexpr std::uint32_t kLanes = 8;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr std::int32_t kBvh8Task = 4096;  ///< two-wide nodes of a subtree that is worth a task

/// A subtree of the two-wide tree: child `side` of node `parent`.
struct SubtreeRef {
  std::int32_t parent;
  std::int32_t side;
  std::int32_t child;          ///< as in TreeNode
  std::int32_t end;            ///< of the subtree's run of nodes, which begins at `child`; if it is no leaf
  std::uint32_t first, count;  ///< its run of TriTree::order

  bool isLeaf() const { return child < 0; }
};

/// Which subtrees become the children of a wide node.
struct Bvh8Children {
  SubtreeRef child[kLanes];
  std::uint32_t count = 0;

  void add(const SubtreeRef& s) { child[count++] = s; }
};

class Bvh8Plan {
 public:
  explicit Bvh8Plan(const TriTree& tree);

  /// The children of a wide node in place of node n, whose subtree ends before `end`.
  Bvh8Children childrenOf(std::int32_t n, std::int32_t end) const;
  /// It is handed to its parent as one leaf.
  bool becomesLeaf(const SubtreeRef& s) const {
    return s.isLeaf() || plans_[static_cast<std::size_t>(s.child)].endsHere;
  }
  /// Half area of the box of a child, relative to the whole tree's: neither overflows nor vanishes.
  float area(const TreeNode& node, int side) const { return area(node.lo[side], node.hi[side]); }

 private:
  using Costs = float[kLanes];

  /// Entry i: the least cost of the subtree as at most i + 1 children. Never rises.
  struct Plan {
    Costs cost;
    std::uint32_t first, count;  ///< its run of TriTree::order
    bool endsHere;               ///< as one child it is a leaf, not a node
  };

  void planSubtree(std::int32_t n, std::int32_t end);
  void planNode(std::int32_t n);
  /// Those of a child; `leafCosts` is where a leaf's are put.
  const float* costsOf(std::int32_t n, int side, Costs& leafCosts) const;
  std::int32_t endOf(std::int32_t n, int side, std::int32_t end) const;
  SubtreeRef child(std::int32_t n, int side, std::int32_t end) const;
  void shareOut(std::int32_t n, std::int32_t end, std::uint32_t most, Bvh8Children& out) const;
  void handOver(const SubtreeRef& s, std::uint32_t most, Bvh8Children& out) const;
  float area(const float (&lo)[3], const float (&hi)[3]) const {
    // Halves: the difference of two floats may overflow.
    const float x = (0.5F * hi[0] - 0.5F * lo[0]) * scale_;
    const float y = (0.5F * hi[1] - 0.5F * lo[1]) * scale_;
    const float z = (0.5F * hi[2] - 0.5F * lo[2]) * scale_;
    return x * y + y * z + z * x;
  }

  const TreeNode* nodes_;
  UninitializedVector<Plan> plans_;  ///< by node of the two-wide tree
  float scale_ = 0;                  ///< a power of two: twice the inverse of the tree's longest edge or more
};

}  // namespace whittle
