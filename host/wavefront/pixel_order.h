// The order in which pixels enter the queues: small tiles along a space-filling curve, so that neighbours in
// the queue are neighbours in the picture and a packet of sixteen rays is a 4×4 tile.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/region.h"

namespace whittle {

/// y << 16 | x for each pixel of the region, once each; x and y are the picture's, up to 65535. Tiles of 4×2
/// pixels from the region's corner along a Morton curve (Morton 1966) that goes down first.
std::vector<std::uint32_t> makePixelOrder(const Region& region);

}  // namespace whittle
