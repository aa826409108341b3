// The pictures that most scenes bring, decoded without loading the codec and its libraries: PNG of 8 bits,
// and JPEG in grey or colours. Whatever is unusual, or damaged, is left to the codec, which says what is
// wrong.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "scene/scene.h"

namespace whittle {

/// By its first two bytes, which must be there.
bool mayBePlain(std::span<const std::byte> bytes);

/// With the texels that the codec would give; nothing where the bytes are no such picture. May be called from
/// several threads.
std::optional<Image> decodePlainImage(std::span<const std::byte> bytes, const std::string& name);

}  // namespace whittle
