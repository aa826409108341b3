// Which subtrees become nodes of the eight-wide tree. Bottom-up in parallel: a subtree is a run of
// nodes, children after their parents.
#include "bvh/bvh8_plan.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bvh/prim_ref.h"

namespace whittle {
namespace {

/// What visiting a node and testing a leaf cost, in visits; measured on one core with 8-lane vectors.
constexpr float kNodeCost = 1.0F, kLeafCost = 1.5F;

bool isThere(const TreeNode& node, int side) { return node.lo[side][0] <= node.hi[side][0]; }

std::uint32_t leafCount(std::int32_t leaf) { return (static_cast<std::uint32_t>(~leaf) & 15U) + 1; }
std::uint32_t leafFirst(std::int32_t leaf) { return static_cast<std::uint32_t>(~leaf) >> 4U; }

/// Twice the inverse of the longest edge, rounded to a power of two: relative areas are those of the boxes,
/// to the last bit.
float edgeScale(const TreeNode& root) {
  double longest = 0;
  for (int a = 0; a < 3; ++a) {
    const double lo = std::min(root.lo[0][a], root.lo[1][a]), hi = std::max(root.hi[0][a], root.hi[1][a]);
    longest = std::max(longest, hi - lo);
  }
  return longest > 0 ? std::ldexp(1.0F, std::clamp(1 - std::ilogb(longest), -126, 126)) : 0;
}

Float4 load4(const float* p) {
  Float4 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

/// Entry i: the least cost of i + 1 children shared between two sides; entry 0 is infinite. At most
/// `mostLeft` of them are on the left: a leaf costs the same as more than one child.
void combine(const float* left, const float* right, float (&cost)[kLanes],
             std::uint32_t mostLeft = kLanes - 1) {
  // Infinities in front of the right side: for each number of children on the left one sum of whole vectors.
  float padded[2 * kLanes];
  std::fill_n(padded, kLanes, kInfinity);
  std::copy_n(right, kLanes, padded + kLanes);
  Float4 few = splat4(kInfinity), many = few;
  for (std::uint32_t l = 1; l <= mostLeft; ++l) {
    const Float4 onLeft = splat4(left[l - 1]);
    few = min4(onLeft + load4(padded + kLanes - l), few);
    many = min4(onLeft + load4(padded + kLanes - l + 4), many);
  }
  std::memcpy(cost, &few, sizeof few);
  std::memcpy(cost + 4, &many, sizeof many);
}

}  // namespace

Bvh8Plan::Bvh8Plan(const TriTree& tree)
    : nodes_(tree.nodes.data()), plans_(tree.nodes.size()), scale_(edgeScale(tree.nodes[0])) {
  planSubtree(0, static_cast<std::int32_t>(tree.nodes.size()));
}

void Bvh8Plan::planSubtree(std::int32_t n, std::int32_t end) {
  if (end - n < kBvh8Task) {
    for (std::int32_t i = end; i-- > n;) planNode(i);
    return;
  }
  const auto side = [&](int k) {
    const std::int32_t c = nodes_[n].child[k];
    if (c >= 0) planSubtree(c, endOf(n, k, end));
  };
  tbb::parallel_invoke([&] { side(0); }, [&] { side(1); });
  planNode(n);
}

/// Depth-first: one side's nodes end where the other's begin.
std::int32_t Bvh8Plan::endOf(std::int32_t n, int side, std::int32_t end) const {
  return side == 0 && nodes_[n].child[1] >= 0 ? nodes_[n].child[1] : end;
}

SubtreeRef Bvh8Plan::child(std::int32_t n, int side, std::int32_t end) const {
  const TreeNode& node = nodes_[n];
  SubtreeRef s{n, side, node.child[side], end, 0, 0};
  if (s.isLeaf()) {
    s.first = leafFirst(s.child);
    s.count = leafCount(s.child);
    return s;
  }
  s.end = endOf(n, side, end);
  s.first = plans_[static_cast<std::size_t>(s.child)].first;
  s.count = plans_[static_cast<std::size_t>(s.child)].count;
  return s;
}

const float* Bvh8Plan::costsOf(std::int32_t n, int side, Costs& leafCosts) const {
  const TreeNode& node = nodes_[n];
  const std::int32_t c = node.child[side];
  if (c >= 0) return plans_[static_cast<std::size_t>(c)].cost;
  float cost = 0;
  if (isThere(node, side)) cost = area(node, side) * kLeafCost * (leafCount(c) > kLanes ? 2.0F : 1.0F);
  std::fill_n(leafCosts, kLanes, cost);
  return leafCosts;
}

void Bvh8Plan::planNode(std::int32_t n) {
  const TreeNode& node = nodes_[n];
  Plan& plan = plans_[static_cast<std::size_t>(n)];
  plan.first = std::numeric_limits<std::uint32_t>::max();
  plan.count = 0;
  for (int k = 0; k < 2; ++k) {
    if (!isThere(node, k)) continue;
    const SubtreeRef s = child(n, k, 0);
    plan.first = std::min(plan.first, s.first);
    plan.count += s.count;
  }
  float lo[3], hi[3];
  for (int a = 0; a < 3; ++a) {
    lo[a] = std::min(node.lo[0][a], node.lo[1][a]);
    hi[a] = std::max(node.hi[0][a], node.hi[1][a]);
  }
  const int leaf = node.child[0] < 0 ? 0 : 1;
  Costs leaves[2];
  combine(costsOf(n, leaf, leaves[0]), costsOf(n, 1 - leaf, leaves[1]), plan.cost,
          node.child[leaf] < 0 ? 1 : kLanes - 1);
  // More children never cost more, so the last entry is the least.
  const float whole = plan.count > 0 ? area(lo, hi) : 0;
  const float asNode = whole * kNodeCost + plan.cost[kLanes - 1];
  const float asLeaf = plan.count <= kLanes ? whole * kLeafCost : kInfinity;
  plan.endsHere = asLeaf <= asNode;
  const float asOne = std::min(asLeaf, asNode);
  for (float& cost : plan.cost) cost = std::min(cost, asOne);
}

Bvh8Children Bvh8Plan::childrenOf(std::int32_t n, std::int32_t end) const {
  Bvh8Children children;
  shareOut(n, end, kLanes, children);
  return children;
}

/// Adds the children of a node that may have at most `most`, two or more; of
/// equal ways the one of the fewest.
void Bvh8Plan::shareOut(std::int32_t n, std::int32_t end, std::uint32_t most, Bvh8Children& out) const {
  Costs leaves[2], cost;
  const float* left = costsOf(n, 0, leaves[0]);
  const float* right = costsOf(n, 1, leaves[1]);
  combine(left, right, cost);
  const auto total = static_cast<std::uint32_t>(std::min_element(cost + 1, cost + most) - cost) + 1;
  std::uint32_t toLeft = 1;
  while (toLeft + 1 < total && left[toLeft - 1] + right[total - toLeft - 1] > cost[total - 1]) ++toLeft;
  if (isThere(nodes_[n], 0)) handOver(child(n, 0, end), toLeft, out);
  if (isThere(nodes_[n], 1)) handOver(child(n, 1, end), total - toLeft, out);
}

/// Adds `s` as at most `most` children.
void Bvh8Plan::handOver(const SubtreeRef& s, std::uint32_t most, Bvh8Children& out) const {
  const float* cost = s.isLeaf() ? nullptr : plans_[static_cast<std::size_t>(s.child)].cost;
  if (s.isLeaf() || cost[most - 1] == cost[0]) {
    out.add(s);
  } else {
    shareOut(s.child, s.end, most, out);
  }
}

}  // namespace whittle
