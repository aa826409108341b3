// Puts meshes into world space. Transforms are applied in double and rounded to float once. Normals go
// by the inverse transpose, taken as the cofactor matrix with the sign of the determinant, which
// exists for singular transforms too.
#include "gltf/bake.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "scene/free_array.h"

namespace whittle::gltf {

namespace {

/// What the tree can hold.
constexpr std::uint64_t kMostTriangles = std::uint64_t{1} << 27;
constexpr std::uint64_t kMostVertices = std::uint64_t{1} << 28;

constexpr double kLargestCoordinate = 1.8e18;  ///< above it squared distances overflow a float

/// A transform with what normals and windings need, computed once for each node (or skinned vertex).
struct VertexTransform {
  explicit VertexTransform(const glm::dmat4& m) : toWorld(m), linear(m) {
    double largest = 0.0;
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) largest = std::max(largest, std::abs(linear[c][r]));
    }
    // Only directions come out of `linear` and `cofactors`: scaled to about 1 they
    // neither overflow nor vanish.
    if (largest > 0.0 && std::isfinite(largest)) linear /= largest;
    const glm::dmat3& l = linear;
    cofactors = glm::dmat3(glm::cross(l[1], l[2]), glm::cross(l[2], l[0]), glm::cross(l[0], l[1]));
    const double determinant = glm::dot(l[0], cofactors[0]);
    const double volume = glm::length(l[0]) * glm::length(l[1]) * glm::length(l[2]);
    isSingular = !(std::abs(determinant) > 1e-14 * volume);  // below rounding of the products
    isMirrored = determinant < 0.0 && !isSingular;
    if (isMirrored) cofactors *= -1.0;
  }

  glm::dmat4 toWorld;
  glm::dmat3 linear;
  glm::dmat3 cofactors;
  bool isMirrored = false;
  bool isSingular = false;
};

/// Unit length, or zero where there is no direction.
glm::vec3 direction(const glm::dvec3& v) {
  const double length = glm::length(v);
  if (!(length > 0.0) || !std::isfinite(length)) return glm::vec3(0.0F);
  return glm::vec3(v / length);
}

glm::vec3 roundedOnce(const glm::dvec3& p) {
  glm::vec3 out;
  for (int i = 0; i < 3; ++i) {
    const bool fits = std::abs(p[i]) <= static_cast<double>(std::numeric_limits<float>::max());
    out[i] = fits ? static_cast<float>(p[i]) : std::numeric_limits<float>::infinity();
  }
  return out;
}

bool isTraceable(const glm::vec3& p) {
  // A comparison with NaN is false.
  return std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate &&
         std::abs(p.z) <= kLargestCoordinate;
}

/// Exactly zero, or two corners in the same place (which underflow could hide). Differences of floats and
/// their products are exact or nearly so in double.
bool hasNoArea(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  if (a == b || b == c || c == a) return true;
  const glm::dvec3 cross = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
  return cross == glm::dvec3(0.0);
}

/// Brings an optional array to `size` with what vertices have that have none.
template <class Vector>
void pad(std::vector<Vector>& array, std::size_t size, const Vector& absent) {
  if (!array.empty()) array.resize(size, absent);
}

constexpr std::uint32_t kUnused = 0xffffffffU;

/// For each vertex of `mesh`, where it goes among those that triangles use.
std::vector<std::uint32_t> usedVertices(const LocalMesh& mesh, std::uint32_t first) {
  std::vector<std::uint32_t> target(mesh.positions.size(), kUnused);
  for (const glm::uvec3& t : mesh.triangles) {
    for (int c = 0; c < 3; ++c) target[t[c]] = 0;
  }
  for (std::uint32_t& t : target) {
    if (t != kUnused) t = first++;
  }
  return target;
}

