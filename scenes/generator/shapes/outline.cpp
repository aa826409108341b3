// Rounding of polygons by tangent arcs.
#include "shapes/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh.h"

namespace generator {
namespace {

/// The least share of the shorter side that the arc of a sharp corner takes.
constexpr double kSharpest = 1e-3;
/// The largest, so that two arcs never end in one point.
constexpr double kRoundest = 0.49;

glm::dvec2 rightOf(glm::dvec2 direction) { return {direction.y, -direction.x}; }

/// The direction `t` of the way from `a` to `b`, which have unit length and lie `angle` apart.
glm::dvec2 between(glm::dvec2 a, glm::dvec2 b, double angle, double t) {
  return glm::normalize(std::sin((1 - t) * angle) * a + std::sin(t * angle) * b);
}

/// The arc that touches both sides of `corner`, whose neighbours are `before` and `after`.
void addArc(Outline& outline, glm::dvec2 before, const Corner& corner, glm::dvec2 after, double arcStep) {
  const glm::dvec2 at(corner.x, corner.y), in = glm::normalize(at - before), out = glm::normalize(after - at);
  const double cosine = std::clamp(glm::dot(in, out), -0.9999, 1.0), angle = std::acos(cosine);
  if (angle < 1e-6) {
    outline.points.push_back({at, rightOf(in)});
    return;
  }
  const double shorter = std::min(glm::length(at - before), glm::length(after - at));
  const double tangentOfHalf = std::sqrt((1 - cosine) / (1 + cosine));
  const double cut = std::clamp(corner.radius * tangentOfHalf, kSharpest * shorter, kRoundest * shorter);
  const double side = in.x * out.y - in.y * out.x > 0 ? 1 : -1;  // 1: it turns left and bulges to the right
  const double radius = cut / tangentOfHalf;
  const glm::dvec2 center = at - cut * in - side * radius * rightOf(in);
  const int steps = std::max(1, static_cast<int>(std::ceil(angle / arcStep)));
  for (int k = 0; k <= steps; ++k) {
    const glm::dvec2 normal = between(rightOf(in), rightOf(out), angle, static_cast<double>(k) / steps);
    outline.points.push_back({center + side * radius * normal, normal});
  }
}

glm::dvec2 positionOf(const Corner& corner) { return {corner.x, corner.y}; }

}  // namespace

Outline roundCorners(const std::vector<Corner>& corners, bool isClosed, double arcStep) {
  Outline outline;
  outline.isClosed = isClosed;
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool isEnd = !isClosed && (i == 0 || i + 1 == n);
    if (isEnd) {
      const glm::dvec2 from = positionOf(corners[i == 0 ? 0 : i - 1]),
                       to = positionOf(corners[i == 0 ? 1 : i]);
      outline.points.push_back({positionOf(corners[i]), rightOf(glm::normalize(to - from))});
    } else {
      addArc(outline, positionOf(corners[(i + n - 1) % n]), corners[i], positionOf(corners[(i + 1) % n]),
             arcStep);
    }
  }
  return outline;
}

std::vector<Corner> withRadius(const std::vector<glm::dvec2>& points, double radius) {
  std::vector<Corner> corners;
  corners.reserve(points.size());
  for (const glm::dvec2& p : points) corners.push_back({p.x, p.y, radius});
  return corners;
}

Outline circleOutline(double radius, int segments, glm::dvec2 center) {
  Outline outline;
  for (int i = 0; i < segments; ++i) {
    const glm::dvec2 n = onCircle(i, segments);
    outline.points.push_back({center + radius * n, n});
  }
  return outline;
}

Outline rectangleOutline(glm::dvec2 low, glm::dvec2 high, double radius, double arcStep) {
  return roundCorners(withRadius({low, {high.x, low.y}, high, {low.x, high.y}}, radius), true, arcStep);
}

Outline hullOutline(const Circle& a, const Circle& b, double arcStep) {
  const glm::dvec2 along = glm::normalize(b.center - a.center), right = rightOf(along);
  // Both tangents touch where the normal leans by this angle from `right` towards b.
  const double lean = std::asin((a.radius - b.radius) / glm::distance(a.center, b.center));
  Outline outline;
  const auto addArcOf = [&](const Circle& circle, double from, double to) {
    const int steps = std::max(2, static_cast<int>(std::ceil((to - from) / arcStep)));
    for (int k = 0; k <= steps; ++k) {
      const double angle = from + (to - from) * k / steps;
      const glm::dvec2 normal = std::cos(angle) * right + std::sin(angle) * along;
      outline.points.push_back({circle.center + circle.radius * normal, normal});
    }
  };
  addArcOf(b, lean, std::numbers::pi - lean);
  addArcOf(a, std::numbers::pi - lean, 2 * std::numbers::pi + lean);
  return outline;
}

Outline reversed(Outline outline) {
  std::reverse(outline.points.begin(), outline.points.end());
  for (OutlinePoint& point : outline.points) point.normal = -point.normal;
  return outline;
}

std::vector<glm::dvec2> inset(const Outline& outline, double distance) {
  std::vector<glm::dvec2> positions;
  positions.reserve(outline.points.size());
  for (const OutlinePoint& point : outline.points)
    positions.push_back(point.position - distance * point.normal);
  return positions;
}

}  // namespace generator
