// Frames along the path turn no more than it bends: double reflection (Wang, Jüttler, Zheng and Liu 2008).
#include "shapes/sweep.h"

#include <algorithm>
#include <cmath>

#include "shapes/skin.h"

namespace generator {
namespace {

/// Axes of the section's plane; `along` is their cross product.
struct PathFrame {
  glm::dvec3 origin, x, y, along;
};

glm::dvec3 reflected(glm::dvec3 v, glm::dvec3 across) {
  const double square = glm::dot(across, across);
  return square > 0 ? v - 2 * glm::dot(v, across) / square * across : v;
}

glm::dvec3 anyPerpendicular(glm::dvec3 v) {
  const glm::dvec3 helper = std::abs(v.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  return glm::normalize(glm::cross(helper, v));
}

/// Turned by `angle` about the path.
PathFrame turned(const PathFrame& frame, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {frame.origin, c * frame.x + s * frame.y, c * frame.y - s * frame.x, frame.along};
}

PathFrame nextFrame(const PathFrame& frame, glm::dvec3 origin, glm::dvec3 along) {
  const glm::dvec3 step = origin - frame.origin;
  const glm::dvec3 x = reflected(frame.x, step), tangent = reflected(frame.along, step);
  const glm::dvec3 turnedX = reflected(x, along - tangent);
  const glm::dvec3 unitX = glm::normalize(turnedX - glm::dot(turnedX, along) * along);
  return {origin, unitX, glm::cross(along, unitX), along};
}

std::vector<PathFrame> framesAlong(const SweepSpec& spec) {
  const std::size_t n = spec.path.size();
  const auto tangentAt = [&](std::size_t i) {
    const std::size_t before = i > 0 ? i - 1 : spec.isClosed ? n - 1 : 0;
    const std::size_t after = i + 1 < n ? i + 1 : spec.isClosed ? 0 : n - 1;
    return glm::normalize(spec.path[after] - spec.path[before]);
  };
  const glm::dvec3 along = tangentAt(0);
  const glm::dvec3 flat = spec.across - glm::dot(spec.across, along) * along;
  const glm::dvec3 x = glm::dot(flat, flat) > 0 ? glm::normalize(flat) : anyPerpendicular(along);
  std::vector<PathFrame> frames{{spec.path[0], x, glm::cross(along, x), along}};
  for (std::size_t i = 1; i < n; ++i) frames.push_back(nextFrame(frames.back(), spec.path[i], tangentAt(i)));
  if (!spec.isClosed) return frames;
  // What the frame has turned on its way around is taken back evenly.
  const PathFrame back = nextFrame(frames.back(), spec.path[0], along);
  const double twist = std::atan2(glm::dot(frames[0].x, back.y), glm::dot(frames[0].x, back.x));
  for (std::size_t i = 0; i < n; ++i) {
    frames[i] = turned(frames[i], twist * static_cast<double>(i) / static_cast<double>(n));
  }
  frames.push_back(frames[0]);
  return frames;
}

/// A ring of the surface: the section in a frame, drawn in by `scale`, its normals leaned by (across, along).
struct Ring {
  PathFrame frame;
  double scale;
  glm::dvec2 lean;
  double v;
};

/// An end: a flat or half-round cap in five rings. `side`: 1 at the path's end, -1 at its start.
void addCap(std::vector<Ring>& rings, const Ring& edge, double capLength, double side) {
  constexpr int kSteps = 4;
  std::vector<Ring> cap;
  for (int k = 0; k <= kSteps; ++k) {
    const glm::dvec2 arc = onCircle(k, 4 * kSteps);
    Ring ring = edge;
    ring.lean = {arc.x, side * arc.y};
    ring.scale *= arc.x;
    ring.frame.origin += side * capLength * edge.scale * arc.y * edge.frame.along;
    if (capLength == 0) ring.lean = {0, side};
    cap.push_back(ring);
  }
  if (side < 0) std::reverse(cap.begin(), cap.end());
  rings.insert(rings.end(), cap.begin(), cap.end());
}

std::vector<Ring> ringsOf(const SweepSpec& spec) {
  const std::vector<PathFrame> frames = framesAlong(spec);
  std::vector<Ring> body, rings;
  double length = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (i > 0) length += glm::distance(frames[i].origin, frames[i - 1].origin);
    const double scale = spec.scale.empty() ? 1 : spec.scale[i % spec.scale.size()];
    body.push_back({frames[i], scale, {1, 0}, length / spec.textureLength});
  }
  if (!spec.isClosed) addCap(rings, body.front(), spec.capLength, -1);
  rings.insert(rings.end(), body.begin(), body.end());
  if (!spec.isClosed) addCap(rings, body.back(), spec.capLength, 1);
  return rings;
}

}  // namespace

Mesh makeSweep(const SweepSpec& spec) {
  const std::vector<Ring> rings = ringsOf(spec);
  const std::size_t count = spec.section.points.size();
  Mesh mesh;
  for (const Ring& ring : rings) {
    const PathFrame& f = ring.frame;
    for (std::size_t i = 0; i <= count; ++i) {
      const OutlinePoint& p = spec.section.points[i % count];
      const glm::dvec3 outward = p.normal.x * f.x + p.normal.y * f.y;
      addVertex(mesh, {.position = f.origin + ring.scale * (p.position.x * f.x + p.position.y * f.y),
                       .normal = ring.lean.x * outward + ring.lean.y * f.along,
                       .tangent = p.normal.x * f.y - p.normal.y * f.x,
                       .uv = {static_cast<double>(i) / static_cast<double>(count), -ring.v}});
    }
  }
  sewRings(mesh, 0, static_cast<std::uint32_t>(rings.size()), static_cast<std::uint32_t>(count) + 1);
  return mesh;
}

Mesh makeWire(const std::vector<glm::dvec3>& path, double radius, int segments) {
  SweepSpec spec;
  spec.path = path;
  spec.section = circleOutline(radius, segments);
  spec.capLength = radius;
  return makeSweep(spec);
}

std::vector<glm::dvec3> smoothPath(const std::vector<glm::dvec3>& points, int steps, bool isClosed) {
  const auto n = static_cast<std::ptrdiff_t>(points.size());
  const auto at = [&](std::ptrdiff_t i) {
    return points[static_cast<std::size_t>(isClosed ? (i + n) % n : std::clamp<std::ptrdiff_t>(i, 0, n - 1))];
  };
  std::vector<glm::dvec3> path;
  for (std::ptrdiff_t i = 0; i < (isClosed ? n : n - 1); ++i) {
    const glm::dvec3 a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
    for (int k = 0; k < steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      path.push_back(0.5 * (2.0 * b + t * (c - a) + t * t * (2.0 * a - 5.0 * b + 4.0 * c - d) +
                            t * t * t * (3.0 * b - a - 3.0 * c + d)));
    }
  }
  if (!isClosed) path.push_back(points.back());
  return path;
}

}  // namespace generator
