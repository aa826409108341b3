// A split by size instead of place: large boxes to one child, small ones to the other. Where a few
// triangles span a node, every plane leaves one of them, and so the node's whole box, on the side of
// the detail; taken out by themselves they cost one leaf. (A teapot in a stadium: all of the teapot
// lies in one bin of the stadium.)
#pragma once

#include <algorithm>
#include <bit>
#include <span>

#include "bvh/prim_ref.h"

namespace whittle {

inline constexpr int kSizeBins = 32;

/// From a triangle to a bin: one for each halving of its box against the node's. The larger ones, those of
/// bins below `bin`, go first.
struct SizeTest {
  double whole = 1;  ///< half area of the node's box, m²
  int bin = 0;

  int binOf(const PrimRef& ref) const {
    // The exponent of the ratio; a box without area counts as the smallest.
    const double ratio = halfArea({ref.lo, ref.hi}) / whole;
    const auto exponent = static_cast<int>(std::bit_cast<std::uint64_t>(ratio) >> 52U);
    return std::clamp(1023 - exponent, 0, kSizeBins - 1);
  }
  bool first(const PrimRef& ref) const { return binOf(ref) < bin; }
};

struct SizeSplit {
  int bin = 0;  ///< 0: none found
  std::uint32_t largeCount = 0, smallCount = 0;
  Box4 large, small;

  /// As BinSplit's.
  double cost() const { return halfArea(large) * largeCount + halfArea(small) * smallCount; }
};

/// The cheapest split by size with triangles on both sides. `whole`: half area of the box of all `refs`.
SizeSplit bestSizeSplit(std::span<const PrimRef> refs, double whole);

}  // namespace whittle
