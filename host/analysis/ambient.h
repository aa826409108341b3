// How bright a scene's light is, for those who want a share of it everywhere.
#pragma once

#include "scene/scene.h"

namespace whittle {

/// A tenth of what a white, matte surface would send back, W/(m² sr): facing all lamps at the middle of the
/// scene, unshadowed, and seeing the mean of the background. A lamp inside the scene counts as far from the
/// middle as half the diagonal of the scene's box. In the brightest channel; 0 where there is no light.
float automaticAmbient(const Scene& scene);

}  // namespace whittle
