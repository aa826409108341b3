// Catmull–Clark. Additions, multiplications and divisions alone: the same bits on every machine.
#include "shapes/subdivision.h"

#include <map>

namespace generator {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edgeOf(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

struct EdgeFaces {
  std::vector<std::uint32_t> faces;  // one on the border, else two
  std::uint32_t point = 0;           // its index among the new points
};

/// What the rule of a vertex sums up.
struct VertexSums {
  glm::dvec3 faces{0}, edges{0}, border{0};
  int faceCount = 0, edgeCount = 0, borderCount = 0;
};

glm::dvec3 center(const Cage& cage, const std::array<std::uint32_t, 4>& quad) {
  glm::dvec3 sum(0);
  for (const std::uint32_t corner : quad) sum += cage.points[corner];
  return 0.25 * sum;
}

std::map<Edge, EdgeFaces> edgesOf(const Cage& cage) {
  std::map<Edge, EdgeFaces> edges;
  for (std::uint32_t f = 0; f < cage.quads.size(); ++f) {
    for (std::size_t k = 0; k < 4; ++k)
      edges[edgeOf(cage.quads[f][k], cage.quads[f][(k + 1) % 4])].faces.push_back(f);
  }
  return edges;
}

/// As many as the points of `subdivided(cage)`, in their order: vertices, faces, edges.
std::vector<glm::dvec2> subdividedUv(const Cage& cage, const std::map<Edge, EdgeFaces>& edges) {
  if (cage.uv.empty()) return {};
  std::vector<glm::dvec2> uv = cage.uv;
  for (const auto& [a, b, c, d] : cage.quads)
    uv.push_back(0.25 * (cage.uv[a] + cage.uv[b] + cage.uv[c] + cage.uv[d]));
  for (const auto& [edge, faces] : edges) uv.push_back(0.5 * (cage.uv[edge.first] + cage.uv[edge.second]));
  return uv;
}

/// Where u grows, across each normal, and on which side v does.
void addTangents(Mesh& mesh, const Cage& cage) {
  std::vector<glm::dvec3> alongU(cage.points.size(), glm::dvec3(0)), alongV = alongU;
  for (const auto& quad : cage.quads) {
    const auto [a, b, c, d] = quad;
    // Over the diagonals: p = p0 + u·U + v·V, solved for U and V without the common factor's size.
    const glm::dvec3 p = cage.points[c] - cage.points[a], q = cage.points[d] - cage.points[b];
    const glm::dvec2 s = cage.uv[c] - cage.uv[a], t = cage.uv[d] - cage.uv[b];
    const double sign = s.x * t.y - s.y * t.x < 0 ? -1 : 1;
    for (const std::uint32_t corner : quad) {
      alongU[corner] += sign * (t.y * p - s.y * q);
      alongV[corner] += sign * (s.x * q - t.x * p);
    }
  }
  for (std::size_t i = 0; i < cage.points.size(); ++i) {
    const glm::dvec3 n(mesh.normals[i]), t = glm::normalize(alongU[i] - glm::dot(n, alongU[i]) * n);
    const bool isUpFalling = glm::dot(glm::cross(n, t), alongV[i]) < 0;
    mesh.tangents.emplace_back(glm::vec3(t), isUpFalling ? 1.0F : -1.0F);
    mesh.uv0.emplace_back(cage.uv[i]);
  }
}

glm::dvec3 vertexPoint(glm::dvec3 old, const VertexSums& sums) {
  if (sums.borderCount > 0) return sums.faceCount == 1 ? old : 0.75 * old + 0.125 * sums.border;
  const double n = sums.faceCount;
  return (sums.faces / n + 2.0 * (sums.edges / n) + (n - 3) * old) / n;
}

}  // namespace

Cage makeGrid(int rows, int columns, std::vector<glm::dvec3> points) {
  Cage cage;
  cage.points = std::move(points);
  const auto stride = static_cast<std::uint32_t>(columns) + 1;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column)
      cage.uv.emplace_back(static_cast<double>(column) / columns, static_cast<double>(row) / rows);
  }
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row) {
    for (std::uint32_t column = 0; column + 1 < stride; ++column) {
      const std::uint32_t a = row * stride + column, b = a + stride;
      cage.quads.push_back({a, b, b + 1, a + 1});
    }
  }
  return cage;
}

