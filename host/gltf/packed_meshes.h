// Primitives compressed with Draco (KHR_draco_mesh_compression), and the compressed views of all meshes that
// are shown.
#pragma once

#include "gltf/document.h"
#include "gltf/nodes.h"

namespace whittle::gltf {

/// Unpacks what the shown meshes are packed in, side by side. A Draco primitive gets accessors of its own in
/// the model, whose values are in Document::unpackedAccessors: whoever reads accessors notices nothing.
/// Throws InputError.
void unpackMeshes(Document& document, const Hierarchy& hierarchy);

}  // namespace whittle::gltf