/// Copies the used elements of an attribute behind `array`, which starts to exist
/// with the first mesh that has it.
template <class Vector>
void append(std::vector<Vector>& array, const std::vector<Vector>& values,
            const std::vector<std::uint32_t>& target, std::size_t before, std::size_t after, std::size_t room,
            const Vector& absent) {
  if (values.empty()) return;
  array.reserve(room);
  array.resize(before, absent);
  array.resize(after, absent);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (target[i] != kUnused) array[target[i]] = values[i];
  }
}

}  // namespace

Baker::Baker(const Document& document, const GeometrySums& sums, Scene& scene)
    : document_(document),
      vertices_(static_cast<std::size_t>(std::min(sums.vertices, static_cast<double>(kMostVertices)))),
      scene_(scene) {
  scene.positions.reserve(vertices_);
  scene.triangles.reserve(
      static_cast<std::size_t>(std::min(sums.triangles, static_cast<double>(kMostTriangles))));
}

void Baker::reserveIndices(const LocalMesh& mesh) {
  const std::uint64_t triangles = scene_.triangles.size() + scene_.droppedTriangles + mesh.triangles.size();
  if (triangles > kMostTriangles || scene_.positions.size() + mesh.positions.size() > kMostVertices) {
    document_.fail(fmt::format("has more than {} triangles or {} vertices", kMostTriangles, kMostVertices));
  }
}

template <class TransformOf>
void Baker::bake(const LocalMesh& mesh, std::uint32_t material, const std::string& label, LocalMesh* consumed,
                 TransformOf transformOf) {
  const auto drop = [&](auto member) {
    if (consumed) freeArray(consumed->*member);
  };
  reserveIndices(mesh);
  const std::size_t before = scene_.positions.size();
  const auto target = usedVertices(mesh, static_cast<std::uint32_t>(before));
  std::size_t after = before;
  for (const std::uint32_t t : target) after += t == kUnused ? 0 : 1;

  LocalMesh world;
  world.normals.resize(mesh.normals.size());
  world.tangents.resize(mesh.tangents.size());
  std::vector<bool> mirrored(mesh.positions.size());
  bool isSingular = false;
  scene_.positions.resize(after);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (target[i] == kUnused) continue;
    const VertexTransform& t = transformOf(i);
    scene_.positions[target[i]] = roundedOnce(glm::dvec3(t.toWorld * glm::dvec4(mesh.positions[i], 1.0)));
    if (!mesh.normals.empty()) world.normals[i] = direction(t.cofactors * glm::dvec3(mesh.normals[i]));
    if (!mesh.tangents.empty()) {
      const glm::vec4& tangent = mesh.tangents[i];
      // (M a) × (M b) is the cofactor matrix times a × b: under a mirror the bitangent changes sides.
      const float hand = (tangent.w < 0.0F) != t.isMirrored ? -1.0F : 1.0F;
      world.tangents[i] = glm::vec4(direction(t.linear * glm::dvec3(tangent)), hand);
    }
    mirrored[i] = t.isMirrored;
    isSingular = isSingular || t.isSingular;
  }
  drop(&LocalMesh::positions);
  drop(&LocalMesh::normals);
  drop(&LocalMesh::tangents);
  append(scene_.normals, world.normals, target, before, after, vertices_, glm::vec3(0.0F));
  freeArray(world.normals);
  append(scene_.tangents, world.tangents, target, before, after, vertices_, glm::vec4(0, 0, 0, 1));
  freeArray(world.tangents);
  append(scene_.uv0, mesh.uv[0], target, before, after, vertices_, glm::vec2(0.0F));
  if (consumed) freeArray(consumed->uv[0]);
  append(scene_.uv1, mesh.uv[1], target, before, after, vertices_, glm::vec2(0.0F));
  if (consumed) freeArray(consumed->uv[1]);
  append(scene_.colors, mesh.colors, target, before, after, vertices_, glm::vec4(1.0F));
  drop(&LocalMesh::colors);

  const std::uint64_t degenerateBefore = degenerate_;
  for (const glm::uvec3& t : mesh.triangles) {
    Triangle triangle{target[t[0]], target[t[1]], target[t[2]], material};
    if (mirrored[t[0]]) std::swap(triangle.v1, triangle.v2);
    addTriangle(triangle);
  }
  if (isSingular && degenerate_ > degenerateBefore) {
    if (flattened_ == 0) flattenedBy_ = label;
    flattened_ += degenerate_ - degenerateBefore;
  }
}

