// From changed JSON back to a file: its name, its URIs and, of a .glb, its other chunks.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "gltf/document.h"

namespace whittle::gltf {

/// `wanted` with the extension that fits, or a name beside the document's file where it is empty; with a
/// number where it is taken.
std::filesystem::path freeName(const Document& document, const std::filesystem::path& wanted);

/// Relative URIs of buffers and images as they are from `folder`. Where that is the document's own, none
/// changes.
void moveUris(const Document& document, const std::filesystem::path& folder, nlohmann::ordered_json& root);

/// The document's file with other JSON. Throws InputError where a .glb would be too large for its header.
Bytes containerWith(const Document& document, std::string json);

}  // namespace whittle::gltf
