// Ranks on three axes at once instead of three sorts: no branch to mispredict.
#include "bvh/small_split.h"

#include <cassert>

namespace whittle {

namespace {

using Order = std::uint8_t[3][kSmallRange];

/// By centroid; equal ones stay in the order they are in.
void sortOnAxes(std::span<const PrimRef> refs, Order& order) {
  Float4 centroid[kSmallRange];
  Int4 rank[kSmallRange];
  for (std::size_t i = 0; i < refs.size(); ++i) {
    centroid[i] = refs[i].centroid2();
    rank[i] = Int4{};
    for (std::size_t j = 0; j < i; ++j) {
      const Int4 less = centroid[i] < centroid[j];  // -1 where true
      rank[j] -= less;
      rank[i] += less + 1;
    }
  }
  for (std::size_t i = 0; i < refs.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) order[axis][rank[i][axis]] = static_cast<std::uint8_t>(i);
  }
}

void grow(Box4 (&swept)[3], std::span<const PrimRef> refs, const Order& order, std::size_t k) {
  for (int axis = 0; axis < 3; ++axis) {
    const PrimRef& ref = refs[order[axis][k]];
    swept[axis].grow({ref.lo, ref.hi});
  }
}

}  // namespace

SmallSplit bestSmallSplit(std::span<const PrimRef> refs, const Box4& box, const Box4& centroids) {
  const auto n = static_cast<int>(refs.size());
  assert(n >= 2 && refs.size() <= kSmallRange);
  Order order;
  sortOnAxes(refs, order);
  const Float4 scale = relativeScale(box);
  Float4 above[kSmallRange];  // half area · triangles from the k-th on
  Box4 swept[3];
  for (int k = n - 1; k > 0; --k) {
    grow(swept, refs, order, static_cast<std::size_t>(k));
    above[k] = halfAreas(swept, scale) * static_cast<float>(n - k);
  }
  for (Box4& b : swept) b = Box4{};
  Float4 best = splat4(std::numeric_limits<float>::infinity());
  Int4 bestCount{};
  for (int k = 1; k < n; ++k) {
    grow(swept, refs, order, static_cast<std::size_t>(k - 1));
    const Float4 cost = halfAreas(swept, scale) * static_cast<float>(k) + above[k];
    const Int4 less = cost < best;
    bestCount = less ? Int4{k, k, k, k} : bestCount;
    best = less ? cost : best;
  }
  SmallSplit split;
  float cost = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    // Triangles with one centroid are not told apart by place.
    if (!(centroids.lo[axis] < centroids.hi[axis]) || !(best[axis] < cost)) continue;
    cost = best[axis];
    split.plane.axis = axis;
    split.plane.bin = bestCount[axis];
  }
  if (split.plane.axis < 0) return split;
  split.plane.lowCount = static_cast<std::uint32_t>(split.plane.bin);
  split.plane.highCount = static_cast<std::uint32_t>(n) - split.plane.lowCount;
  for (int k = 0; k < n; ++k) {
    split.order[k] = order[split.plane.axis][k];
    const PrimRef& ref = refs[split.order[k]];
    (k < split.plane.bin ? split.plane.low : split.plane.high).grow({ref.lo, ref.hi});
  }
  return split;
}

}  // namespace whittle
