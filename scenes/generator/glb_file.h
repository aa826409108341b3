// A tinygltf model as a binary glTF 2.0 file that follows the specification.
#pragma once

#include <tiny_gltf.h>

#include <filesystem>

namespace generator {

/// Writes `model`, whose one buffer becomes the binary chunk. The model comes back as it was; its buffer is
/// not copied on the way, as it may be gigabytes. Throws std::runtime_error if that fails.
void writeGlb(tinygltf::Model& model, const std::filesystem::path& path);

}  // namespace generator
