// See wide_tree.h.
#include "bvh/wide_tree.h"

#include <algorithm>
#include <array>
#include <limits>

namespace whittle {
namespace {

constexpr std::uint32_t kLanes = 8;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// What visiting a node and testing a leaf cost, in visits; measured on one core with 8-lane vectors.
constexpr float kNodeCost = 1.0F, kLeafCost = 1.5F;

/// A subtree of the two-wide tree: its box and its run of TriTree::order.
struct Subtree {
  std::int32_t child = -1;  ///< as in TreeNode
  float lo[3] = {}, hi[3] = {};
  std::uint32_t first = 0, count = 0;

  bool isLeaf() const { return child < 0; }
  float area() const {
    const float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
    return x * y + y * z + z * x;
  }
};

/// The cheapest way to hand a subtree to its wide parent as at most 1, 2, … 8 children (entries 0 … 7), and
/// how many of them go to the left; 0: as few as the entry before. Entry 0 is the subtree as one child.
struct Plan {
  std::array<float, kLanes> cost;
  std::array<std::uint8_t, kLanes> left;
  bool endsHere;                ///< as one child it is a leaf, not a node
  std::uint8_t total, toLeft;  ///< as a node: its children, and how many come from the left
};

class Collapse {
 public:
  Collapse(const TriTree& tree, std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles)
      : tree_(tree),
        positions_(positions),
        triangles_(triangles),
        subtrees_(tree.nodes.size()),
        plans_(tree.nodes.size()) {
    // Children come after their parents: the last node can be planned first.
    for (std::size_t n = tree.nodes.size(); n-- > 0;) planNode(n);
  }

  WideTree run() {
    out_.corners.resize(tree_.order.size() * 9 + kLanes);
    out_.nodes.emplace_back();
    std::vector<Pending> pending{{0, 0, 0, 1}};
    while (!pending.empty()) {
      const Pending p = pending.back();
      pending.pop_back();
      fill(p, pending);
    }
    return std::move(out_);
  }

 private:
  struct Pending {
    std::int32_t from;  ///< node of the two-wide tree
    std::size_t to;     ///< node of the wide tree
    int waiting;        ///< entries on a search's stack on the way here
    int depth;          ///< nodes on the way here, this one among them
  };

  bool isThere(const TreeNode& node, int c) const { return node.lo[c][0] <= node.hi[c][0]; }

  Subtree childOf(std::size_t n, int c) const {
    const TreeNode& node = tree_.nodes[n];
    Subtree s;
    s.child = node.child[c];
    std::copy_n(node.lo[c], 3, s.lo);
    std::copy_n(node.hi[c], 3, s.hi);
    if (s.isLeaf()) {
      const auto packed = static_cast<std::uint32_t>(~s.child);
      s.first = packed >> 4U;
      s.count = (packed & 15U) + 1;
    } else {
      s.first = subtrees_[static_cast<std::size_t>(s.child)].first;
      s.count = subtrees_[static_cast<std::size_t>(s.child)].count;
    }
    return s;
  }

  Plan planOf(const Subtree& s) const {
    if (!s.isLeaf()) return plans_[static_cast<std::size_t>(s.child)];
    Plan plan{};
    plan.endsHere = true;
    plan.cost.fill(s.area() * kLeafCost * static_cast<float>((s.count + kLanes - 1) / kLanes));
    return plan;
  }

  /// Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", 2017,
  /// section 3.
  void planNode(std::size_t n) {
    const TreeNode& node = tree_.nodes[n];
    Subtree& s = subtrees_[n];
    s.child = static_cast<std::int32_t>(n);
    std::fill_n(s.lo, 3, kInfinity);
    std::fill_n(s.hi, 3, -kInfinity);
    Plan sides[2];
    for (int c = 0; c < 2; ++c) {
      if (!isThere(node, c)) {
        sides[c].cost.fill(0);
        continue;
      }
      const Subtree side = childOf(n, c);
      s.first = s.count == 0 ? side.first : std::min(s.first, side.first);
      s.count += side.count;
      for (int a = 0; a < 3; ++a) {
        s.lo[a] = std::min(s.lo[a], side.lo[a]);
        s.hi[a] = std::max(s.hi[a], side.hi[a]);
      }
      sides[c] = planOf(side);
    }
    Plan& plan = plans_[n];
    // As many children as the entry allows, shared between the two sides.
    for (std::uint32_t total = 2; total <= kLanes; ++total) {
      plan.cost[total - 1] = kInfinity;
      for (std::uint32_t left = 1; left < total; ++left) {
        const float cost = sides[0].cost[left - 1] + sides[1].cost[total - left - 1];
        if (cost < plan.cost[total - 1]) {
          plan.cost[total - 1] = cost;
          plan.left[total - 1] = static_cast<std::uint8_t>(left);
        }
      }
    }
    const auto best = std::min_element(plan.cost.begin() + 1, plan.cost.end());
    plan.total = static_cast<std::uint8_t>(best - plan.cost.begin() + 1);
    plan.toLeft = plan.left[plan.total - 1U];
    const float area = s.count > 0 ? s.area() : 0;
    const float asNode = area * kNodeCost + *best;
    const float asLeaf = s.count <= kLanes ? area * kLeafCost : kInfinity;
    plan.endsHere = asLeaf <= asNode;
    plan.cost[0] = std::min(asLeaf, asNode);
    for (std::uint32_t i = 1; i < kLanes; ++i) {
      if (plan.cost[i] < plan.cost[i - 1]) continue;
      plan.cost[i] = plan.cost[i - 1];
      plan.left[i] = 0;
    }
  }

