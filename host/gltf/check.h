// The shape of a glTF file, checked before anything reads it: tinygltf and the rest of the loader then meet
// only values of the right type, array lengths that the specification asks for, and indices that exist.
#pragma once

#include "gltf/document.h"

namespace whittle::gltf {

/// A copy of `json` with the properties that Whittle reads and no others, but for the nodes, which go to
/// `nodes`. Throws InputError, naming the property, where one has the wrong type, is missing, or is an index
/// that does not exist. Of how things look (shapes.cpp: what is forgiven) a property with a flaw is left out
/// instead, with a warning. `extras` are kept as they are.
Json checkedCopy(const Document& document, Json json, std::vector<Node>& nodes);
/// The same of a list of animations, once the rest of the file is open.
Json checkedAnimations(Document& document, Json animations);

/// What checkedCopy gives without buffers, images, materials, extensions and extras: what tinygltf gets to
/// read. It would otherwise open every file, decode every image and read buffer views unchecked; numbers of
/// extensions it would squeeze into an int, and a material takes two kilobytes there.
Json descriptionOnly(const Json& checked);

}  // namespace whittle::gltf
