// Looks through the header of an OpenEXR file before OpenImageIO sees it ("OpenEXR File Layout",
// openexr.com).
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace whittle {

/// Whether a file that begins with these bytes says that it is one.
bool isExrFile(std::span<const std::byte> bytes);

/// Throws InputError naming `name` where a channel of any part has a type of samples that OpenEXR does not
/// define (0: unsigned, 1: half, 2: float). OpenImageIO 2.4 ends the process over one. `bytes`: the
/// beginning of a file; all else that is wrong with it, and what lies behind them, is left to the codec.
void checkSampleTypes(std::span<const std::byte> bytes, const std::string& name);

}  // namespace whittle
