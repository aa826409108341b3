// Bodies of revolution.
#pragma once

#include "mesh.h"
#include "shapes/outline.h"

namespace generator {

/// Turns `profile` about +Y. Its x is the distance from the axis, at least 0, its y the height. An open
/// profile that starts on the axis below and ends on it above bounds a solid, and so does a closed one that
/// runs counter-clockwise. uv0: x runs to repeat.x around the axis, y falls from repeat.y along the profile;
/// tangents go around.
Mesh makeLathe(const Outline& profile, int segments, glm::dvec2 repeat = {1, 1});

}  // namespace generator
