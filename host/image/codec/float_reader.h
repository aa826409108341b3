// Pictures as linear floats: the right channels, in their place, decoded as the file says.
#pragma once

#include <filesystem>

#include "image/image_io.h"

namespace whittle {

/// See readFloatImage of image_io.h; Radiance files are decoded elsewhere. Throws InputError.
FloatImage readFloats(const std::filesystem::path& path);

}  // namespace whittle
