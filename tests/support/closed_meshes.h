// Closed surfaces of random kind, size and place, with points that lie inside: a ray from one of those meets
// the surface, whatever its direction. Computed in double and rounded once; vertices are shared, so rounding
// moves them and opens nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "support/random_scenes.h"

namespace whittle::test {

struct ClosedMesh {
  std::string name;
  TriangleMesh mesh;
  std::vector<glm::vec3> inside;
};

/// A surface about the origin, 1 in size, before it is placed.
struct Surface {
  std::vector<glm::dvec3> positions;
  std::vector<glm::uvec3> triangles;
  std::vector<glm::dvec3> inside;
};

/// Every triangle becomes four; new vertices are shared with the neighbour.
inline void subdivide(Surface& s) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, isNew] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(s.positions.size()));
    if (isNew) s.positions.push_back(0.5 * (s.positions[a] + s.positions[b]));
    return at->second;
  };
  std::vector<glm::uvec3> out;
  for (const glm::uvec3 t : s.triangles) {
    const std::uint32_t ab = middle(t.x, t.y), bc = middle(t.y, t.z), ca = middle(t.z, t.x);
    out.insert(out.end(), {{t.x, ab, ca}, {ab, t.y, bc}, {ca, bc, t.z}, {ab, bc, ca}});
  }
  s.triangles = std::move(out);
}

/// The cube [-1, 1]³, six faces of 2 · 4^levels triangles.
inline Surface cube(int levels) {
  Surface s;
  for (int i = 0; i < 8; ++i) s.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& f : kFaces) {
    s.triangles.emplace_back(f[0], f[1], f[2]);
    s.triangles.emplace_back(f[0], f[2], f[3]);
  }
  for (int i = 0; i < levels; ++i) subdivide(s);
  return s;
}

/// An icosahedron's triangles divided `levels` times and pushed out to the unit sphere.
inline Surface icosphere(int levels) {
  Surface s;
  const double g = std::numbers::phi;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-g, g}) s.positions.insert(s.positions.end(), {{a, b, 0}, {0, a, b}, {b, 0, a}});
  // The faces of a regular solid: every three corners that are neighbours (2 apart) of each other.
  const auto near = [&](std::uint32_t i, std::uint32_t k) {
    return glm::distance(s.positions[i], s.positions[k]) < 2.1;
  };
  for (std::uint32_t i = 0; i < 12; ++i)
    for (std::uint32_t k = i + 1; k < 12; ++k)
      for (std::uint32_t m = k + 1; m < 12; ++m)
        if (near(i, k) && near(k, m) && near(m, i)) s.triangles.emplace_back(i, k, m);
  for (int i = 0; i < levels; ++i) subdivide(s);
  for (glm::dvec3& p : s.positions) p = glm::normalize(p);
  return s;
}

/// A ring of radius 1 whose tube is 0.3 thick.
inline Surface torus(std::uint32_t around, std::uint32_t along) {
  Surface s;
  const auto circle = [](std::uint32_t i, std::uint32_t n) {
    const double angle = 2 * std::numbers::pi * i / n;
    return glm::dvec2(std::cos(angle), std::sin(angle));
  };
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t k = 0; k < along; ++k) {
      const glm::dvec2 a = circle(i, around), t = circle(k, along);
      s.positions.emplace_back((1 + 0.3 * t.x) * a, 0.3 * t.y);
      const std::uint32_t i1 = (i + 1) % around, k1 = (k + 1) % along;
      const std::uint32_t p = i * along + k, q = i1 * along + k, r = i1 * along + k1, o = i * along + k1;
      s.triangles.emplace_back(p, q, r);
      s.triangles.emplace_back(p, r, o);
    }
  }
  return s;
}

/// Splits a triangle in three about a point near one of its corners, one of the three again, and so on: from
/// the size of the surface down to 1e-5 of it within a few triangles. Edges keep their neighbours.
inline void refineTowardsCorner(Surface& s, Rng& rng) {
  std::size_t at = rng.bits() % s.triangles.size();
  const int corner = static_cast<int>(rng.bits() % 3);
  const double far = 0.1 + 0.4 * static_cast<double>(rng.unit());
  const double smallest = std::pow(10.0, -1 - 4 * static_cast<double>(rng.unit()));
  for (double size = 1; size > smallest; size *= far) {
    const glm::uvec3 t = s.triangles[at];
    const std::uint32_t a = t[corner], b = t[(corner + 1) % 3], c = t[(corner + 2) % 3];
    const double towardsB = far * (0.2 + 0.6 * static_cast<double>(rng.unit()));
    const auto p = static_cast<std::uint32_t>(s.positions.size());
    s.positions.push_back((1 - far) * s.positions[a] + towardsB * s.positions[b] +
                          (far - towardsB) * s.positions[c]);
    s.triangles[at] = {p, b, c};
    s.triangles.emplace_back(a, p, c);
    glm::uvec3 next;
    next[corner] = a, next[(corner + 1) % 3] = b, next[(corner + 2) % 3] = p;
    s.triangles.push_back(next);
    at = s.triangles.size() - 1;
  }
}

