// KHR_materials_variants: which materials the primitives of a file have, as a whole set that a user names.
#pragma once

#include <optional>
#include <string>

#include "gltf/document.h"

namespace whittle::gltf {

/// Gives primitives the materials of the variant with that name or number; those that it leaves alone keep
/// theirs. Notes what there is where none is asked for. Throws InputError that lists them where there is no
/// such one.
void applyVariant(Document& document, const std::optional<std::string>& wanted);

}  // namespace whittle::gltf
