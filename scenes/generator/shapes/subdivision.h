// Subdivision surfaces: smooth bodies out of a few quads.
#pragma once

#include <array>

#include "mesh.h"

namespace generator {

/// Points and quads, counter-clockwise from the front. Closed, or with a border.
struct Cage {
  std::vector<glm::dvec3> points;
  std::vector<glm::dvec2> uv;  ///< empty, or one for each point: a surface without a seam
  std::vector<std::array<std::uint32_t, 4>> quads;
};

/// Rows × columns quads over `points`, which are (rows + 1) × (columns + 1), row after row. The front is
/// where the way along a row, crossed with the way to the row before, points. uv is the unit square.
Cage makeGrid(int rows, int columns, std::vector<glm::dvec3> points);

/// The surface of a box with `cells` quads along each axis.
Cage makeBoxCage(glm::dvec3 low, glm::dvec3 high, glm::ivec3 cells);

/// One step of Catmull and Clark (1978): four quads for each. Borders become cubic B-splines
/// (DeRose, Kass and Truong 1998); corners that belong to one quad stay where they are. uv is interpolated.
Cage subdivided(const Cage& cage);

/// Triangles with normals that are weighted by area, and tangents where the cage has uv.
Mesh meshOf(const Cage& cage);

}  // namespace generator
