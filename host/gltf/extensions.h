// What the extensions of a file mean for it: read, not drawn with a warning, or a reason to refuse it.
#pragma once

#include <optional>
#include <string_view>

#include "gltf/document.h"

namespace whittle::gltf {

/// Throws InputError where the file needs what Whittle does not read, unless that only changes how it looks:
/// then warns of what will look different. Notes what is used, not needed and not read.
void checkExtensions(const Document& document, Notices& notices);

/// A command that turns what an extension holds into what Whittle reads; nothing where none is known.
std::optional<std::string_view> conversionOf(std::string_view extensionName);

}  // namespace whittle::gltf
