// How near lights come to surfaces: the most light that can fall on a material.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

/// For each material, upper bounds on the biradiance of all lights together at any point of it, W/m², each
/// channel: intensity / (distance of the nearest triangle)², whichever way it faces and whatever is between.
/// Infinite where a light lies on a triangle, or as near as a hit is rounded.
std::vector<glm::dvec3> largestBiradiance(const Scene& scene, const Settings& settings);

}  // namespace whittle
