// Where the copies of a mesh go: EXT_mesh_gpu_instancing, and the joints of a skin (glTF 2.0, 3.7.3).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "gltf/document.h"

namespace whittle::gltf {

/// One transform for each instance of the node's mesh; just `nodeToWorld` if the node is not instanced.
std::vector<glm::dmat4> instanceTransforms(Document& document, int node, const glm::dmat4& nodeToWorld);

/// For each joint of a skin: its node's transform times its inverse bind matrix. The node that carries the
/// skinned mesh does not matter.
std::vector<glm::dmat4> jointTransforms(Document& document, int skin, const std::vector<glm::dmat4>& toWorld);

}  // namespace whittle::gltf
