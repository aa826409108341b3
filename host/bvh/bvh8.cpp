// Collapses a two-wide tree. Large subtrees are tasks of their own, each with its own array of nodes; these
// are put behind one another, depth-first, once all sizes are known.
#include "bvh/bvh8.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <vector>

#include "bvh/bvh8_plan.h"

namespace whittle {
namespace {

/// A part of the tree that one task made. Node indices in it count from its own first node.
struct Part {
  std::vector<Bvh8Node> nodes;          ///< never empty
  std::unique_ptr<Part> parts[kLanes];  ///< where set, that child of nodes[0]
  std::size_t leaves = 0;
  int depth = 0;  ///< as Bvh8's, counted from the root of the tree
};

/// A node to be made.
struct Pending {
  std::int32_t from, end;  ///< the subtree of the two-wide tree
  int depth;               ///< nodes on the way here, this one among them
  std::uint32_t lane;      ///< in its parent
};

/// The children of a node that are nodes themselves.
struct InnerChildren {
  Pending child[kLanes];
  std::uint32_t count = 0;
};

class Collapse {
 public:
  explicit Collapse(const TriTree& tree) : tree_(tree), plan_(tree) {}

  std::unique_ptr<Part> run() { return buildPart({0, static_cast<std::int32_t>(tree_.nodes.size()), 1, 0}); }

 private:
  std::unique_ptr<Part> buildPart(const Pending& top) {
    auto part = std::make_unique<Part>();
    part->nodes.resize(1);
    if (top.end - top.from < kBvh8Task) {
      buildSerial(top, *part);
      return part;
    }
    const InnerChildren inner = fill(top, 0, *part);
    tbb::parallel_for(std::uint32_t{0}, inner.count,
                      [&](std::uint32_t i) { part->parts[inner.child[i].lane] = buildPart(inner.child[i]); });
    for (const auto& below : part->parts) {
      if (!below) continue;
      part->depth = std::max(part->depth, below->depth);
      part->leaves += below->leaves;
    }
    return part;
  }

  void buildSerial(const Pending& top, Part& part) {
    part.nodes.reserve(static_cast<std::size_t>(top.end - top.from) / 8 + 1);
    std::vector<std::pair<Pending, std::size_t>> pending{{top, 0}};
    while (!pending.empty()) {
      const auto [p, to] = pending.back();
      pending.pop_back();
      const InnerChildren inner = fill(p, to, part);
      for (std::uint32_t i = 0; i < inner.count; ++i) {
        part.nodes[to].child[inner.child[i].lane] = static_cast<std::int32_t>(part.nodes.size());
        pending.emplace_back(inner.child[i], part.nodes.size());
        part.nodes.emplace_back();
      }
    }
  }

  /// Writes node `to` of `part` but for the indices of the children that are nodes.
  InnerChildren fill(const Pending& p, std::size_t to, Part& part) {
    Bvh8Children children = plan_.childrenOf(p.from, p.end);
    splitLongLeaves(children);
    sortByArea(children);
    part.depth = std::max(part.depth, p.depth);
    InnerChildren inner;
    for (std::uint32_t k = 0; k < kLanes; ++k) {
      if (k >= children.count) {
        setBox(part.nodes[to], k, nullptr);
        continue;
      }
      const SubtreeRef& s = children.child[k];
      setBox(part.nodes[to], k, &s);
      if (!plan_.becomesLeaf(s)) {
        inner.child[inner.count++] = {s.child, s.end, p.depth + 1, k};
      } else if (s.count <= kLanes) {
        part.nodes[to].child[k] = addLeaf(s.first, s.count, part);
      } else {
        const std::int32_t own = addNodeOfTwoLeaves(s, p.depth + 1, part);
        part.nodes[to].child[k] = own;
      }
    }
    return inner;
  }

  /// A leaf of more than eight triangles becomes two children of the same box where there is room, else a
  /// node of its own.
  static void splitLongLeaves(Bvh8Children& children) {
    for (std::uint32_t i = 0; i < children.count; ++i) {
      SubtreeRef& s = children.child[i];
      if (!s.isLeaf() || s.count <= kLanes || children.count == kLanes) continue;
      children.add(secondHalf(s));
      s.count = kLanes;
    }
  }

