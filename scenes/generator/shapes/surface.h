// Surfaces that a formula gives: cloth in folds, leaves, loaves, spoons.
#pragma once

#include <functional>

#include "mesh.h"

namespace generator {

/// A function of the unit square on a grid of `columns` × `rows` squares. The front is where the way along u,
/// crossed with the way along v, points. Where u runs around (`isRound`), u = 0 and u = 1 are the same
/// points; a row that is a single point closes an end.
struct SurfaceSpec {
  int columns = 64, rows = 32;
  bool isRound = false;
  std::function<glm::dvec3(glm::dvec2 uv)>
      position;                                      ///< any unit; u may lie a hair beyond [0, 1], v does not
  std::function<glm::dvec3(glm::dvec2 uv)> color{};  ///< linear reflectance as vertex colour; empty: none
  glm::dvec2 repeat{1, 1};                           ///< uv0 runs to it
};

/// Normals are those of the function, not of the triangles, and tangents go along u.
Mesh makeSurface(const SurfaceSpec& spec);

}  // namespace generator