void Baker::addTriangle(const Triangle& triangle) {
  const glm::vec3& a = scene_.positions[triangle.v0];
  const glm::vec3& b = scene_.positions[triangle.v1];
  const glm::vec3& c = scene_.positions[triangle.v2];
  const bool isUnusable = !isTraceable(a) || !isTraceable(b) || !isTraceable(c);
  if (isUnusable) {
    ++unusable_;
  } else if (hasNoArea(a, b, c)) {
    ++degenerate_;
  } else {
    scene_.triangles.push_back(triangle);
    return;
  }
  ++scene_.droppedTriangles;
}

void Baker::add(const LocalMesh& mesh, const glm::dmat4& toWorld, std::uint32_t material,
                const std::string& label, LocalMesh* consumed) {
  const VertexTransform transform(toWorld);
  bake(mesh, material, label, consumed,
       [&transform](std::size_t) -> const VertexTransform& { return transform; });
}

void Baker::addSkinned(const LocalMesh& mesh, std::span<const glm::dmat4> jointToWorld,
                       std::uint32_t material, const std::string& label) {
  const auto n = static_cast<std::size_t>(mesh.influences);
  bake(mesh, material, label, nullptr, [&](std::size_t i) {
    glm::dmat4 blended(0.0);
    double sum = 0.0;
    for (std::size_t k = i * n; k < (i + 1) * n; ++k) {
      // Joints of weight 0 are often left at any number; the specification asks for 0, nobody checks.
      if (mesh.weights[k] == 0.0F) continue;
      if (mesh.joints[k] >= jointToWorld.size()) {
        document_.fail(
            fmt::format("{}: a vertex follows joint {} of {}", label, mesh.joints[k], jointToWorld.size()));
      }
      blended += jointToWorld[mesh.joints[k]] * static_cast<double>(mesh.weights[k]);
      sum += static_cast<double>(mesh.weights[k]);
    }
    // Weights must add up to 1; quantised ones do so only nearly.
    if (!(sum > 0.0)) return VertexTransform(jointToWorld[0]);
    return VertexTransform(blended / sum);
  });
}

void Baker::finish(Notices& notices) {
  const std::size_t size = scene_.positions.size();
  pad(scene_.normals, size, glm::vec3(0.0F));
  pad(scene_.tangents, size, glm::vec4(0, 0, 0, 1));
  pad(scene_.uv0, size, glm::vec2(0.0F));
  pad(scene_.uv1, size, glm::vec2(0.0F));
  pad(scene_.colors, size, glm::vec4(1.0F));
  if (unusable_ > 0) {
    // No triangle that is left uses these vertices; bounding boxes over all vertices shall still be finite.
    for (glm::vec3& p : scene_.positions) {
      if (!isTraceable(p)) p = glm::vec3(0.0F);
    }
    notices.warn(fmt::format("{} triangles dropped: a coordinate is not finite or beyond {}", unusable_,
                             kLargestCoordinate));
  }
  if (flattened_ > 0) {
    notices.warn(fmt::format("{} triangles dropped: a scale of 0 leaves them no area (first at {})",
                             flattened_, flattenedBy_));
  }
  if (degenerate_ > flattened_) {
    const auto count = degenerate_ - flattened_;
    notices.note(fmt::format("{} triangle{} of no area dropped", count, count == 1 ? "" : "s"));
  }
}

}  // namespace whittle::gltf
