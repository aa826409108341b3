// The recursion of the builder: where to split, when to stop, in which order nodes are laid out. Binned SAH
// after Wald 2007, splits by size where every plane is poor; the depth limit falls back to object medians.
#include "bvh/tri_tree_builder.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "bvh/bins.h"
#include "bvh/chunks.h"
#include "bvh/partition.h"

namespace whittle {

namespace {

constexpr std::uint32_t kParallelSplit = 1U
                                         << 16;  ///< triangles from which one split is worth several threads
constexpr std::uint32_t kParallelTask = 1U << 11;  ///< triangles from which a subtree is worth a task

/// A plane whose sides cost more than this part of the node undivided hardly helps. (0.6 to 0.9 give the same
/// trees but for a few nodes.)
constexpr double kPoorPlane = 0.8;

/// Levels of nodes that median splits need below and including a node of n triangles; 0: fits in a leaf.
int medianLevels(std::uint32_t n, std::uint32_t maxLeaf) {
  int levels = 0;
  for (std::uint64_t room = maxLeaf; room < n; room *= 2) ++levels;
  return levels;
}

/// Few triangles do not fill many bins, and sweeping empty ones is most of the work near the leaves. Two
/// triangles with different centroids always fall into both of two bins.
int binCount(std::uint32_t n, int most) {
  return n == 2 ? 2 : std::min(most, 4 + static_cast<int>(std::min(n, 1U << 16) / 8));
}

void setChildBox(TreeNode& node, int k, const Box4& box) {
  for (int axis = 0; axis < 3; ++axis) {
    node.lo[k][axis] = box.lo[axis];
    node.hi[k][axis] = box.hi[axis];
  }
}

TreeNode makeNode(const Box4& first, const Box4& second) {
  TreeNode node{};
  setChildBox(node, 0, first);
  setChildBox(node, 1, second);
  return node;
}

Bins binRange(std::span<const PrimRef> refs, const BinMap& map) {
  Bins bins(map.bins);
  if (refs.size() < kParallelSplit) {
    bins.add(refs, map);
    return bins;
  }
  std::vector<Bins> parts(chunkCount(refs.size()), bins);
  forEachChunk(refs.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    parts[chunk].add(refs.subspan(begin, end - begin), map);
  });
  for (const Bins& part : parts) bins.merge(part, map.bins);
  return bins;
}

BinSplit halvesOfTwo(std::span<const PrimRef> refs) {
  BinSplit split;
  split.lowCount = split.highCount = 1;
  split.low = {refs[0].lo, refs[0].hi};
  split.high = {refs[1].lo, refs[1].hi};
  return split;
}

}  // namespace

TriTreeBuilder::TriTreeBuilder(std::span<PrimRef> refs, std::span<std::uint32_t> order,
                               const BuildOptions& options)
    : refs_(refs), order_(order), options_(options) {
  options_.maxLeafTriangles = std::clamp(options.maxLeafTriangles, 1, 16);
  options_.bins = std::clamp(options.bins, 2, kMaxBins);
}

std::unique_ptr<Subtree> TriTreeBuilder::build(const BuildRange& all) const {
  Children children;
  if (all.size() > 0 && split(all, 1, children)) return buildParallel(children, 1);
  // No or one leaf: a root with one or two absent children, whose boxes are empty and never hit.
  auto tree = std::make_unique<Subtree>();
  tree->depth = 1;
  TreeNode root = makeNode(all.box, Box4{});
  root.child[0] = all.size() > 0 ? makeLeaf(all) : -1;
  root.child[1] = -1;
  tree->nodes.push_back(root);
  return tree;
}

std::unique_ptr<Subtree> TriTreeBuilder::buildParallel(const Children& children, int depth) const {
  auto tree = std::make_unique<Subtree>();
  const std::uint32_t size = children.range[0].size() + children.range[1].size();
  if (size < kParallelTask) {
    tree->nodes.reserve(size / 2);
    buildSerial(children, depth, *tree);
    return tree;
  }
  tree->depth = depth;
  tree->nodes.push_back(makeNode(children.range[0].box, children.range[1].box));
  const auto child = [&](int k) {
    Children below;
    if (split(children.range[k], depth + 1, below)) {
      tree->parts[k] = buildParallel(below, depth + 1);
    } else {
      tree->nodes[0].child[k] = makeLeaf(children.range[k]);
    }
  };
  tbb::parallel_invoke([&] { child(0); }, [&] { child(1); });
  for (const auto& part : tree->parts) {
    if (part) tree->depth = std::max(tree->depth, part->depth);
  }
  return tree;
}

