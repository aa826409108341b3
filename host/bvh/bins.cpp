// The binning loop and the sweep over bins. Costs are swept in float lanes relative to the node's size, so
// that neither huge nor tiny coordinates overflow or vanish.
#include "bvh/bins.h"

namespace whittle {

BinMap::BinMap(const Box4& centroids, int binCount) : origin(centroids.lo), scale(splat4(0)), bins(binCount) {
  constexpr float kTooSmall = 1e-36F;  // bins / extent would overflow
  // A little less than the number of bins: the largest centroid stays inside the last one after rounding.
  const float last = static_cast<float>(binCount) * 0.99999F;
  for (int axis = 0; axis < 3; ++axis) {
    const float extent = centroids.hi[axis] - centroids.lo[axis];
    if (extent > kTooSmall && extent <= std::numeric_limits<float>::max()) scale[axis] = last / extent;
  }
}

Bins::Bins(int bins) {
  const Box4 empty;
  for (int i = 0; i < bins; ++i) {
    for (auto& onAxis : box) onAxis[i] = empty;
    count[i].axis = Int4{};
  }
}

void Bins::add(std::span<const PrimRef> refs, const BinMap& binMap) {
  const BinMap map = binMap;  // a copy: the stores below cannot change it, so it stays in registers
  const auto addOne = [&](const PrimRef& ref) {
    const Int4 bin = map(ref);
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<std::uint32_t>(bin[axis]);
      Box4& b = box[axis][at];
      b.lo = min4(b.lo, ref.lo);
      b.hi = max4(b.hi, ref.hi);
      ++count[at].axis[axis];
    }
  };
  // Neighbours fall into the same bins, and each would wait for the one before it: two far apart in turn.
  const std::size_t half = refs.size() / 2;
  for (std::size_t i = 0; i < half; ++i) {
    addOne(refs[i]);
    addOne(refs[half + i]);
  }
  if (refs.size() % 2 != 0) addOne(refs.back());
}

void Bins::merge(const Bins& other, int bins) {
  for (int i = 0; i < bins; ++i) {
    for (int axis = 0; axis < 3; ++axis) box[axis][i].grow(other.box[axis][i]);
    count[i].axis += other.count[i].axis;
  }
}

namespace {

Float4 toFloat(Int4 v) { return __builtin_convertvector(v, Float4); }

/// The box of bins [from, to) on an axis.
Box4 boxOf(const Bins& bins, int axis, int from, int to, std::uint32_t& count) {
  Box4 box;
  for (int i = from; i < to; ++i) {
    box.grow(bins.box[axis][i]);
    count += static_cast<std::uint32_t>(bins.count[i].axis[axis]);
  }
  return box;
}

}  // namespace

BinSplit bestSplit(const Bins& bins, const BinMap& map, const Box4& box) {
  const Float4 scale = relativeScale(box);
  Float4 above[kMaxBins];  // half area · triangles of bins i and higher
  Box4 swept[3];
  Int4 count{};
  for (int i = map.bins - 1; i > 0; --i) {
    for (int axis = 0; axis < 3; ++axis) swept[axis].grow(bins.box[axis][i]);
    count += bins.count[i].axis;
    above[i] = halfAreas(swept, scale) * toFloat(count);
  }
  for (Box4& b : swept) b = Box4{};
  count = Int4{};
  Float4 best = splat4(std::numeric_limits<float>::infinity());
  Int4 bestBin{};
  for (int i = 1; i < map.bins; ++i) {
    for (int axis = 0; axis < 3; ++axis) swept[axis].grow(bins.box[axis][i - 1]);
    count += bins.count[i - 1].axis;
    // An empty side costs inf · 0: a NaN, which is not less than anything.
    const Float4 cost = halfAreas(swept, scale) * toFloat(count) + above[i];
    const Int4 less = cost < best;
    bestBin = less ? Int4{i, i, i, i} : bestBin;
    best = less ? cost : best;
  }
  BinSplit split;
  float cost = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (map.scale[axis] > 0 && best[axis] < cost) {
      cost = best[axis];
      split.axis = axis;
      split.bin = bestBin[axis];
    }
  }
  if (split.axis < 0) return split;
  split.low = boxOf(bins, split.axis, 0, split.bin, split.lowCount);
  split.high = boxOf(bins, split.axis, split.bin, map.bins, split.highCount);
  return split;
}

}  // namespace whittle
