// See wide_tree.h.
#include "bvh/wide_tree.h"

#include <algorithm>
#include <limits>

namespace whittle {
namespace {

constexpr std::uint32_t kLanes = 8;

/// A subtree of the two-wide tree: its box and its run of TriTree::order.
struct Subtree {
  std::int32_t child;  ///< as in TreeNode
  float lo[3], hi[3];
  std::uint32_t first, count;

  bool isLeaf() const { return child < 0; }
  float area() const {
    const float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
    return x * y + y * z + z * x;
  }
};

class Collapse {
 public:
  Collapse(const TriTree& tree, std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles)
      : tree_(tree), positions_(positions), triangles_(triangles), runs_(tree.nodes.size()) {
    // Children come after their parents, so that counts add up from the back.
    for (std::size_t n = tree.nodes.size(); n-- > 0;) runs_[n] = runOf(tree.nodes[n]);
  }

  WideTree run() {
    out_.nodes.emplace_back();
    std::vector<Pending> pending{{0, 0, 0}};
    while (!pending.empty()) {
      const Pending p = pending.back();
      pending.pop_back();
      fill(p, pending);
    }
    return std::move(out_);
  }

 private:
  struct Run {
    std::uint32_t first, count;
  };
  struct Pending {
    std::int32_t from;  ///< node of the two-wide tree
    std::size_t to;     ///< node of the wide tree
    int waiting;        ///< entries on a search's stack on the way here
  };

  Run runOf(const TreeNode& node) const {
    Run run{0, 0};
    for (int c = 0; c < 2; ++c) {
      if (!(node.lo[c][0] <= node.hi[c][0])) continue;
      const Run r = childRun(node.child[c]);
      run = {run.count == 0 ? r.first : std::min(run.first, r.first), run.count + r.count};
    }
    return run;
  }

  Run childRun(std::int32_t child) const {
    if (child >= 0) return runs_[static_cast<std::size_t>(child)];
    const auto packed = static_cast<std::uint32_t>(~child);
    return {packed >> 4U, (packed & 15U) + 1};
  }

  void addChildren(std::int32_t node, std::vector<Subtree>& out) const {
    const TreeNode& n = tree_.nodes[static_cast<std::size_t>(node)];
    for (int c = 0; c < 2; ++c) {
      if (!(n.lo[c][0] <= n.hi[c][0])) continue;
      const Run r = childRun(n.child[c]);
      Subtree s{n.child[c], {}, {}, r.first, r.count};
      std::copy_n(n.lo[c], 3, s.lo);
      std::copy_n(n.hi[c], 3, s.hi);
      // A leaf of more than a block becomes several of the same box.
      while (s.isLeaf() && s.count > kLanes) {
        Subtree part = s;
        part.count = kLanes;
        out.push_back(part);
        s.first += kLanes;
        s.count -= kLanes;
      }
      out.push_back(s);
    }
  }

  void fill(const Pending& p, std::vector<Pending>& pending) {
    std::vector<Subtree> children;
    addChildren(p.from, children);
    for (;;) {
      auto largest = children.end();
      for (auto c = children.begin(); c != children.end(); ++c)
        if (!c->isLeaf() && c->count > kLanes && (largest == children.end() || c->area() > largest->area()))
          largest = c;
      // Opening one may add three where leaves are cut; room for all of them.
      if (largest == children.end() || children.size() + 3 > kLanes) {
        if (largest == children.end() || children.size() + 1 > kLanes) break;
        std::vector<Subtree> opened;
        addChildren(largest->child, opened);
        if (children.size() - 1 + opened.size() > kLanes) break;
        children.erase(largest);
        children.insert(children.end(), opened.begin(), opened.end());
        continue;
      }
      const std::int32_t node = largest->child;
      children.erase(largest);
      addChildren(node, children);
    }
    const int waiting = p.waiting + static_cast<int>(children.size()) - 1;
    out_.stack = std::max(out_.stack, waiting);
    for (std::uint32_t k = 0; k < kLanes; ++k)
      setChild(p.to, k, k < children.size() ? &children[k] : nullptr, waiting, pending);
  }

  void setChild(std::size_t node, std::uint32_t k, const Subtree* child, int waiting,
                std::vector<Pending>& pending) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (int a = 0; a < 3; ++a) {
      out_.nodes[node].lo[a][k] = child ? child->lo[a] : kInfinity;
      out_.nodes[node].hi[a][k] = child ? child->hi[a] : -kInfinity;
    }
    std::int32_t link = 0;
    if (child && child->count <= kLanes) {
      link = ~static_cast<std::int32_t>(out_.blocks.size());
      addBlock(child->first, child->count);
    } else if (child) {
      link = static_cast<std::int32_t>(out_.nodes.size());
      pending.push_back({child->child, out_.nodes.size(), waiting});
      out_.nodes.emplace_back();
    }
    out_.nodes[node].child[k] = link;
  }

  void addBlock(std::uint32_t first, std::uint32_t count) {
    TriangleBlock block{};
    block.first = first;
    block.count = count;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const bool there = lane < count;
      const std::uint32_t t = there ? tree_.order[first + lane] : 0;
      block.primitive[lane] = there ? t : 0xffffffffU;
      for (int corner = 0; corner < 3; ++corner)
        for (int a = 0; a < 3; ++a)
          block.v[corner][a][lane] =
              there ? positions_[triangles_[t][corner]][a] : std::numeric_limits<float>::quiet_NaN();
    }
    out_.blocks.push_back(block);
  }

  const TriTree& tree_;
  std::span<const glm::vec3> positions_;
  std::span<const glm::uvec3> triangles_;
  std::vector<Run> runs_;
  WideTree out_;
};

}  // namespace

WideTree buildWideTree(const TriTree& tree, std::span<const glm::vec3> positions,
                       std::span<const glm::uvec3> triangles) {
  return Collapse(tree, positions, triangles).run();
}

}  // namespace whittle
