// A small mesh with normals and coordinates, plain, for tests that pack it; and scenes as sets of triangles,
// since compressors keep neither the order of triangles nor their first corners.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "gltf/builder.h"
#include "support/mutation.h"

namespace whittle::test {

/// A bumpy height field of kSide × kSide vertices, 1 m wide.
struct Grid {
  static constexpr unsigned kSide = 17;
  static constexpr float kSpacing = 1.0F / (kSide - 1);
  std::vector<float> positions, normals, uv;
  std::vector<std::uint16_t> indices;

  std::size_t vertices() const { return positions.size() / 3; }
};

inline Grid makeGrid() {
  Grid g;
  for (unsigned y = 0; y < Grid::kSide; ++y)
    for (unsigned x = 0; x < Grid::kSide; ++x) {
      const float u = static_cast<float>(x) * Grid::kSpacing, v = static_cast<float>(y) * Grid::kSpacing;
      g.positions.insert(g.positions.end(), {u, v, 0.1F * std::sin(9 * u) * std::cos(7 * v)});
      const glm::vec3 n = glm::normalize(glm::vec3(std::sin(3 * u) - 0.7F, std::cos(5 * v), 0.4F + u));
      g.normals.insert(g.normals.end(), {n.x, n.y, n.z});
      g.uv.insert(g.uv.end(), {u, 1 - v});
    }
  const auto at = [](unsigned x, unsigned y) { return static_cast<std::uint16_t>(y * Grid::kSide + x); };
  for (unsigned y = 0; y + 1 < Grid::kSide; ++y)
    for (unsigned x = 0; x + 1 < Grid::kSide; ++x)
      g.indices.insert(g.indices.end(),
                       {at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
  return g;
}

/// A node with a primitive that names the accessors.
inline void addGridNode(GltfBuilder& b, Json attributes, int indices, Json further = Json::object()) {
  Json primitive{{"attributes", std::move(attributes)}, {"indices", indices}};
  primitive.merge_patch(further);
  b.node({{"mesh", b.mesh(primitive)}});
}

/// As it is, without compression.
inline GltfBuilder plainGrid(const Grid& g) {
  GltfBuilder b;
  addGridNode(b, {{"POSITION", b.vec3(g.positions)}, {"NORMAL", b.vec3(g.normals)}}, b.indices(g.indices));
  return b;
}

/// Position and normal of three corners, the least first.
using Corner = std::array<float, 6>;
using Corners = std::array<Corner, 3>;

inline std::vector<Corners> triangleSet(const Scene& scene) {
  std::vector<Corners> all;
  for (const Triangle& t : scene.triangles) {
    Corners corners{};
    const std::array<std::uint32_t, 3> v{t.v0, t.v1, t.v2};
    for (std::size_t c = 0; c < 3; ++c) {
      const glm::vec3 p = scene.positions[v[c]],
                      n = scene.normals.empty() ? glm::vec3(0) : scene.normals[v[c]];
      corners[c] = {p.x, p.y, p.z, n.x, n.y, n.z};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.push_back(corners);
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Loads what `b.json` says of its buffers as well.
inline Scene loadAsIs(GltfBuilder& b, const LoadOptions& options = {}) {
  const TemporaryFolder folder;
  b.notices = {};
  return loadGltf(folder.write("packed.glb", b.glbAsIs()), options, b.notices);
}

inline constexpr const char* kLoaded = "it was loaded";

/// The line that this ends in.
inline std::string errorAsIs(GltfBuilder& b, const LoadOptions& options = {}) {
  try {
    loadAsIs(b, options);
  } catch (const InputError& e) {
    const std::string line = e.what();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    return line;
  }
  return kLoaded;
}

/// Streams with bytes turned over, mostly in their first hundred, where counts stand: each loads or ends in a
/// line.
inline void loadMutated(const GltfBuilder& whole, unsigned seed) {
  std::mt19937 random(seed);
  std::size_t loaded = 0, refused = 0;
  for (int i = 0; i < mutations(); ++i) {
    GltfBuilder b = whole;
    for (unsigned changes = 1 + random() % 4; changes > 0; --changes) {
      const std::size_t reach =
          random() % 2 == 0 ? std::min<std::size_t>(100, b.binary.size()) : b.binary.size();
      char& byte = b.binary[random() % reach];
      byte = static_cast<char>(random() % 3 == 0 ? byte ^ (1 << random() % 8)
                                                 : static_cast<int>(random() & 0xff));
    }
    const std::string line = errorAsIs(b);
    ++(line == kLoaded ? loaded : refused);
  }
  EXPECT_GT(loaded + refused, 0U);
  EXPECT_GT(refused, 0U);
}

inline void expectMentions(const std::string& line, const std::string& part) {
  EXPECT_NE(line.find(part), std::string::npos) << line << "\n  lacks " << part;
}

}  // namespace whittle::test
