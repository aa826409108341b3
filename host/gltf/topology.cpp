// Indices, strips and fans to lists of triangles.
#include "gltf/topology.h"

#include <fmt/format.h>

#include "gltf/accessor.h"

namespace whittle::gltf {

namespace {

std::vector<std::uint32_t> readIndices(Document& document, const tinygltf::Primitive& primitive,
                                       std::size_t vertexCount, const std::string& label) {
  if (primitive.indices < 0) {
    std::vector<std::uint32_t> all(vertexCount);
    for (std::size_t i = 0; i < vertexCount; ++i) all[i] = static_cast<std::uint32_t>(i);
    return all;
  }
  const tinygltf::Accessor& a = accessorAt(document, primitive.indices);
  const bool isUnsigned = a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                          a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                          a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (a.type != TINYGLTF_TYPE_SCALAR || !isUnsigned) {
    document.fail(
        fmt::format("{}: its indices are not unsigned integers (accessors[{}])", label, primitive.indices));
  }
  auto indices = readUnsigned(document, primitive.indices);
  for (const std::uint32_t i : indices) {
    if (i >= vertexCount) {
      document.fail(fmt::format("{}: index {} is beyond its {} vertices", label, i, vertexCount));
    }
  }
  return indices;
}

}  // namespace

std::vector<glm::uvec3> readTriangles(Document& document, const tinygltf::Primitive& primitive,
                                      std::size_t vertexCount, const std::string& label, Notices& notices) {
  const auto v = readIndices(document, primitive, vertexCount, label);
  std::vector<glm::uvec3> triangles;
  if (primitive.mode == TINYGLTF_MODE_TRIANGLES) {
    if (v.size() % 3 != 0) {
      notices.warn(
          fmt::format("{}: {} corners do not make whole triangles; the rest is left out", label, v.size()));
    }
    triangles.reserve(v.size() / 3);
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) triangles.emplace_back(v[i], v[i + 1], v[i + 2]);
    return triangles;
  }
  if (v.size() < 3) return triangles;
  triangles.reserve(v.size() - 2);
  for (std::size_t i = 0; i + 2 < v.size(); ++i) {
    if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      triangles.emplace_back(v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]);
    } else {
      triangles.emplace_back(v[i + 1], v[i + 2], v[0]);
    }
  }
  return triangles;
}

}  // namespace whittle::gltf
