// What the tests of shapes ask of a mesh. Positions are compared bit for bit: seams of texture coordinates
// have several vertices in one place.
#pragma once

#include <map>
#include <tuple>

#include "mesh.h"

namespace generator::test {

using Place = std::tuple<float, float, float>;

inline Place placeOf(const Mesh& mesh, std::uint32_t vertex) {
  const glm::vec3 p = mesh.positions[vertex] + 0.0F;  // -0 is 0
  return {p.x, p.y, p.z};
}

/// Edges that are not run along as often in one direction as in the other: 0 for a closed surface.
inline std::size_t openEdges(const Mesh& mesh) {
  std::map<std::pair<Place, Place>, int> balance;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Place a = placeOf(mesh, mesh.indices[i + k]), b = placeOf(mesh, mesh.indices[i + (k + 1) % 3]);
      if (a < b) ++balance[{a, b}];
      if (b < a) --balance[{b, a}];
    }
  }
  std::size_t open = 0;
  for (const auto& [edge, sum] : balance) open += sum != 0 ? 1 : 0;
  return open;
}

/// Above 0 where fronts look outwards.
inline double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
        c(mesh.positions[mesh.indices[i + 2]]);
    sum += glm::dot(a, glm::cross(b, c)) / 6;
  }
  return sum;
}

/// The share of corners whose normal has another length than 1 or looks to the back of its triangle.
inline double badNormals(const Mesh& mesh) {
  std::size_t bad = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
    const glm::dvec3 front = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 n(mesh.normals[mesh.indices[i + k]]);
      const bool isGood = std::abs(glm::length(n) - 1) < 1e-5 && glm::dot(n, front) > 0;
      bad += isGood ? 0 : 1;
    }
  }
  return static_cast<double>(bad) / static_cast<double>(mesh.indices.size());
}

}  // namespace generator::test
