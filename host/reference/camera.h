// Eye rays.
#pragma once

#include "reference/triangle_test.h"
#include "scene/scene.h"

namespace whittle::reference {

/// The ray through (x, y) in pixels, row 0 at the top, of a picture of width × height pixels.
Ray eyeRay(const Camera& camera, const Vec2& position, int width, int height);

}  // namespace whittle::reference
