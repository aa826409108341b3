// What a camera sees at a place of its picture, and the distance that it is focused on.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

/// Where the ray through (x, y), in [0, 1]² from the picture's top left, first meets a triangle, in the
/// scene's coordinates; nothing where it meets none. Linear in the triangles, in parallel.
std::optional<glm::dvec3> pointUnder(const Scene& scene, const Camera& camera, double aspect, double x,
                                     double y);
/// The same; where it meets none, the point of it nearest to `otherwise`.
glm::dvec3 pointUnder(const Scene& scene, const Camera& camera, double aspect, double x, double y,
                      const glm::dvec3& otherwise);

/// How far along the camera's axis lies what it shows at (x, y), as above, metres: what a lens is focused on.
/// Where nothing is met, the scene's middle, or 1.
float focusOn(const Scene& scene, const Camera& camera, double aspect, double x = 0.5, double y = 0.5);

}  // namespace whittle
