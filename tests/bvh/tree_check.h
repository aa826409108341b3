// Says what is wrong with a tree, if anything: the conditions that traversal relies on, checked one by one.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bvh/tri_tree.h"
#include "support/random_scenes.h"

namespace whittle::test {

struct LeafRange {
  std::size_t first, count;
};

inline LeafRange leafRange(std::int32_t child) {
  const auto code = static_cast<std::uint32_t>(~child);
  return {code >> 4, (code & 15U) + 1};
}

inline bool absentChild(const TreeNode& node, int k) { return node.hi[k][0] < node.lo[k][0]; }

/// Triangles that a tree must hold: all corners finite and no two of them the same point.
inline bool belongsInTree(const TriangleMesh& mesh, const glm::uvec3& t) {
  const glm::vec3 p[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
  for (const glm::vec3& q : p) {
    if (!std::isfinite(q.x) || !std::isfinite(q.y) || !std::isfinite(q.z)) return false;
  }
  return p[0] != p[1] && p[1] != p[2] && p[2] != p[0];
}

/// Walks a tree and remembers the first thing that is wrong.
class TreeChecker {
 public:
  TreeChecker(const TriTree& tree, const TriangleMesh& mesh, int maxLeaf)
      : tree_(tree), mesh_(mesh), maxLeaf_(static_cast<std::size_t>(maxLeaf)) {}

  /// Empty if the tree is valid.
  std::string run() {
    if (tree_.nodes.empty()) return "no root";
    nodeSeen_.assign(tree_.nodes.size(), 0);
    placeSeen_.assign(tree_.order.size(), 0);
    triangleSeen_.assign(mesh_.triangles.size(), 0);
    const glm::vec3 inf(std::numeric_limits<float>::infinity());
    visit(0, 1, -inf, inf, false);
    if (problem_.empty() && depth_ != tree_.depth) fail("depth {} said, {} found", tree_.depth, depth_);
    if (depth_ > kMaxTreeDepth) fail("depth {}", depth_);
    for (std::size_t i = 0; i < nodeSeen_.size(); ++i) {
      if (nodeSeen_[i] != 1) fail("node {} reached {} times", i, nodeSeen_[i]);
    }
    for (std::size_t i = 0; i < placeSeen_.size(); ++i) {
      if (placeSeen_[i] != 1) fail("order[{}] in {} leaves", i, placeSeen_[i]);
    }
    for (std::size_t i = 0; i < triangleSeen_.size(); ++i) {
      const int expected = belongsInTree(mesh_, mesh_.triangles[i]) ? 1 : 0;
      if (triangleSeen_[i] != expected) fail("triangle {} in {} leaves", i, triangleSeen_[i]);
    }
    return problem_;
  }

 private:
  template <typename... Args>
  void fail(fmt::format_string<Args...> text, Args&&... args) {
    if (problem_.empty()) problem_ = fmt::format(text, std::forward<Args>(args)...);
  }

  /// `lo`..`hi`: the box the parent has for this node; it must be exactly the union of the children's.
  void visit(std::int32_t index, int depth, glm::vec3 lo, glm::vec3 hi, bool exact) {
    if (index < 0 || static_cast<std::size_t>(index) >= tree_.nodes.size()) return fail("node {}", index);
    if (nodeSeen_[static_cast<std::size_t>(index)]++ > 0) return fail("node {} reached twice", index);
    depth_ = std::max(depth_, depth);
    const TreeNode& node = tree_.nodes[static_cast<std::size_t>(index)];
    glm::vec3 unionLo(std::numeric_limits<float>::infinity()), unionHi(-unionLo);
    std::int32_t firstInner = -1;
    for (int k = 0; k < 2; ++k) {
      const glm::vec3 childLo{node.lo[k][0], node.lo[k][1], node.lo[k][2]};
      const glm::vec3 childHi{node.hi[k][0], node.hi[k][1], node.hi[k][2]};
      unionLo = glm::min(unionLo, childLo);
      unionHi = glm::max(unionHi, childHi);
      if (absentChild(node, k)) {
        if (index != 0 || node.child[k] != -1) fail("node {} has an absent child", index);
      } else if (node.child[k] < 0) {
        visitLeaf(node.child[k], childLo, childHi);
      } else {
        if (firstInner < 0 && node.child[k] != index + 1) fail("node {} is not depth-first", index);
        if (firstInner >= 0 && node.child[k] <= firstInner) fail("node {} has its children swapped", index);
        firstInner = node.child[k];
        visit(node.child[k], depth + 1, childLo, childHi, true);
      }
    }
    if (exact && (unionLo != lo || unionHi != hi)) fail("box of node {} is not that of its children", index);
  }

  void visitLeaf(std::int32_t child, glm::vec3 lo, glm::vec3 hi) {
    const LeafRange leaf = leafRange(child);
    if (leaf.count > maxLeaf_) fail("leaf of {}", leaf.count);
    if (leaf.first + leaf.count > tree_.order.size()) return fail("leaf at {} beyond the order", leaf.first);
    glm::vec3 unionLo(std::numeric_limits<float>::infinity()), unionHi(-unionLo);
    for (std::size_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
      ++placeSeen_[i];
      const std::uint32_t triangle = tree_.order[i];
      if (triangle >= mesh_.triangles.size()) return fail("triangle {}", triangle);
      if (i > leaf.first && tree_.order[i - 1] >= triangle) fail("leaf at {} not ascending", leaf.first);
      ++triangleSeen_[triangle];
      const glm::uvec3 t = mesh_.triangles[triangle];
      for (const std::uint32_t v : {t.x, t.y, t.z}) {
        unionLo = glm::min(unionLo, mesh_.positions[v]);
        unionHi = glm::max(unionHi, mesh_.positions[v]);
      }
    }
    if (unionLo != lo || unionHi != hi) fail("box of the leaf at {} is not that of its vertices", leaf.first);
  }

  const TriTree& tree_;
  const TriangleMesh& mesh_;
  std::size_t maxLeaf_;
  std::string problem_;
  int depth_ = 0;
  std::vector<int> nodeSeen_, placeSeen_, triangleSeen_;
};

inline std::string checkTree(const TriTree& tree, const TriangleMesh& mesh, int maxLeaf = 4) {
  return TreeChecker(tree, mesh, maxLeaf).run();
}

inline TriTree build(const TriangleMesh& mesh, const BuildOptions& options = {}) {
  return buildTriTree(mesh.positions, mesh.triangles, options);
}

}  // namespace whittle::test