Cage makeBoxCage(glm::dvec3 low, glm::dvec3 high, glm::ivec3 cells) {
  Cage cage;
  std::map<std::array<int, 3>, std::uint32_t> found;
  const auto point = [&](glm::ivec3 at) {
    const auto [place, isNew] =
        found.try_emplace({at.x, at.y, at.z}, static_cast<std::uint32_t>(cage.points.size()));
    if (isNew) cage.points.push_back(low + (high - low) * (glm::dvec3(at) / glm::dvec3(cells)));
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int side : {0, 1}) {
      for (int i = 0; i < cells[u]; ++i) {
        for (int j = 0; j < cells[v]; ++j) {
          glm::ivec3 corner(0), du(0), dv(0);
          corner[axis] = side * cells[axis];
          corner[u] = i;
          corner[v] = j;
          du[u] = dv[v] = 1;
          if (side == 0) std::swap(du, dv);
          cage.quads.push_back(
              {point(corner), point(corner + du), point(corner + du + dv), point(corner + dv)});
        }
      }
    }
  }
  return cage;
}

Cage subdivided(const Cage& cage) {
  // New points: the vertices, then the centres of faces, then the edges.
  Cage finer;
  finer.points.resize(cage.points.size());
  const auto firstFace = static_cast<std::uint32_t>(finer.points.size());
  std::vector<VertexSums> sums(cage.points.size());
  for (const auto& quad : cage.quads) {
    const glm::dvec3 middle = center(cage, quad);
    finer.points.push_back(middle);
    for (const std::uint32_t corner : quad) {
      sums[corner].faces += middle;
      ++sums[corner].faceCount;
    }
  }
  std::map<Edge, EdgeFaces> edges = edgesOf(cage);
  for (auto& [edge, faces] : edges) {
    const glm::dvec3 a = cage.points[edge.first], b = cage.points[edge.second];
    const bool isBorder = faces.faces.size() == 1;
    faces.point = static_cast<std::uint32_t>(finer.points.size());
    finer.points.push_back(isBorder ? 0.5 * (a + b)
                                    : 0.25 * (a + b + finer.points[firstFace + faces.faces[0]] +
                                              finer.points[firstFace + faces.faces[1]]));
    for (const auto& [end, other] : {std::pair(edge.first, b), std::pair(edge.second, a)}) {
      sums[end].edges += 0.5 * (a + b);
      if (!isBorder) continue;
      sums[end].border += other;
      ++sums[end].borderCount;
    }
  }
  for (std::size_t i = 0; i < cage.points.size(); ++i) finer.points[i] = vertexPoint(cage.points[i], sums[i]);
  finer.uv = subdividedUv(cage, edges);
  for (std::uint32_t f = 0; f < cage.quads.size(); ++f) {
    const auto& quad = cage.quads[f];
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t next = edges[edgeOf(quad[k], quad[(k + 1) % 4])].point;
      const std::uint32_t before = edges[edgeOf(quad[(k + 3) % 4], quad[k])].point;
      finer.quads.push_back({quad[k], next, firstFace + f, before});
    }
  }
  return finer;
}

Mesh meshOf(const Cage& cage) {
  Mesh mesh;
  std::vector<glm::dvec3> normals(cage.points.size(), glm::dvec3(0));
  for (const auto& [a, b, c, d] : cage.quads) {
    const auto& p = cage.points;
    const glm::dvec3 normal = glm::cross(p[c] - p[a], p[d] - p[b]);
    for (const std::uint32_t corner : {a, b, c, d}) normals[corner] += normal;
    mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
  }
  for (const glm::dvec3& p : cage.points) mesh.positions.emplace_back(p);
  for (const glm::dvec3& n : normals) mesh.normals.emplace_back(glm::normalize(n));
  if (!cage.uv.empty()) addTangents(mesh, cage);
  return mesh;
}

}  // namespace generator
