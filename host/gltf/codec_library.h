// Finds the libraries that unpack geometry (mesh_codecs.h).
#pragma once

#include "gltf/document.h"
#include "gltf/mesh_codecs.h"

namespace whittle::gltf {

/// Loaded by the first call. Where it is missing: null if `hasFallback`, else an InputError that names the
/// package that the build lacked.
const MeshoptCodec* meshoptCodec(const Document& document, bool hasFallback);
const DracoCodec* dracoCodec(const Document& document, bool hasFallback);

}  // namespace whittle::gltf
