// Tangents for meshes that have none (glTF 2.0, 3.7.2.1 asks for ones in the manner of MikkTSpace; Lengyel
// 2001). Per triangle dP/du; per vertex the angle-weighted mean. A vertex between triangles whose texture is
// mirrored with respect to each other becomes two, so that their tangents do not cancel.
#include <cmath>

#include "gltf/mesh.h"

namespace whittle::gltf {

namespace {

struct TriangleFrame {
  glm::dvec3 tangent{0.0};  ///< unit, mesh space; zero where the coordinates do not span the triangle
  bool isMirrored = false;  ///< the image shows mirrored on the triangle's front
};

glm::dvec2 transformed(const glm::vec2& uv, const TextureSlot& slot) {
  const auto& t = slot.transform;
  return {static_cast<double>(t[0]) * uv.x + static_cast<double>(t[1]) * uv.y + t[2],
          static_cast<double>(t[3]) * uv.x + static_cast<double>(t[4]) * uv.y + t[5]};
}

glm::dvec3 unitOrZero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0.0 && std::isfinite(length) ? v / length : glm::dvec3(0.0);
}

TriangleFrame frameOf(const LocalMesh& mesh, const glm::uvec3& t, const TextureSlot& slot) {
  const auto& uv = mesh.uv[slot.uvSet];
  const glm::dvec3 e1 = glm::dvec3(mesh.positions[t[1]]) - glm::dvec3(mesh.positions[t[0]]);
  const glm::dvec3 e2 = glm::dvec3(mesh.positions[t[2]]) - glm::dvec3(mesh.positions[t[0]]);
  const glm::dvec2 d1 = transformed(uv[t[1]], slot) - transformed(uv[t[0]], slot);
  const glm::dvec2 d2 = transformed(uv[t[2]], slot) - transformed(uv[t[0]], slot);
  const double determinant = d1.x * d2.y - d2.x * d1.y;
  if (determinant == 0.0 || !std::isfinite(determinant)) return {};
  // Normal maps have +Y up, but v points down: an image seen the right way round has
  // coordinates that run clockwise.
  return {unitOrZero((e1 * d2.y - e2 * d1.y) / determinant), determinant > 0.0};
}

double angleAt(const LocalMesh& mesh, const glm::uvec3& t, int corner) {
  const glm::dvec3 p(mesh.positions[t[corner]]);
  const glm::dvec3 a = unitOrZero(glm::dvec3(mesh.positions[t[(corner + 1) % 3]]) - p);
  const glm::dvec3 b = unitOrZero(glm::dvec3(mesh.positions[t[(corner + 2) % 3]]) - p);
  return std::acos(glm::clamp(glm::dot(a, b), -1.0, 1.0));
}

/// Gives each vertex one handedness: 0 none yet, 1 as seen, -1 mirrored. Triangles
/// of the other kind get copies.
std::vector<int> splitByHandedness(LocalMesh& mesh, const std::vector<TriangleFrame>& frames) {
  std::vector<int> hand(mesh.positions.size(), 0);
  std::vector<std::uint32_t> twin(mesh.positions.size(), 0);  // 0: none; a copy never has index 0
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].tangent == glm::dvec3(0.0)) continue;
    const int wanted = frames[i].isMirrored ? -1 : 1;
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = mesh.triangles[i][c];
      if (hand[v] == 0) hand[v] = wanted;
      if (hand[v] == wanted) continue;
      if (twin[v] == 0) {
        twin[v] = duplicateVertex(mesh, v);
        hand.push_back(wanted);
        twin.push_back(0);
      }
      mesh.triangles[i][c] = twin[v];
    }
  }
  return hand;
}

}  // namespace

void generateTangents(LocalMesh& mesh, const TextureSlot& slot) {
  if (mesh.uv[slot.uvSet].empty()) return;
  std::vector<TriangleFrame> frames;
  frames.reserve(mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) frames.push_back(frameOf(mesh, t, slot));
  const std::vector<int> hand = splitByHandedness(mesh, frames);

  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      sums[mesh.triangles[i][c]] += frames[i].tangent * angleAt(mesh, mesh.triangles[i], c);
    }
  }
  mesh.tangents.resize(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const glm::dvec3 n = mesh.normals.empty() ? glm::dvec3(0.0) : unitOrZero(glm::dvec3(mesh.normals[i]));
    const glm::dvec3 tangent = unitOrZero(sums[i] - n * glm::dot(n, sums[i]));
    mesh.tangents[i] = glm::vec4(glm::vec3(tangent), hand[i] < 0 ? -1.0F : 1.0F);
  }
}

}  // namespace whittle::gltf