  static SubtreeRef secondHalf(SubtreeRef s) {
    s.first += kLanes;
    s.count -= kLanes;
    return s;
  }

  /// A shadow ray visits children in this order: what it is most likely to meet comes first.
  void sortByArea(Bvh8Children& children) const {
    float area[kLanes];
    for (std::uint32_t i = 0; i < children.count; ++i) {
      const SubtreeRef s = children.child[i];
      const float a = plan_.area(tree_.nodes[static_cast<std::size_t>(s.parent)], s.side);
      std::uint32_t k = i;
      for (; k > 0 && area[k - 1] < a; --k) {
        area[k] = area[k - 1];
        children.child[k] = children.child[k - 1];
      }
      area[k] = a;
      children.child[k] = s;
    }
  }

  /// nullptr: nothing there.
  void setBox(Bvh8Node& node, std::uint32_t k, const SubtreeRef* s) const {
    const TreeNode* parent = s ? &tree_.nodes[static_cast<std::size_t>(s->parent)] : nullptr;
    for (int a = 0; a < 3; ++a) {
      node.lo[a][k] = parent ? parent->lo[s->side][a] : kInfinity;
      node.hi[a][k] = parent ? parent->hi[s->side][a] : -kInfinity;
    }
  }

  std::int32_t addNodeOfTwoLeaves(const SubtreeRef& s, int depth, Part& part) {
    Bvh8Node node{};
    for (std::uint32_t k = 0; k < kLanes; ++k) setBox(node, k, k < 2 ? &s : nullptr);
    node.child[0] = addLeaf(s.first, kLanes, part);
    node.child[1] = addLeaf(s.first + kLanes, s.count - kLanes, part);
    part.depth = std::max(part.depth, depth);
    part.nodes.push_back(node);
    return static_cast<std::int32_t>(part.nodes.size() - 1);
  }

  static std::int32_t addLeaf(std::uint32_t first, std::uint32_t count, Part& part) {
    ++part.leaves;
    return ~static_cast<std::int32_t>(first << 3U | (count - 1));
  }

  const TriTree& tree_;
  Bvh8Plan plan_;
};

/// Where the nodes of a part go.
struct Placed {
  Part* part;
  std::int32_t base;
};

/// Appends a part and those below it to `all`, depth-first; returns the nodes so far.
std::int32_t place(Part& part, std::int32_t base, std::vector<Placed>& all) {
  all.push_back({&part, base});
  std::int32_t next = base + static_cast<std::int32_t>(part.nodes.size());
  for (std::uint32_t k = 0; k < kLanes; ++k) {
    if (!part.parts[k]) continue;
    // The part's indices still count from its own first node.
    part.nodes[0].child[k] = next - base;
    next = place(*part.parts[k], next, all);
  }
  return next;
}

/// A leaf as its parent names it.
struct Leaf {
  std::uint32_t first, count;
  bool operator<(const Leaf& other) const { return first < other.first; }
};

Leaf leafOf(std::int32_t child) {
  const auto packed = static_cast<std::uint32_t>(~child);
  return {packed >> 3U, (packed & 7U) + 1};
}

std::vector<Leaf> leavesInOrder(const Bvh8& wide) {
  std::vector<Leaf> leaves;
  leaves.reserve(wide.leaves);
  for (const Bvh8Node& node : wide.nodes)
    for (const std::int32_t child : node.child)
      if (child < 0) leaves.push_back(leafOf(child));
  tbb::parallel_sort(leaves.begin(), leaves.end());
  return leaves;
}

UninitializedVector<Bvh8Node> join(Part& top) {
  std::vector<Placed> all;
  UninitializedVector<Bvh8Node> nodes;
  nodes.resize(static_cast<std::size_t>(place(top, 0, all)));
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
    auto to = nodes.begin() + all[i].base;
    for (const Bvh8Node& node : all[i].part->nodes) {
      *to = node;
      // A node comes after its parent, so a child that is a node is never 0, and an absent one always.
      for (std::int32_t& child : to->child) child += child > 0 ? all[i].base : 0;
      ++to;
    }
  });
  return nodes;
}

