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
  std::vector<int> shown;           ///< visible nodes of the scene, parents first, in file order
  std::vector<int> shownSometime;   ///< with those that an animation shows at other times; empty: the same
  std::vector<int> cameras;         ///< its nodes with a camera in the same order, visible or not
  std::vector<glm::dmat4> toWorld;  ///< of every node of the file, shown or not (joints may lie outside)
  glm::dvec3 origin{0.0};           ///< metres; what was taken off toWorld, see Scene::origin
};

/// Throws InputError for cycles, for nodes with two parents and for a scene that does not exist. Its origin
/// is still 0.
Hierarchy readHierarchy(Document& document, const std::optional<std::string>& sceneName, Notices& notices);
/// Chooses the origin and takes it off; warns of meshes far from their own. Reads all positions.
void settlePlace(Document& document, Hierarchy& hierarchy, Notices& notices);

/// `node 3 "name"` for messages.
std::string nodeLabel(const Document& document, int node);

}  // namespace whittle::gltf
