#include "gltf/geometry_sums.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "gltf/accessor.h"
#include "gltf/mesh.h"

namespace whittle::gltf {
namespace {

/// Attributes that vertices may carry, and the bytes of one in the scene.
struct Attribute {
  const char* name;
  double bytes;
};
constexpr Attribute kAttributes[]{
    {"NORMAL", 12}, {"TANGENT", 16}, {"TEXCOORD_0", 8}, {"TEXCOORD_1", 8}, {"COLOR_0", 16}};

/// Elements, but no more than there are bytes for.
double countOf(const Document& document, int index) {
  const tinygltf::Accessor& a = accessorAt(document, index);
  auto count = static_cast<double>(a.count);
  if (document.unpackedAccessors.contains(index)) return count;
  if (a.bufferView < 0) return std::min(count, static_cast<double>(kMostZeros));
  const tinygltf::BufferView& v = document.model.bufferViews[at(a.bufferView)];
  return std::min(count, static_cast<double>(v.byteLength));
}

/// One copy of a mesh.
struct MeshSums {
  double triangles = 0, vertices = 0, bytes = 0, reads = 0;
  double largest = 0;  ///< beside the scene, while a part of it is drawn
  double moved = 0;    ///< less where a part goes as its copy comes
  bool has[std::size(kAttributes)] = {};
};

/// What is there for a moment beside a part of a mesh: one attribute and the corners while they are read,
/// tangents while they are made, what directions become in world space.
double passingBytes(const Document& document, const tinygltf::Primitive& p, double corners, double vertices) {
  constexpr double kAttribute = 16, kCorner = 4, kPlace = 4.125, kNormal = 12, kTangent = 16, kMaking = 44;
  const bool hasNormal = p.attributes.contains("NORMAL"), hasTangent = p.attributes.contains("TANGENT");
  const double reading = kAttribute * vertices + kCorner * corners;
  const double baking = (kPlace + (hasNormal ? kNormal : 0) + (hasTangent ? kTangent : 0)) * vertices;
  const Json& materials = child(document.json, "materials");
  const bool makesTangents = !hasTangent && p.material >= 0 && at(p.material) < materials.size() &&
                             (materials[at(p.material)].contains("normalTexture") ||
                              extension(materials[at(p.material)], "KHR_materials_clearcoat") ||
                              extension(materials[at(p.material)], "KHR_materials_anisotropy"));
  return std::max({reading, baking, makesTangents ? kMaking * vertices + kCorner * corners : 0.0});
}

MeshSums sumMesh(const Document& document, int mesh) {
  MeshSums sums;
  for (const tinygltf::Primitive& p : document.model.meshes[at(mesh)].primitives) {
    if (!isDrawable(p)) continue;
    const double vertices = countOf(document, p.attributes.at("POSITION"));
    const double corners = p.indices >= 0 ? countOf(document, p.indices) : vertices;
    const double triangles = p.mode == TINYGLTF_MODE_TRIANGLES ? corners / 3 : corners;
    double vertexBytes = 12;
    for (std::size_t i = 0; i < std::size(kAttributes); ++i) {
      if (!p.attributes.contains(kAttributes[i].name)) continue;
      sums.has[i] = true;
      vertexBytes += kAttributes[i].bytes;
    }
    const double bytes = vertexBytes * vertices + 12 * triangles;
    sums.triangles += triangles;
    // Parts of a mesh often share one array of vertices; each takes along what it uses.
    sums.vertices += std::min(vertices, corners);
    sums.bytes += bytes;
    std::size_t targets = 0;
    for (const auto& target : p.targets) targets += target.size();
    sums.reads += corners + 3 * vertices * static_cast<double>(p.attributes.size() + targets);
    const double largest = bytes + passingBytes(document, p, corners, vertices);
    if (largest > sums.largest) {
      sums.largest = largest;
      sums.moved = (vertexBytes - 12) * std::min(vertices, corners);
    }
  }
  return sums;
}

double copiesOf(const Document& document, const Node& node) {
  if (!node.rare || !node.rare->instancing) return 1;
  for (const auto& [name, accessor] : *node.rare->instancing)
    if (name == "TRANSLATION" || name == "ROTATION" || name == "SCALE") return countOf(document, accessor);
  return 1;
}

}  // namespace

GeometrySums sumGeometry(const Document& document, const Hierarchy& hierarchy) {
  std::vector<std::optional<MeshSums>> meshes(document.model.meshes.size());
  std::vector<bool> isShared(meshes.size());
  GeometrySums sums;
  bool has[std::size(kAttributes)] = {};
  std::vector<int> uses(meshes.size());
  for (const int index : hierarchy.shown)
    if (const int mesh = document.nodes[at(index)].mesh; mesh >= 0) ++uses[at(mesh)];
  for (const int index : hierarchy.shown) {
    const Node& node = document.nodes[at(index)];
    if (node.mesh < 0) continue;
    auto& mesh = meshes[at(node.mesh)];
    if (!mesh || !node.weights().empty()) {  // with weights of a node's own it is read again
      mesh = mesh ? mesh : sumMesh(document, node.mesh);
      sums.reads += mesh->reads;
    } else if (!isShared[at(node.mesh)]) {
      isShared[at(node.mesh)] = true;
      sums.meshBytes += mesh->bytes;
    }
    constexpr double kInstance = 128 + 40;  // its transform, and what that is made of
    const double copies = copiesOf(document, node);
    sums.triangles += copies * mesh->triangles;
    sums.vertices += copies * mesh->vertices;
    const double moved = uses[at(node.mesh)] == 1 && node.skin < 0 ? mesh->moved : 0;
    sums.largestMesh = std::max(sums.largestMesh, mesh->largest - moved + kInstance * copies);
    for (std::size_t i = 0; i < std::size(kAttributes); ++i) has[i] = has[i] || mesh->has[i];
  }
  double vertexBytes = 12;
  for (std::size_t i = 0; i < std::size(kAttributes); ++i) vertexBytes += has[i] ? kAttributes[i].bytes : 0;
  sums.sceneBytes = sizeof(Triangle) * sums.triangles + vertexBytes * sums.vertices;
  return sums;
}

GeometrySums holdGeometry(Document& document, const Hierarchy& hierarchy, std::uint64_t triangleBytes) {
  const GeometrySums sums = sumGeometry(document, hierarchy);
  const auto bytes = [](double b) { return static_cast<std::uint64_t>(std::min(b, 9e18)); };
  const std::string what = sums.triangles < 1e6 ? fmt::format("its {:.0f} triangles", sums.triangles)
                           : sums.triangles < 1e10
                               ? fmt::format("its {:.4g} million triangles", sums.triangles / 1e6)
                               : fmt::format("its {:.3g} triangles", sums.triangles);
  document.checkReads(sums.reads, "its meshes");
  document.hold(bytes(sums.sceneBytes), what);
  document.pass(bytes(sums.meshBytes + sums.largestMesh), what);
  document.promise(bytes(static_cast<double>(triangleBytes) * sums.triangles), what);
  return sums;
}

}  // namespace whittle::gltf