/// The floats of these leaves, the first of them at `out`.
void fillLeaves(std::span<const Leaf> leaves, const TriTree& tree, const CornersOf& cornersOf, float* out) {
  const std::size_t from = leaves.front().first;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leaves.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const auto [first, count] = leaves[i];
      float* const to = out + 9 * (first - from);
      for (std::uint32_t lane = 0; lane < count; ++lane) {
        const std::array<glm::vec3, 3> corners = cornersOf(tree.order[first + lane]);
        for (std::uint32_t k = 0; k < 3; ++k)
          for (std::uint32_t a = 0; a < 3; ++a)
            to[(3 * k + a) * count + lane] = corners[k][static_cast<int>(a)];
      }
    }
  });
}

/// Behind the last leaf.
constexpr float kBeyond[9] = {};

}  // namespace

Bvh8 buildBvh8(const TriTree& tree) {
  Bvh8 wide;
  std::unique_ptr<Part> top = Collapse(tree).run();  // its plan goes before the parts are joined
  wide.nodes = join(*top);
  wide.leaves = top->leaves;
  wide.depth = top->depth;
  return wide;
}

Bvh8 buildLeaves(const TriTree& tree) {
  const auto triangles = static_cast<std::uint32_t>(tree.order.size());
  Bvh8 wide;
  wide.leaves = (triangles + kLanes - 1) / kLanes;
  wide.nodes.resize((wide.leaves + kLanes - 1) / kLanes);
  for (std::uint32_t leaf = 0; leaf < kLanes * wide.nodes.size(); ++leaf) {
    const std::uint32_t first = kLanes * leaf,
                        count = std::min(kLanes, triangles - std::min(triangles, first));
    wide.nodes[leaf / kLanes].child[leaf % kLanes] =
        count > 0 ? ~static_cast<std::int32_t>(first << 3U | (count - 1)) : 0;
  }
  return wide;
}

void eachLeafPart(const Bvh8& wide, const TriTree& tree, const CornersOf& cornersOf,
                  const TakeLeafFloats& take) {
  constexpr std::size_t kAtOnce = 1 << 14;  // leaves: some 2 MB
  const std::vector<Leaf> leaves = leavesInOrder(wide);
  UninitializedVector<float> part;
  for (std::size_t begin = 0; begin < leaves.size(); begin += kAtOnce) {
    const std::span<const Leaf> some(&leaves[begin], std::min(kAtOnce, leaves.size() - begin));
    const std::size_t from = some.front().first, to = some.back().first + some.back().count;
    part.resize(9 * (to - from));
    fillLeaves(some, tree, cornersOf, part.data());
    take(9 * from, part);
  }
  take(leafFloats(tree) - std::size(kBeyond), kBeyond);
}

void makeLeaves(const Bvh8& wide, const TriTree& tree, const CornersOf& cornersOf, std::span<float> out) {
  const std::vector<Leaf> leaves = leavesInOrder(wide);
  if (!leaves.empty())
    fillLeaves(leaves, tree, cornersOf, out.data() + std::size_t{9} * leaves.front().first);
  std::copy(std::begin(kBeyond), std::end(kBeyond), out.end() - std::size(kBeyond));
}

std::vector<std::uint8_t> leafPlaces(const Bvh8& wide, const TriTree& tree) {
  std::vector<std::uint8_t> places(tree.order.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, wide.nodes.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      for (const std::int32_t child : wide.nodes[i].child) {
        if (child >= 0) continue;
        const Leaf leaf = leafOf(child);
        for (std::uint32_t lane = 0; lane < leaf.count; ++lane)
          places[leaf.first + lane] = static_cast<std::uint8_t>(lane | (leaf.count - 1) << 3U);
      }
  });
  return places;
}

}  // namespace whittle
