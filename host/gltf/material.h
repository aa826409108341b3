// glTF materials and the KHR_materials_* extensions to Material.
#pragma once

#include <set>
#include <vector>

#include "gltf/document.h"
#include "scene/scene.h"

namespace whittle::gltf {

/// Reads the materials in `wanted` (glTF indices; -1 is the default material) into Scene::materials, in that
/// order with the default last, and their images into Scene::images. Returns, by glTF index plus one, the
/// index in the scene.
std::vector<int> readMaterials(Document& document, const std::set<int>& wanted, Scene& scene,
                               Notices& notices);

/// Reads the numbers of these materials of the file again, where the scene has them; their images stay.
void changeMaterials(Document& document, const std::set<int>& changed, Scene& scene, Notices& notices);

}  // namespace whittle::gltf
