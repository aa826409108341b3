// Compressed buffer views (EXT_meshopt_compression and KHR_meshopt_compression): unpacked on first use, each
// once.
#pragma once

#include <optional>
#include <set>
#include <span>

#include "gltf/document.h"

namespace whittle::gltf {

/// The unpacked bytes of a view; nothing where it is not compressed. Throws InputError, as where the library
/// is missing that unpacks.
std::optional<std::span<const std::byte>> unpackedView(Document& document, int view);

/// Unpacks those of `views` that are compressed and still packed, side by side. Throws InputError.
void unpackViews(Document& document, const std::set<int>& views);

}  // namespace whittle::gltf
