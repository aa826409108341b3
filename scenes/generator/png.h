// Small PNG pictures for embedded textures.
#pragma once

#include <cstdint>
#include <vector>

namespace generator {

/// `rgba`: width·height·4 bytes, row 0 at the top. Stored without compression: the same bytes whatever zlib
/// is installed.
std::vector<std::uint8_t> encodePng(int width, int height, const std::vector<std::uint8_t>& rgba);

}  // namespace generator
