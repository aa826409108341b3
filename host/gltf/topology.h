// Which vertices make which triangles: index buffers, strips and fans (glTF 2.0, 3.7.2.1).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "gltf/document.h"

namespace whittle::gltf {

/// The triangles of a primitive over `vertexCount` vertices. Throws InputError for indices beyond them.
std::vector<glm::uvec3> readTriangles(Document& document, const tinygltf::Primitive& primitive,
                                      std::size_t vertexCount, const std::string& label, Notices& notices);

}  // namespace whittle::gltf
