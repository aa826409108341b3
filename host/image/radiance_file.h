// Radiance pictures (.hdr, .pic), decoded here: OpenImageIO leaves rows as they are stored, keeps one
// EXPOSURE of several, and takes some orientations for others. Ward, "Real Pixels", Graphics Gems II (1991);
// Radiance's own filefmts.pdf.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "image/image_io.h"

namespace whittle {

/// Whether a file that begins with these bytes says that it is one.
bool isRadianceFile(std::span<const std::byte> bytes);

/// RGB, W/(m² sr) as the file means it: what is stored over the product of all EXPOSURE and COLORCORR lines,
/// and turned so that row 0 is the top, whatever the order of its scanlines. Throws InputError naming `name`
/// where the file is cut off or damaged, or holds XYZ.
FloatImage decodeRadiance(std::span<const std::byte> bytes, const std::string& name);

}  // namespace whittle
