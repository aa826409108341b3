// What the rays of a pixel bring of its value, and the orders in which a list shows them.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/ray_tree.h"

namespace whittle::view {

/// Of each ray of a tree, as shares of the brightest channel of their sum; 0 where that is black.
struct RayShares {
  std::vector<double> own;    ///< what it adds itself
  std::vector<double> below;  ///< and with the rays that it sends on, and theirs
  /// Rays by `own`, the largest first; what is equal is in the order of the tree.
  std::vector<std::size_t> largestFirst;
  /// Leads to the ray that adds most: it is that ray, or above it.
  std::vector<bool> leadsToLargest;
};

RayShares sharesOf(const RayTree& tree);

}  // namespace whittle::view
