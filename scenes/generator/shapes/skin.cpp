// Two triangles for each square of a grid of vertices.
#include "shapes/skin.h"

namespace generator {

void addVertex(Mesh& mesh, const SkinVertex& vertex) {
  mesh.positions.emplace_back(vertex.position);
  mesh.normals.emplace_back(glm::normalize(vertex.normal));
  mesh.tangents.emplace_back(glm::vec3(glm::normalize(vertex.tangent)), 1.0F);
  mesh.uv0.emplace_back(vertex.uv);
}

void sewRings(Mesh& mesh, std::uint32_t first, std::uint32_t rings, std::uint32_t columns) {
  const auto add = [&mesh](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto& p = mesh.positions;
    if (p[a] != p[b] && p[b] != p[c] && p[c] != p[a]) mesh.indices.insert(mesh.indices.end(), {a, b, c});
  };
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
    for (std::uint32_t column = 0; column + 1 < columns; ++column) {
      const std::uint32_t a = first + ring * columns + column, b = a + columns;
      add(a, a + 1, b + 1);
      add(a, b + 1, b);
    }
  }
}

}  // namespace generator
