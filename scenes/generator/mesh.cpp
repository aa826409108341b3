// Shapes. Computed in double and rounded once, so that the bytes do not hang on the last bit of sin and cos.
#include "mesh.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace generator {

using std::numbers::pi;

namespace {

void addTriangles(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  for (const std::uint32_t i : {a, b, c, a, c, d}) mesh.indices.push_back(i);
}

}  // namespace

glm::dvec2 onCircle(int i, int n) {
  const int quarter = (4 * i) / n;
  if (4 * i == quarter * n) {
    constexpr std::array<glm::dvec2, 4> kQuarters{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    return kQuarters[static_cast<std::size_t>(quarter % 4)];
  }
  const double angle = 2 * pi * i / n;
  return {std::cos(angle), std::sin(angle)};
}

void addQuad(Mesh& mesh, glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v, glm::dvec2 repeat) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const glm::vec3 normal(glm::normalize(glm::cross(u, v)));
  const glm::vec3 tangent(glm::normalize(u));
  for (const glm::dvec2 at : {glm::dvec2{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    mesh.positions.emplace_back(corner + at.x * u + at.y * v);
    mesh.normals.push_back(normal);
    mesh.uv0.emplace_back(at.x * repeat.x, (1 - at.y) * repeat.y);
    // w = +1: glTF's bitangent n × t points along v, the way the picture's up goes (uv.y falls).
    mesh.tangents.emplace_back(tangent, 1.0F);
  }
  addTriangles(mesh, first, first + 1, first + 2, first + 3);
}

Mesh makeQuad(glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v, glm::dvec2 repeat) {
  Mesh mesh;
  addQuad(mesh, corner, u, v, repeat);
  return mesh;
}

void addBox(Mesh& mesh, glm::dvec3 low, glm::dvec3 high) {
  const glm::dvec3 d = high - low;
  const glm::dvec3 x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  addQuad(mesh, low + z, x, y);       // +Z
  addQuad(mesh, low + x, -x, y);      // -Z
  addQuad(mesh, high - y, -z, y);     // +X
  addQuad(mesh, low, z, y);           // -X
  addQuad(mesh, low + y + z, x, -z);  // +Y
  addQuad(mesh, low, x, z);           // -Y
}

Mesh makeSphere(double radius, int segments, int rings) {
  Mesh mesh;
  for (int j = 0; j <= rings; ++j) {
    const glm::dvec2 polar = onCircle(j, 2 * rings);
    for (int i = 0; i <= segments; ++i) {
      const glm::dvec2 around = onCircle(i, segments);
      const glm::dvec3 n(around.x * polar.y, polar.x, -around.y * polar.y);
      mesh.normals.emplace_back(n);
      mesh.positions.emplace_back(n * radius);
    }
  }
  const auto stride = static_cast<std::uint32_t>(segments) + 1;
  for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(rings); ++j) {
    for (std::uint32_t i = 0; i + 1 < stride; ++i) {
      const std::uint32_t a = j * stride + i, b = a + stride;
      if (j + 1 < static_cast<std::uint32_t>(rings)) mesh.indices.insert(mesh.indices.end(), {a, b, b + 1});
      if (j > 0) mesh.indices.insert(mesh.indices.end(), {a, b + 1, a + 1});
    }
  }
  return mesh;
}

Mesh makeUnitSphere() { return makeSphere(1, 96, 48); }

Mesh makeCylinder(double radius, double height, int segments) {
  Mesh mesh;
  for (int i = 0; i <= segments; ++i) {
    const glm::dvec2 c = onCircle(i, segments);
    const glm::dvec3 n(c.x, 0, -c.y);
    for (const double y : {0.0, height}) {
      mesh.normals.emplace_back(n);
      mesh.positions.emplace_back(n * radius + glm::dvec3(0, y, 0));
    }
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(segments); ++i) {
    addTriangles(mesh, 2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1);
  }
  return mesh;
}

Mesh makeTorus(double radius, double tubeRadius, int segments, int tubeSegments) {
  Mesh mesh;
  for (int i = 0; i <= segments; ++i) {
    const glm::dvec2 around = onCircle(i, segments);
    for (int k = 0; k <= tubeSegments; ++k) {
      const glm::dvec2 tube = onCircle(k, tubeSegments);
      const glm::dvec3 outward(around, 0), n = tube.x * outward + glm::dvec3(0, 0, tube.y);
      mesh.normals.emplace_back(n);
      mesh.positions.emplace_back(radius * outward + tubeRadius * n);
    }
  }
  const auto stride = static_cast<std::uint32_t>(tubeSegments) + 1;
  for (std::uint32_t a = 0; a + stride + 1 < mesh.positions.size(); ++a) {
    if ((a + 1) % stride != 0) addTriangles(mesh, a, a + stride, a + stride + 1, a + 1);
  }
  return mesh;
}

Mesh makeCheckers(int rows, int columns, double side, int parity) {
  Mesh mesh;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      if ((row + column) % 2 != parity) continue;
      const glm::dvec3 corner((column - 0.5 * columns) * side, 0, (0.5 * rows - row) * side);
      addQuad(mesh, corner, {side, 0, 0}, {0, 0, -side});
    }
  }
  mesh.uv0.clear();
  mesh.tangents.clear();
  return mesh;
}

void append(Mesh& mesh, const Mesh& more) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add(mesh.positions, more.positions);
  add(mesh.normals, more.normals);
  add(mesh.tangents, more.tangents);
  add(mesh.uv0, more.uv0);
  add(mesh.uv1, more.uv1);
  add(mesh.colors, more.colors);
  for (const std::uint32_t index : more.indices) mesh.indices.push_back(first + index);
}

Mesh moved(Mesh mesh, const glm::dmat4& matrix) {
  const glm::dmat3 turn(matrix);
  for (glm::vec3& p : mesh.positions) p = glm::vec3(matrix * glm::dvec4(p, 1));
  for (glm::vec3& n : mesh.normals) n = glm::vec3(glm::normalize(turn * glm::dvec3(n)));
  for (glm::vec4& t : mesh.tangents) t = glm::vec4(glm::vec3(glm::normalize(turn * glm::dvec3(t))), t.w);
  return mesh;
}

Mesh untextured(Mesh mesh) {
  mesh.uv0.clear();
  mesh.uv1.clear();
  mesh.tangents.clear();
  return mesh;
}

Mesh insideOut(Mesh mesh) {
  for (glm::vec3& n : mesh.normals) n = -n;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  return mesh;
}

}  // namespace generator
