// What the meshes of a scene come to once every node and instance has its own copy, counted before any is
// made: a small file can ask for a copy of a mesh many million times.
#pragma once

#include <cstdint>

#include "gltf/document.h"
#include "gltf/nodes.h"

namespace whittle::gltf {

struct GeometrySums {
  double triangles = 0, vertices = 0;  ///< upper bounds; doubles, since products may be of any size
  double sceneBytes = 0;               ///< of the scene's arrays
  double meshBytes = 0;                ///< read, in their own space, and kept for several nodes
  double reads = 0;                    ///< values of attributes and morph targets
  double largestMesh = 0;              ///< the most that one takes while it is read and copied
};
/// Reads no accessor. What says that it reaches beyond its data counts as far as those go.
GeometrySums sumGeometry(const Document& document, const Hierarchy& hierarchy);

/// Holds the sums, with `triangleBytes` more for each triangle. Throws InputError where they are too much.
GeometrySums holdGeometry(Document& document, const Hierarchy& hierarchy, std::uint64_t triangleBytes);

}  // namespace whittle::gltf
