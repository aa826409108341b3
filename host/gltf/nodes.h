// The node hierarchy (glTF 2.0, 3.5): the chosen scene, the nodes it shows in
// depth-first order, global transforms.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "gltf/document.h"

namespace whittle::gltf {

struct Hierarchy {
  int scene = -1;                   ///< -1: the file has none, all nodes are shown
  std::vector<int> shown;           ///< nodes of the scene, parents first, in file order
  std::vector<glm::dmat4> toWorld;  ///< of every node of the file, shown or not (joints may lie outside)
  glm::dvec3 origin{0.0};           ///< metres; what was taken off toWorld, see Scene::origin
};

/// Throws InputError for cycles, for nodes with two parents and for a scene that does not exist.
Hierarchy readHierarchy(Document& document, const std::optional<std::string>& sceneName, Notices& notices);

/// T · R · S; the quaternion (x, y, z, w) is normalised first, and one of length 0 turns nothing.
glm::dmat4 composed(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale);

/// `node 3 "name"` for messages.
std::string nodeLabel(const Document& document, int node);

}  // namespace whittle::gltf
