// What a file gets that has neither lights nor surroundings: a small photographer's studio, set up
// around the camera.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace whittle {

/// Key light with shadows from the left, above and behind the camera, fill light without from the right, rim
/// light without from behind what is seen. Directional, W/m².
std::vector<Light> studioLights(const Camera& camera);

/// Surroundings for smooth surfaces to mirror: a grey gradient and a soft box where each of the lights
/// stands. The boxes shine at no matte surface, the lights do.
Background studioBackground(const Camera& camera);

}  // namespace whittle
