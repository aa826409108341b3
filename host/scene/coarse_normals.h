// Which triangles stand for a piece of a curved surface, by their vertex normals.
#pragma once

#include "kernels/shared/layout.h"
#include "scene/scene.h"

namespace whittle {

/// Whether some triangle does as layout.h says, or is so near to it that rounding might find that it does.
bool hasCoarseNormals(const Scene& scene);

}  // namespace whittle