std::int32_t TriTreeBuilder::buildSerial(const Children& children, int depth, Subtree& out) const {
  const std::size_t index = out.nodes.size();
  out.nodes.push_back(makeNode(children.range[0].box, children.range[1].box));
  out.depth = std::max(out.depth, depth);
  for (int k = 0; k < 2; ++k) {
    Children below;
    const bool inner = split(children.range[k], depth + 1, below);
    const std::int32_t child = inner ? buildSerial(below, depth + 1, out) : makeLeaf(children.range[k]);
    out.nodes[index].child[k] = child;
  }
  return static_cast<std::int32_t>(index);
}

bool TriTreeBuilder::split(const BuildRange& range, int depth, Children& children) const {
  const std::uint32_t n = range.size();
  const auto maxLeaf = static_cast<std::uint32_t>(options_.maxLeafTriangles);
  if (n < 2) return false;
  const int levels = medianLevels(n, maxLeaf);
  assert(levels <= kMaxTreeDepth - depth + 1);
  // A split by area may leave all but one triangle to a child, for which the levels below must be enough.
  if (depth <= kMaxTreeDepth && levels <= kMaxTreeDepth - depth) {
    if (n <= kSmallRange ? splitSmall(range, children) : splitLarge(range, children)) return true;
  }
  if (n <= maxLeaf) return false;
  splitAtMedian(range, children);
  return true;
}

bool TriTreeBuilder::splitSmall(const BuildRange& range, Children& children) const {
  // Most calls end here: two triangles can be split in one way only.
  if (range.size() == 2 && mayBeLeaf(range) && !worthSplitting(range, halvesOfTwo(refs(range)))) return false;
  const SmallSplit split = bestSmallSplit(refs(range), range.box, range.centroids);
  if (split.plane.axis < 0) return false;
  if (mayBeLeaf(range) && !worthSplitting(range, split.plane)) return false;
  splitSorted(range, split, children);
  return true;
}

bool TriTreeBuilder::splitLarge(const BuildRange& range, Children& children) const {
  const BinMap map(range.centroids, binCount(range.size(), options_.bins));
  if (!map.usable()) return false;
  const BinSplit plane = bestSplit(binRange(refs(range), map), map, range.box);
  if (plane.axis < 0) return false;
  if (mayBeLeaf(range) && !worthSplitting(range, plane)) return false;
  // A plane that leaves nearly all of the cost: a split by size may do better.
  const double area = halfArea(range.box);
  if (!mayBeLeaf(range) && plane.cost() > kPoorPlane * area * range.size()) {
    const SizeSplit sizes = bestSizeSplit(refs(range), area);
    if (sizes.bin > 0 && sizes.cost() < plane.cost()) {
      splitBySize(range, sizes, children);
      return true;
    }
  }
  splitAtPlane(range, map, plane, children);
  return true;
}

bool TriTreeBuilder::mayBeLeaf(const BuildRange& range) const {
  return range.size() <= static_cast<std::uint32_t>(options_.maxLeafTriangles);
}

bool TriTreeBuilder::worthSplitting(const BuildRange& range, const BinSplit& plane) const {
  const double area = halfArea(range.box);
  return area * options_.traversalCost + plane.cost() < area * range.size();
}

void TriTreeBuilder::splitAtPlane(const BuildRange& range, const BinMap& map, const BinSplit& plane,
                                  Children& children) const {
  // The child more likely to be entered comes first and so lies next to its parent, nodes and triangles.
  const SideTest test{map, plane.axis, plane.bin, halfArea(plane.high) > halfArea(plane.low)};
  const bool large = range.size() >= kParallelSplit;
  const Partition sides = large ? partitionParallel(refs(range), test) : partition(refs(range), test);
  const std::uint32_t middle = range.begin + static_cast<std::uint32_t>(sides.first);
  children.range[0] = {range.begin, middle, test.highFirst ? plane.high : plane.low, sides.centroids[0]};
  children.range[1] = {middle, range.end, test.highFirst ? plane.low : plane.high, sides.centroids[1]};
}

