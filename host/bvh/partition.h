// Puts the triangles of one side of a split before those of the other, in place. The result depends on the
// input alone: the parallel version cuts the range at places that do not depend on threads.
#pragma once

#include <cstddef>
#include <span>

#include "bvh/bins.h"
#include "bvh/size_split.h"

namespace whittle {

/// The side of a plane that goes first.
struct SideTest {
  BinMap map;
  int axis = 0;
  int bin = 0;
  bool highFirst = false;

  bool first(const PrimRef& ref) const { return (map(ref, axis) < bin) != highFirst; }
};

struct Partition {
  std::size_t first = 0;  ///< how many are on the first side
  Box4 centroids[2];      ///< bounds of centroid2 of both sides
};

/// Test: SideTest or SizeTest.
template <typename Test>
Partition partition(std::span<PrimRef> refs, const Test& test);
template <typename Test>
Partition partitionParallel(std::span<PrimRef> refs, const Test& test);

}  // namespace whittle
