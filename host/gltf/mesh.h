// Mesh primitives to plain arrays in the mesh's own space: attributes, triangle lists, morph targets.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "gltf/document.h"
#include "scene/scene.h"

namespace whittle::gltf {

/// One primitive, before any node's transform. Attribute arrays are empty or as long as `positions`.
struct LocalMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec4> tangents;
  std::vector<glm::vec2> uv[2];
  std::vector<glm::vec4> colors;
  int influences = 0;                 ///< joints per vertex, a multiple of 4; 0: not skinned
  std::vector<std::uint32_t> joints;  ///< influences for each vertex
  std::vector<float> weights;         ///< the same
  std::vector<glm::uvec3> triangles;
};

/// What the material of a primitive needs of its vertices.
struct Needs {
  bool uv[2] = {false, false};
  bool tangents = false;
};
Needs needsOf(const Material& material);

/// `meshes[2] "name" primitive 0` for messages.
std::string primitiveLabel(const Document& document, int mesh, int primitive);

/// True for triangles, strips and fans that have positions.
bool isDrawable(const tinygltf::Primitive& primitive);

/// Throws InputError for what cannot be read; warns about attributes that are left out. Morph targets are
/// applied with `morphWeights`; tangents, where the material needs them, are along its normal map.
LocalMesh readPrimitive(Document& document, int mesh, int primitive, const Material& material,
                        std::span<const double> morphWeights, bool isSkinned, Notices& notices);

/// Appends a copy of vertex `v` and returns its index.
std::uint32_t duplicateVertex(LocalMesh& mesh, std::uint32_t v);

/// Tangents from the derivatives of the texture coordinates that `slot` reads (tangents.cpp). A mesh without
/// normals is flat: then each triangle gets vertices of its own, and the tangent of its own plane.
void generateTangents(LocalMesh& mesh, const TextureSlot& slot);
/// Turns and mirrors the mesh's tangents as `slot` does the image (KHR_texture_transform). Needs normals.
void turnTangents(LocalMesh& mesh, const TextureSlot& slot);

}  // namespace whittle::gltf
