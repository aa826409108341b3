// Cameras and KHR_lights_punctual lights of the nodes that a scene shows, in world space.
#pragma once

#include "gltf/nodes.h"
#include "scene/scene.h"

namespace whittle::gltf {

/// Cameras come in the order of the file's camera list, so that `0` is the file's first.
void readCameras(const Document& document, const Hierarchy& hierarchy, Scene& scene, Notices& notices);
/// Lights come in the order of the nodes.
void readLights(const Document& document, const Hierarchy& hierarchy, Scene& scene, Notices& notices);

}  // namespace whittle::gltf
