// Splits of few triangles: sorted on every axis, every plane between two of them is tried. Faster there than
// filling and sweeping bins, and never worse.
#pragma once

#include <cstdint>
#include <span>

#include "bvh/bins.h"

namespace whittle {

inline constexpr std::uint32_t kSmallRange = 8;  ///< at most this many triangles

struct SmallSplit {
  BinSplit plane;                   ///< `bin`: how many are on the low side
  std::uint8_t order[kSmallRange];  ///< the triangles sorted along plane.axis
};

/// The cheapest plane with triangles on both sides, 2 to kSmallRange of them. `box` holds all of them,
/// `centroids` their centroid2.
SmallSplit bestSmallSplit(std::span<const PrimRef> refs, const Box4& box, const Box4& centroids);

}  // namespace whittle
