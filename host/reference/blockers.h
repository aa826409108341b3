// What stands between a point and a light: for whoever asks why a pixel is dark. In double precision, by
// trying every triangle, which takes no memory and no time before the first question.
#pragma once

#include "scene/ray_tree.h"
#include "scene/scene.h"

namespace whittle {

/// Fills ShadowRecord::blocker of the shadow rays of which nothing arrives: the nearest surface that lets
/// none of the light through. In large scenes those of the largest contributions alone, so that it takes some
/// seconds at most.
void findBlockers(const Scene& scene, RayTree& tree);

}  // namespace whittle
