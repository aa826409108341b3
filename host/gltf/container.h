// From a file on disk to its JSON and its binary chunk (glTF 2.0, 4.4: the .glb container).
#pragma once

#include <cstdint>
#include <optional>

#include "gltf/document.h"

namespace whittle::gltf {

std::string_view asText(std::span<const std::byte> bytes);

/// The first `most` bytes of a regular file into `bytes`. Returns what is wrong
/// with it, nothing if all is well.
std::optional<std::string> readStart(const std::filesystem::path& path, std::uint64_t most, Bytes& bytes);

/// The JSON text of Document::file; sets Document::binary. Throws InputError.
std::string_view readText(Document& document);
/// The JSON of Document::file, parsed but not checked; sets Document::binary. Throws InputError.
Json readContainer(Document& document);

}  // namespace whittle::gltf
