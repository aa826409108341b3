// Outlines in the plane: polygons with rounded corners that know the normal of each point. A lathe turns
// them, a plate extrudes them, a sweep draws them along a path. Any unit; that of the mesh that is made of
// them.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace generator {

/// A corner of a polygon and the radius that it is rounded with; 0: a corner as sharp as can be.
struct Corner {
  double x = 0, y = 0, radius = 0;
};

/// `normal` has unit length and points to the right of the way along the outline: outwards where it runs
/// counter-clockwise around what is solid, into the hole where it runs clockwise around one.
struct OutlinePoint {
  glm::dvec2 position, normal;
};

struct Outline {
  std::vector<OutlinePoint> points;  ///< the last is not the first again
  bool isClosed = true;
};

/// Straight sides and arcs. A side keeps its normal to both ends, so that it is shaded flat beside a smooth
/// corner. An arc takes no more than half of a side; `arcStep` is the angle between two of its points,
/// radians.
Outline roundCorners(const std::vector<Corner>& corners, bool isClosed = true, double arcStep = 0.26);

/// The same radius at all corners.
std::vector<Corner> withRadius(const std::vector<glm::dvec2>& points, double radius);

Outline circleOutline(double radius, int segments, glm::dvec2 center = {0, 0});
Outline rectangleOutline(glm::dvec2 low, glm::dvec2 high, double radius, double arcStep = 0.26);
/// The hull of two circles, neither of which holds the other.
struct Circle {
  glm::dvec2 center;
  double radius;
};
Outline hullOutline(const Circle& a, const Circle& b, double arcStep = 0.2);

/// The other way around: an outline that is solid becomes a hole.
Outline reversed(Outline outline);

/// Each point by `distance` to the inside. Right while arcs that bulge out have at least that radius.
std::vector<glm::dvec2> inset(const Outline& outline, double distance);

}  // namespace generator
