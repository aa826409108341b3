// Eye rays.
#pragma once

#include "reference/triangle_test.h"
#include "scene/scene.h"

namespace whittle::reference {

/// The ray through (x, y) in pixels, row 0 at the top, of a picture of width × height pixels.
Ray eyeRay(const Camera& camera, const Vec2& position, int width, int height);

/// The ray that leaves a thin lens of `aperture` metres across, focused `distance` metres along the camera's
/// axis, where `u` of the unit square lies on it, and meets `pinhole`, the ray through its middle, in focus.
Ray throughLens(const Camera& camera, const Ray& pinhole, double aperture, double distance, const Vec2& u);

}  // namespace whittle::reference
