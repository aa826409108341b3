// Tangents along a normal map. For meshes that have none (glTF 2.0, 3.7.2.1 asks for ones in the manner of
// MikkTSpace; Lengyel 2001): per triangle dP/du; per vertex the angle-weighted mean. A vertex between
// triangles whose texture is mirrored with respect to each other becomes two, so that their tangents do not
// cancel. For meshes that have some: the same, turned where KHR_texture_transform turns the image.
#include <cmath>

#include "gltf/mesh.h"

namespace whittle::gltf {

namespace {

/// dP/du and dP/dv of a triangle, mesh space; zero where the coordinates do not span it.
struct Derivatives {
  glm::dvec3 du{0.0}, dv{0.0};
  double area = 0.0;  ///< twice that of the triangle among the coordinates, positive counter-clockwise
};

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

/// `d1` and `d2`: the coordinates' steps along the first two edges from corner 0.
Derivatives derivativesOf(const LocalMesh& mesh, const glm::uvec3& t, const glm::dvec2& d1,
                          const glm::dvec2& d2) {
  const double area = d1.x * d2.y - d2.x * d1.y;
  if (area == 0.0 || !std::isfinite(area)) return {};
  const glm::dvec3 e1 = glm::dvec3(mesh.positions[t[1]]) - glm::dvec3(mesh.positions[t[0]]);
  const glm::dvec3 e2 = glm::dvec3(mesh.positions[t[2]]) - glm::dvec3(mesh.positions[t[0]]);
  return {(e1 * d2.y - e2 * d1.y) / area, (e2 * d1.x - e1 * d2.x) / area, area};
}

TriangleFrame frameOf(const LocalMesh& mesh, const glm::uvec3& t, const TextureSlot& slot) {
  const auto& uv = mesh.uv[slot.uvSet];
  const glm::dvec2 from = transformed(uv[t[0]], slot);
  const Derivatives d =
      derivativesOf(mesh, t, transformed(uv[t[1]], slot) - from, transformed(uv[t[2]], slot) - from);
  // Normal maps have +Y up, but v points down: an image seen the right way round has
  // coordinates that run clockwise.
  return {unitOrZero(d.du), d.area > 0.0};
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

/// Gives each triangle vertices of its own.
void separateTriangles(LocalMesh& mesh) {
  std::vector<bool> isTaken(mesh.positions.size(), false);
  for (glm::uvec3& t : mesh.triangles) {
    for (int c = 0; c < 3; ++c) {
      if (isTaken[t[c]]) {
        t[c] = duplicateVertex(mesh, t[c]);  // behind the others: no triangle meets it again
      } else {
        isTaken[t[c]] = true;
      }
    }
  }
}

/// How far one unit of u and one of v reach on the surface around each vertex, up to a common factor.
std::vector<glm::dvec2> stretches(const LocalMesh& mesh, const std::vector<glm::vec2>& uv) {
  std::vector<glm::dvec2> sums(mesh.positions.size(), glm::dvec2(0.0));
  if (!uv.empty()) {
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec2 from(uv[t[0]]);
      const Derivatives d = derivativesOf(mesh, t, glm::dvec2(uv[t[1]]) - from, glm::dvec2(uv[t[2]]) - from);
      const glm::dvec2 lengths(glm::length(d.du), glm::length(d.dv));
      for (int c = 0; c < 3; ++c) sums[t[c]] += lengths * angleAt(mesh, t, c);
    }
  }
  for (glm::dvec2& sum : sums) {
    if (!(sum.x > 0.0 && sum.y > 0.0 && std::isfinite(sum.x + sum.y))) sum = glm::dvec2(1.0);
  }
  return sums;
}

}  // namespace

void generateTangents(LocalMesh& mesh, const TextureSlot& slot) {
  if (mesh.uv[slot.uvSet].empty()) return;
  if (mesh.normals.empty()) separateTriangles(mesh);
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

void turnTangents(LocalMesh& mesh, const TextureSlot& slot) {
  const auto& t = slot.transform;
  if (t[1] == 0.0F && t[3] == 0.0F && t[0] > 0.0F && t[4] > 0.0F) return;
  const double t0 = t[0], t1 = t[1], t3 = t[3], t4 = t[4];
  const double determinant = t0 * t4 - t1 * t3;
  if (determinant == 0.0 || !std::isfinite(determinant)) return;
  // (u, v) is the inverse times (u', v'): dP/du' = (t4 dP/du - t3 dP/dv) / determinant. Of the derivatives
  // the tangent frame has the directions, the bitangent against dP/dv (v points down).
  const double sign = determinant < 0.0 ? -1.0 : 1.0;
  const std::vector<glm::dvec2> lengths = stretches(mesh, mesh.uv[slot.uvSet]);
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    glm::vec4& tangent = mesh.tangents[i];
    const double hand = tangent.w < 0.0F ? -1.0 : 1.0;
    const glm::dvec3 n = unitOrZero(glm::dvec3(mesh.normals[i]));
    const glm::dvec3 given(tangent);
    const glm::dvec3 T = unitOrZero(given - n * glm::dot(n, given));
    const glm::dvec3 B = hand * glm::cross(n, T);
    const glm::dvec3 turned = unitOrZero(sign * (t4 * lengths[i].x * T + t3 * lengths[i].y * B));
    tangent = glm::vec4(glm::vec3(turned), static_cast<float>(hand * sign));
  }
}

}  // namespace whittle::gltf
