// One of a file's scenes or animations, as a user names it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/document.h"

namespace whittle::gltf {

/// The first of that name, or the one with that number. Throws InputError that lists them: `what` is "scene".
std::size_t indexCalled(const Document& document, std::string_view what,
                        const std::vector<std::string>& names, const std::string& wanted);

}  // namespace whittle::gltf