/// Three different corners on one line, as the kernels see it: such a triangle is nowhere hit, and two
/// of its neighbours then meet the third along an edge that is not theirs. A surface with one of those
/// is not closed.
inline bool hasSeam(const TriangleMesh& mesh) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const glm::uvec3& t) {
    const glm::vec3 p0 = mesh.positions[t.x], p1 = mesh.positions[t.y], p2 = mesh.positions[t.z];
    if (p0 == p1 || p1 == p2 || p2 == p0) return false;
    const glm::dvec3 a(p1 - p0), b(p2 - p0);
    return a.y * b.z == a.z * b.y && a.z * b.x == a.x * b.z && a.x * b.y == a.y * b.x;
  });
}

/// Turned at random (every second one), scaled, and moved `radii` times its size away. Comes closer until no
/// triangle is rounded away.
inline ClosedMesh placed(const char* name, const Surface& s, double size, double radii, Rng& rng) {
  glm::dmat3 turn(1);
  if (rng.bits() & 1U) {
    turn[0] = glm::dvec3(rng.direction());
    turn[1] = glm::normalize(glm::cross(turn[0], glm::dvec3(rng.direction())));
    turn[2] = glm::cross(turn[0], turn[1]);
  }
  const glm::dvec3 away(rng.direction());
  ClosedMesh out{name, {}, {}};
  out.mesh.triangles = s.triangles;
  for (;; radii = radii < 1 ? 0 : radii / 8) {
    const auto place = [&](const std::vector<glm::dvec3>& from, std::vector<glm::vec3>& to) {
      to.clear();
      for (const glm::dvec3& p : from) to.emplace_back(size * (turn * p + radii * away));
    };
    place(s.positions, out.mesh.positions);
    place(s.inside, out.inside);
    if (radii == 0 || !hasSeam(out.mesh)) return out;
  }
}

/// A mesh of one of six kinds: sizes 1e-4 … 1e6 m, up to 1e5 times that away.
inline ClosedMesh closedMeshOfKind(std::uint64_t kind, Rng& rng) {
  const auto power = [&](float least, float most) {
    return static_cast<double>(std::pow(10.0F, rng.between(least, most)));
  };
  const double size = power(-4, 6), radii = rng.bits() % 4 == 0 ? 0.0 : power(-1, 5);
  const int levels = static_cast<int>(rng.bits() % 4);
  const auto fillInside = [&](Surface& s, double within) {
    for (int i = 0; i < 256; ++i) s.inside.emplace_back(within * glm::dvec3(rng.inBox(0.57F)));
  };
  const auto transform = [](Surface& s, const glm::dmat3& m) {
    for (glm::dvec3& p : s.positions) p = m * p;
    for (glm::dvec3& p : s.inside) p = m * p;
  };
  Surface s;
  switch (kind) {
    case 0:
      s = icosphere(levels);
      fillInside(s, 0.6);
      return placed("icosphere", s, size, radii, rng);
    case 1:
      s = cube(levels);
      fillInside(s, 1);
      return placed("box", s, size, radii, rng);
    case 2:
      s = torus(8 + static_cast<std::uint32_t>(rng.bits() % 24),
                6 + static_cast<std::uint32_t>(rng.bits() % 10));
      for (int i = 0; i < 256; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(rng.unit());
        s.inside.push_back(glm::dvec3(std::cos(angle), std::sin(angle), 0) + glm::dvec3(rng.inBox(0.05F)));
      }
      return placed("torus", s, size, radii, rng);
    case 3: {
      s = icosphere(levels);
      fillInside(s, 0.6);
      const auto shear = [&] { return static_cast<double>(rng.between(-3, 3)); };
      const double xy = shear(), xz = shear(), yz = shear();
      transform(s, glm::dmat3(1, 0, 0, xy, 1, 0, xz, yz, 1));
      return placed("sheared", s, size, std::min(radii, 1e4), rng);
    }
    case 4: {
      s = rng.bits() & 1U ? icosphere(levels) : cube(levels);
      fillInside(s, 0.6);
      glm::dmat3 squeeze(1);
      squeeze[static_cast<int>(rng.bits() % 3)] *= 1e-3;
      transform(s, squeeze);
      return placed("thin", s, size, std::min(radii, 1e2), rng);
    }
    default:
      s = rng.bits() & 1U ? icosphere(levels / 2) : cube(levels / 2);
      fillInside(s, 0.6);
      for (int i = 0; i < 24; ++i) refineTowardsCorner(s, rng);
      return placed("tiny and huge", s, size, std::min(radii, 1e3), rng);
  }
}

/// The `index`th mesh of a series: the kinds take turns. Those that rounding has torn even about the origin
/// are passed over.
inline ClosedMesh randomClosedMesh(std::uint64_t index) {
  for (std::uint64_t attempt = 0;; ++attempt) {
    Rng rng(0x9d5ab3 + index + (attempt << 40U));
    ClosedMesh mesh = closedMeshOfKind(index % 6, rng);
    if (!hasSeam(mesh.mesh)) return mesh;
  }
}

}  // namespace whittle::test
