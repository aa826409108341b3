// Triangle soups for tests: positions and corner indices, the same on every run and platform for the same
// seed. Metres; counter-clockwise seen from outside where there is an outside.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

namespace whittle::test {

struct TriangleMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;

  void add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), {a, b, c});
    triangles.emplace_back(first, first + 1, first + 2);
  }
  void append(const TriangleMesh& other) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), other.positions.begin(), other.positions.end());
    for (const glm::uvec3& t : other.triangles) triangles.push_back(t + first);
  }
};

/// A small counter-based generator (splitmix64, Steele et al. 2014): <random>'s distributions
/// differ between libraries.
class Rng {
 public:
  explicit Rng(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }
  /// 0 ≤ u < 1, 24 bits.
  float unit() { return static_cast<float>(bits() >> 40) * 0x1p-24F; }
  float between(float lo, float hi) { return lo + (hi - lo) * unit(); }
  glm::vec3 inBox(float halfSide) {
    const float x = between(-halfSide, halfSide), y = between(-halfSide, halfSide);
    return {x, y, between(-halfSide, halfSide)};
  }
  /// Uniform on the unit sphere.
  glm::vec3 direction() {
    const float z = between(-1, 1), phi = between(0, 2 * std::numbers::pi_v<float>);
    const float r = std::sqrt(std::fmax(0.0F, 1 - z * z));
    return {r * std::cos(phi), r * std::sin(phi), z};
  }

 private:
  std::uint64_t state_;
};

/// `count` triangles of about `size` anywhere in [-1, 1]³.
inline TriangleMesh randomSoup(std::size_t count, float size, std::uint64_t seed) {
  Rng rng(seed);
  TriangleMesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 p = rng.inBox(1);
    const glm::vec3 a = p + rng.inBox(size), b = p + rng.inBox(size);
    mesh.add(p, a, b);
  }
  return mesh;
}

/// `count` slivers: up to `length` long in any direction, a hundredth of that wide.
inline TriangleMesh longThinTriangles(std::size_t count, float length, std::uint64_t seed) {
  Rng rng(seed);
  TriangleMesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 p = rng.inBox(1);
    const glm::vec3 along = rng.direction() * length * rng.unit();
    const glm::vec3 across = rng.direction() * (length * 0.01F);
    mesh.add(p, p + along, p + across);
  }
  return mesh;
}

/// A bumpy ground of 2·side² triangles over [-1, 1]² in x and z, facing +y, vertices shared.
inline TriangleMesh heightField(std::uint32_t side, std::uint64_t seed) {
  Rng rng(seed);
  TriangleMesh mesh;
  for (std::uint32_t j = 0; j <= side; ++j) {
    for (std::uint32_t i = 0; i <= side; ++i) {
      const float x = 2 * static_cast<float>(i) / static_cast<float>(side) - 1;
      const float z = 2 * static_cast<float>(j) / static_cast<float>(side) - 1;
      const float rough = rng.between(-0.5F, 0.5F) / static_cast<float>(side);
      mesh.positions.emplace_back(x, 0.2F * std::sin(5 * x) * std::cos(7 * z) + rough, z);
    }
  }
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i) {
      const std::uint32_t a = j * (side + 1) + i, b = a + 1, c = a + side + 1, d = c + 1;
      mesh.triangles.emplace_back(a, c, b);
      mesh.triangles.emplace_back(b, c, d);
    }
  }
  return mesh;
}

/// A closed sphere: `rings` bands of `sectors` quads (triangles at the poles), vertices shared, no cracks.
inline TriangleMesh closedSphere(const glm::vec3& centre, float radius, std::uint32_t rings,
                                 std::uint32_t sectors) {
  TriangleMesh mesh;
  mesh.positions.push_back(centre + glm::vec3{0, radius, 0});
  for (std::uint32_t j = 1; j < rings; ++j) {
    const float theta = std::numbers::pi_v<float> * static_cast<float>(j) / static_cast<float>(rings);
    for (std::uint32_t i = 0; i < sectors; ++i) {
      const float phi = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(sectors);
      mesh.positions.push_back(centre + radius * glm::vec3{std::sin(theta) * std::cos(phi), std::cos(theta),
                                                           -std::sin(theta) * std::sin(phi)});
    }
  }
  const auto south = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(centre - glm::vec3{0, radius, 0});
  for (std::uint32_t i = 0; i < sectors; ++i) {
    const std::uint32_t next = (i + 1) % sectors;
    mesh.triangles.emplace_back(0, 1 + i, 1 + next);
    for (std::uint32_t j = 0; j + 2 < rings; ++j) {
      const std::uint32_t a = 1 + j * sectors + i, b = 1 + j * sectors + next;
      mesh.triangles.emplace_back(a, a + sectors, b);
      mesh.triangles.emplace_back(b, a + sectors, b + sectors);
    }
    const std::uint32_t last = 1 + (rings - 2) * sectors;
    mesh.triangles.emplace_back(last + i, south, last + next);
  }
  return mesh;
}

}  // namespace whittle::test