  /// Appends the children that the plan gives `s` when it may have at most `most`.
  void handOver(const Subtree& s, std::uint32_t most, std::vector<Subtree>& out) const {
    const Plan plan = planOf(s);
    std::uint32_t i = most - 1;
    while (i > 0 && plan.left[i] == 0) --i;
    if (i == 0 || s.isLeaf()) {
      out.push_back(s);
      return;
    }
    shareOut(static_cast<std::size_t>(s.child), i + 1, plan.left[i], out);
  }

  void shareOut(std::size_t n, std::uint32_t total, std::uint32_t left, std::vector<Subtree>& out) const {
    if (isThere(tree_.nodes[n], 0)) handOver(childOf(n, 0), left, out);
    if (isThere(tree_.nodes[n], 1)) handOver(childOf(n, 1), total - left, out);
  }

  bool becomesLeaf(const Subtree& s) const { return s.isLeaf() || planOf(s).endsHere; }

  void fill(const Pending& p, std::vector<Pending>& pending) {
    std::vector<Subtree> children;
    const auto n = static_cast<std::size_t>(p.from);
    shareOut(n, plans_[n].total, plans_[n].toLeft, children);
    splitLongLeaves(children);
    // A shadow ray visits them in this order: what it is most likely to meet comes first.
    std::stable_sort(children.begin(), children.end(),
                     [](const Subtree& a, const Subtree& b) { return a.area() > b.area(); });
    const int waiting = p.waiting + static_cast<int>(children.size()) - 1;
    out_.stack = std::max(out_.stack, waiting);
    out_.depth = std::max(out_.depth, p.depth);
    for (std::uint32_t k = 0; k < kLanes; ++k)
      setChild(p.to, k, k < children.size() ? &children[k] : nullptr, waiting, p.depth, pending);
  }

  /// A leaf of more than a block becomes two children of the same box where there is room, else a node of its
  /// own.
  void splitLongLeaves(std::vector<Subtree>& children) const {
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (!children[i].isLeaf() || children[i].count <= kLanes || children.size() == kLanes) continue;
      Subtree rest = children[i];
      rest.first += kLanes;
      rest.count -= kLanes;
      children[i].count = kLanes;
      children.push_back(rest);
    }
  }

  void setChild(std::size_t node, std::uint32_t k, const Subtree* child, int waiting, int depth,
                std::vector<Pending>& pending) {
    for (int a = 0; a < 3; ++a) {
      out_.nodes[node].lo[a][k] = child ? child->lo[a] : kInfinity;
      out_.nodes[node].hi[a][k] = child ? child->hi[a] : -kInfinity;
    }
    if (!child) return;
    if (!becomesLeaf(*child)) {
      out_.nodes[node].child[k] = static_cast<std::int32_t>(out_.nodes.size());
      pending.push_back({child->child, out_.nodes.size(), waiting, depth + 1});
      out_.nodes.emplace_back();
    } else if (child->count <= kLanes) {
      out_.nodes[node].child[k] = addLeaf(child->first, child->count);
    } else {
      // Room for none: a node of two leaves of the same box.
      const auto own = out_.nodes.size();
      out_.nodes[node].child[k] = static_cast<std::int32_t>(own);
      out_.nodes.emplace_back();
      Subtree parts[2] = {*child, *child};
      parts[0].count = kLanes;
      parts[1].first += kLanes;
      parts[1].count -= kLanes;
      out_.stack = std::max(out_.stack, waiting + 1);
      out_.depth = std::max(out_.depth, depth + 1);
      for (std::uint32_t lane = 0; lane < kLanes; ++lane)
        setChild(own, lane, lane < 2 ? &parts[lane] : nullptr, waiting + 1, depth + 1, pending);
    }
  }

  std::int32_t addLeaf(std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      const glm::uvec3& t = triangles_[tree_.order[first + lane]];
      for (std::uint32_t k = 0; k < 3; ++k)
        for (std::uint32_t a = 0; a < 3; ++a)
          out_.corners[std::size_t{9} * first + std::size_t{3 * k + a} * count + lane] =
              positions_[t[static_cast<int>(k)]][static_cast<int>(a)];
    }
    ++out_.leaves;
    return ~static_cast<std::int32_t>(first << 3U | (count - 1));
  }

  const TriTree& tree_;
  std::span<const glm::vec3> positions_;
  std::span<const glm::uvec3> triangles_;
  std::vector<Subtree> subtrees_;  ///< by node of the two-wide tree
  std::vector<Plan> plans_;
  WideTree out_;
};

}  // namespace

WideTree buildWideTree(const TriTree& tree, std::span<const glm::vec3> positions,
                       std::span<const glm::uvec3> triangles) {
  return Collapse(tree, positions, triangles).run();
}

}  // namespace whittle
