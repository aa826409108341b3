// Binned surface-area heuristic: sorts triangles into bins by centroid and finds the cheapest plane between
// two bins on any axis. After Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007.
#pragma once

#include <algorithm>
#include <span>

#include "bvh/prim_ref.h"

namespace whittle {

inline constexpr int kMaxBins = 64;

/// From a triangle to its bin on each axis.
struct BinMap {
  Float4 origin;
  Float4 scale;  ///< 0 on an axis that cannot be split: no extent, or one that float cannot divide by
  int bins = 0;

  BinMap(const Box4& centroids, int binCount);
  bool usable() const { return scale[0] > 0 || scale[1] > 0 || scale[2] > 0; }
  Int4 operator()(const PrimRef& ref) const {
    // max4 also turns the NaN of an axis that overflowed (inf - inf, inf · 0) into bin 0.
    return __builtin_convertvector(max4((ref.centroid2() - origin) * scale, splat4(0)), Int4);
  }
  /// The same on one axis.
  int operator()(const PrimRef& ref, int axis) const {
    const float c = ref.lo[axis] + ref.hi[axis];
    return static_cast<int>(std::max((c - origin[axis]) * scale[axis], 0.0F));
  }
};

/// Boxes and counts of the triangles of each bin and axis.
struct Bins {
  /// As long as a box, so that one offset from the start of an array finds a bin in any of them.
  struct Count {
    alignas(sizeof(Box4)) Int4 axis;  ///< lane: axis
  };
  Box4 box[3][kMaxBins];  ///< by axis
  Count count[kMaxBins];

  explicit Bins(int bins);  ///< empties the first `bins`
  void add(std::span<const PrimRef> refs, const BinMap& map);
  void merge(const Bins& other, int bins);
};

/// A plane: triangles in bins below `bin` on `axis` are on the low side.
struct BinSplit {
  int axis = -1;  ///< -1: none found
  int bin = 0;
  std::uint32_t lowCount = 0, highCount = 0;
  Box4 low, high;

  /// Σ half area · triangles of both sides, m².
  double cost() const { return halfArea(low) * lowCount + halfArea(high) * highCount; }
};

/// The cheapest plane with triangles on both sides. `box` holds all triangles of `bins`.
BinSplit bestSplit(const Bins& bins, const BinMap& map, const Box4& box);

}  // namespace whittle
