// How much of the sky reaches what a camera sees.
#pragma once

#include "scene/scene.h"

namespace whittle {

/// 0: nothing of it, in a closed room; 1: as much as reaches a wall in the open, or more. The median of five
/// places of the picture, each with eight rays to the sky; what lets light through does not stand in their
/// way. 1 where the camera sees nothing but sky. Linear in the triangles, in parallel.
double openSky(const Scene& scene, const Camera& camera, double aspect);

}  // namespace whittle