/// The sorted triangles, or their upper part first; either part stays sorted.
void TriTreeBuilder::splitSorted(const BuildRange& range, const SmallSplit& split, Children& children) const {
  const bool highFirst = halfArea(split.plane.high) > halfArea(split.plane.low);
  const std::uint32_t n = range.size(), low = split.plane.lowCount;
  const std::span<PrimRef> all = refs(range);
  PrimRef old[kSmallRange];
  std::copy(all.begin(), all.end(), old);
  const std::uint32_t middle = range.begin + (highFirst ? n - low : low);
  children.range[0] = {range.begin, middle, highFirst ? split.plane.high : split.plane.low, {}};
  children.range[1] = {middle, range.end, highFirst ? split.plane.low : split.plane.high, {}};
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t to = highFirst ? (k < low ? n - low + k : k - low) : k;
    all[to] = old[split.order[k]];
    children.range[range.begin + to < middle ? 0 : 1].centroids.grow(all[to].centroid2());
  }
}

void TriTreeBuilder::splitBySize(const BuildRange& range, const SizeSplit& sizes, Children& children) const {
  const SizeTest test{halfArea(range.box), sizes.bin};
  const bool large = range.size() >= kParallelSplit;
  const Partition sides = large ? partitionParallel(refs(range), test) : partition(refs(range), test);
  const std::uint32_t middle = range.begin + static_cast<std::uint32_t>(sides.first);
  children.range[0] = {range.begin, middle, sizes.large, sides.centroids[0]};
  children.range[1] = {middle, range.end, sizes.small, sides.centroids[1]};
  if (halfArea(sizes.large) < halfArea(sizes.small)) std::swap(children.range[0], children.range[1]);
}

void TriTreeBuilder::splitAtMedian(const BuildRange& range, Children& children) const {
  int axis = 0;
  double widest = 0;
  for (int i = 0; i < 3; ++i) {
    const double extent =
        static_cast<double>(range.centroids.hi[i]) - static_cast<double>(range.centroids.lo[i]);
    if (extent > widest) {
      widest = extent;
      axis = i;
    }
  }
  // Concentric triangles are told apart by size: the small ones share a small box. Ties go by index.
  const auto key = [&](const PrimRef& r) {
    if (widest > 0) return static_cast<double>(r.lo[axis]) + static_cast<double>(r.hi[axis]);
    return -halfArea({r.lo, r.hi});
  };
  const std::uint32_t half = range.size() / 2;
  const std::span<PrimRef> all = refs(range);
  std::nth_element(all.begin(), all.begin() + half, all.end(), [&](const PrimRef& a, const PrimRef& b) {
    const double keyA = key(a), keyB = key(b);
    return keyA != keyB ? keyA < keyB : a.index() < b.index();
  });
  children.range[0].begin = range.begin;
  children.range[0].end = children.range[1].begin = range.begin + half;
  children.range[1].end = range.end;
  for (BuildRange& part : children.range) {
    for (std::uint32_t i = part.begin; i < part.end; ++i) {
      part.box.grow({refs_[i].lo, refs_[i].hi});
      part.centroids.grow(refs_[i].centroid2());
    }
  }
  if (halfArea(children.range[0].box) < halfArea(children.range[1].box)) {
    std::swap(children.range[0], children.range[1]);
  }
}

std::int32_t TriTreeBuilder::makeLeaf(const BuildRange& range) const {
  const std::uint32_t count = range.size();
  assert(count >= 1 && count <= 16);
  for (std::uint32_t i = range.begin; i < range.end; ++i) order_[i] = refs_[i].index();
  std::sort(order_.begin() + range.begin, order_.begin() + range.end);
  return static_cast<std::int32_t>(~(range.begin << 4 | (count - 1)));
}

}  // namespace whittle
