// A grid of rings sewn into a surface: what lathe, sweep and the rim of a plate have in common.
#pragma once

#include "mesh.h"

namespace generator {

/// A vertex with all that skinned surfaces have.
struct SkinVertex {
  glm::dvec3 position, normal, tangent;
  glm::dvec2 uv;
};

void addVertex(Mesh& mesh, const SkinVertex& vertex);

/// Sews rings of `columns` vertices each, which were added one after another beginning with the vertex
/// `first`. Its front is where the way along a ring, crossed with the way to the next ring, points. Triangles
/// that a ring of one point would make degenerate are left out.
void sewRings(Mesh& mesh, std::uint32_t first, std::uint32_t rings, std::uint32_t columns);

}  // namespace generator
