// The rays of a pixel as lines over its picture.
#pragma once

#include <optional>
#include <vector>

#include "scene/ray_tree.h"
#include "scene/scene.h"

namespace whittle::view {

enum class Line : std::uint8_t { Eye, Reflected, Refracted, Straight, Shadow, Blocked };

/// From the picture's top left, in shares of its width and height; may lie outside.
struct DrawnRay {
  Line line = Line::Eye;
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  std::size_t ray = 0;  ///< of RayTree::rays
};

/// What of the tree's rays lies before the camera. Rays that leave the scene, and those to lights without a
/// place, are as long as its box is large. An eye ray is a point: where it meets something.
std::vector<DrawnRay> drawnRays(const RayTree& tree, const Scene& scene, const Camera& camera, double aspect);

/// A point in the same shares; nothing: it lies behind the camera.
std::optional<glm::dvec2> placeInPicture(const glm::dvec3& point, const Camera& camera, double aspect);

}  // namespace whittle::view
