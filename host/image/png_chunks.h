// Looks through the chunks of a PNG before libpng sees it (PNG specification, third edition, section 5).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace whittle {

/// `bytes` (which start with the PNG signature) reduced to the chunks that carry texels: IHDR, PLTE, tRNS,
/// IDAT, IEND. libpng prints what it dislikes about any other chunk, and every damaged one, to standard error
/// by itself. Throws InputError naming `name` where the file is cut off or a chunk's checksum does not match.
std::vector<std::byte> texelChunks(std::span<const std::byte> bytes, const std::string& name);

/// Light is sample^exponent where a PNG's gAMA chunk says so: 1 for a linear one. Empty where samples follow
/// the sRGB curve: no gAMA, one of 1/2.2 (which writers mean as sRGB), or a chunk that goes before it, sRGB,
/// iCCP or cICP. Chunks that are damaged or cut off count as missing.
std::optional<double> gammaExponent(std::span<const std::byte> bytes);

}  // namespace whittle
