// Where a scene lies, and what single precision makes of it there.
#pragma once

#include <glm/glm.hpp>

#include "gltf/extent.h"
#include "gltf/nodes.h"

namespace whittle::gltf {

/// What is to be taken off all places, metres (Scene::origin): 0, but where the scene lies so far from there,
/// seen from its own size, that rounding would show. `hierarchy` has no origin yet.
glm::dvec3 originFor(const Document& document, const Hierarchy& hierarchy, Extents& extents);

/// Warns of the mesh whose own coordinates are so large that the file's floats bend its shape, and counts the
/// others: no origin brings back what the file does not hold.
void warnOfCoarsePositions(const Document& document, const Hierarchy& hierarchy, Extents& extents,
                           Notices& notices);

}  // namespace whittle::gltf
