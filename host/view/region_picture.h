// Pictures of which only a region is rendered anew: the rest stays as it was.
#pragma once

#include "render/renderer.h"

namespace whittle::view {

/// What covers a region in a picture whose sides are `factor` times smaller.
Region coarseRegion(const Region& region, int coarseWidth, int coarseHeight, int factor);

/// The last result with `part`, a result of the settings' region, in its place; every image has the settings'
/// size. A coarse part has each of its pixels several times. What nothing was rendered of is black.
/// Statistics are the part's.
RenderResult withRegion(const RenderResult* last, const RenderResult& part, const Settings& settings);

}  // namespace whittle::view
