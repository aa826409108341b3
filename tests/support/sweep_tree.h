// The slow, obvious twin of buildTriTree: full-sweep SAH (MacDonald & Booth 1990), which sorts on every axis
// and tries every split, on one thread. Leaves, layout and cost model are those of the builder, so a search
// runs through either.
#pragma once

#include <algorithm>
#include <limits>
#include <numeric>

#include "bvh/tri_tree.h"

namespace whittle::test {

class SweepBuilder {
 public:
  SweepBuilder(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
               std::size_t maxLeaf = 4)
      : maxLeaf_(maxLeaf) {
    boxes_.reserve(triangles.size());
    for (const glm::uvec3& t : triangles) {
      Box box;
      for (const std::uint32_t v : {t.x, t.y, t.z}) box.grow({positions[v], positions[v]});
      boxes_.push_back(box);
    }
  }

  /// At least one triangle; all of them must be hittable.
  TriTree run() {
    tree_.order.resize(boxes_.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0U);
    const Range all{0, boxes_.size()};
    const Split split = bestSplit(all);
    if (split.at > 0) {
      addNode(split, 1);
    } else {
      TreeNode root{};
      setChild(root, 0, all);
      setChild(root, 1, {0, 0});
      root.child[0] = leaf(all);
      root.child[1] = -1;
      tree_.nodes.push_back(root);
      tree_.depth = 1;
    }
    return std::move(tree_);
  }

 private:
  struct Box {
    glm::vec3 lo{std::numeric_limits<float>::infinity()};
    glm::vec3 hi{-std::numeric_limits<float>::infinity()};

    void grow(const Box& b) {
      lo = glm::min(lo, b.lo);
      hi = glm::max(hi, b.hi);
    }
    double halfArea() const {
      const glm::dvec3 d = glm::dvec3(hi) - glm::dvec3(lo);
      return d.x * d.y + d.y * d.z + d.z * d.x;
    }
  };
  struct Range {
    std::size_t begin, end;
    std::size_t size() const { return end - begin; }
  };
  /// `at` = 0: better not split.
  struct Split {
    std::size_t at = 0;
    Range sides[2] = {};
  };

  Box boxOf(const Range& r) const {
    Box box;
    for (std::size_t i = r.begin; i < r.end; ++i) box.grow(boxes_[tree_.order[i]]);
    return box;
  }

  void sortAlong(int axis, const Range& r) {
    const auto centre2 = [&](std::uint32_t t) {
      return static_cast<double>(boxes_[t].lo[axis]) + static_cast<double>(boxes_[t].hi[axis]);
    };
    const auto begin = tree_.order.begin();
    std::sort(begin + static_cast<std::ptrdiff_t>(r.begin), begin + static_cast<std::ptrdiff_t>(r.end),
              [&](std::uint32_t a, std::uint32_t b) {
                const double ca = centre2(a), cb = centre2(b);
                return ca != cb ? ca < cb : a < b;
              });
  }

  /// Leaves the range sorted along the best axis.
  Split bestSplit(const Range& r) {
    const std::size_t n = r.size();
    if (n < 2) return {};
    double best = std::numeric_limits<double>::infinity();
    std::size_t at = 0;
    int bestAxis = 0;
    std::vector<double> above(n + 1);
    for (int axis = 0; axis < 3; ++axis) {
      sortAlong(axis, r);
      Box box;
      for (std::size_t i = n; i-- > 1;) {
        box.grow(boxes_[tree_.order[r.begin + i]]);
        above[i] = box.halfArea() * static_cast<double>(n - i);
      }
      box = {};
      for (std::size_t i = 1; i < n; ++i) {
        box.grow(boxes_[tree_.order[r.begin + i - 1]]);
        const double cost = box.halfArea() * static_cast<double>(i) + above[i];
        if (cost < best) {
          best = cost;
          at = r.begin + i;
          bestAxis = axis;
        }
      }
    }
    const double area = boxOf(r).halfArea();
    if (n <= maxLeaf_ && area * static_cast<double>(n) <= area + best) return {};
    sortAlong(bestAxis, r);
    Split split{at, {{r.begin, at}, {at, r.end}}};
    // The child more likely to be entered comes first, as in the builder.
    if (boxOf(split.sides[1]).halfArea() > boxOf(split.sides[0]).halfArea()) {
      const auto begin = tree_.order.begin();
      std::rotate(begin + static_cast<std::ptrdiff_t>(r.begin), begin + static_cast<std::ptrdiff_t>(at),
                  begin + static_cast<std::ptrdiff_t>(r.end));
      split.at = r.begin + (r.end - at);
      split.sides[0] = {r.begin, split.at};
      split.sides[1] = {split.at, r.end};
    }
    return split;
  }

  std::int32_t addNode(const Split& split, int depth) {
    const std::size_t index = tree_.nodes.size();
    tree_.nodes.emplace_back();
    tree_.depth = std::max(tree_.depth, depth);
    for (int k = 0; k < 2; ++k) {
      setChild(tree_.nodes[index], k, split.sides[k]);
      const Split below = bestSplit(split.sides[k]);
      const std::int32_t child = below.at > 0 ? addNode(below, depth + 1) : leaf(split.sides[k]);
      tree_.nodes[index].child[k] = child;
    }
    return static_cast<std::int32_t>(index);
  }

  void setChild(TreeNode& node, int k, const Range& r) const {
    const Box box = boxOf(r);
    for (int axis = 0; axis < 3; ++axis) {
      node.lo[k][axis] = box.lo[axis];
      node.hi[k][axis] = box.hi[axis];
    }
  }

  std::int32_t leaf(const Range& r) {
    const auto begin = tree_.order.begin();
    std::sort(begin + static_cast<std::ptrdiff_t>(r.begin), begin + static_cast<std::ptrdiff_t>(r.end));
    return static_cast<std::int32_t>(
        ~(static_cast<std::uint32_t>(r.begin) << 4U | static_cast<std::uint32_t>(r.size() - 1)));
  }

  std::size_t maxLeaf_;
  std::vector<Box> boxes_;
  TriTree tree_;
};

inline TriTree buildSweepTree(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                              std::size_t maxLeaf = 4) {
  return SweepBuilder(positions, triangles, maxLeaf).run();
}

}  // namespace whittle::test
