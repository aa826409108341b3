// Sweeps: a section drawn along a path. Wires, handles, springs, the links of a chain.
#pragma once

#include "mesh.h"
#include "shapes/outline.h"

namespace generator {

/// The section's x and y are across the path; it runs counter-clockwise seen against the way of the path.
struct SweepSpec {
  std::vector<glm::dvec3> path;  ///< a closed one does not repeat its first point
  bool isClosed = false;
  Outline section{};
  std::vector<double> scale{};  ///< of the section at each point of the path; empty: 1
  double capLength = 0;         ///< ends are half ellipsoids that reach this far, times the scale; 0: flat
  glm::dvec3 across{0, 0, 0};   ///< where the section's x points at the start; 0: anywhere
  double textureLength = 1;     ///< metres of path that a texture covers; around the section it is laid once
};

/// Closed at both ends, or a ring. Normals leave out the slope of a section that grows.
Mesh makeSweep(const SweepSpec& spec);

/// A wire: a round section with round ends.
Mesh makeWire(const std::vector<glm::dvec3>& path, double radius, int segments = 12);

/// Points of a smooth path through `points` (Catmull and Rom 1974), `steps` for each pair of neighbours.
std::vector<glm::dvec3> smoothPath(const std::vector<glm::dvec3>& points, int steps, bool isClosed = false);

}  // namespace generator
