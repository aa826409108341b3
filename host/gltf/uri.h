// URIs of glTF buffers and images: data URIs (RFC 2397, base64 of RFC 4648) and percent-encoded relative
// paths (RFC 3986).
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace whittle::gltf {

bool isDataUri(std::string_view uri);
/// "http:", "https:" and the like: a scheme of two letters or more in front, and not a data URI.
bool isAbsoluteUri(std::string_view uri);

/// The bytes of a data URI; nothing if it is malformed.
std::optional<std::vector<std::byte>> decodeDataUri(std::string_view uri);

/// %41 to A. A percent sign without two hexadecimal digits stays as it is.
std::string percentDecode(std::string_view text);

/// The file that a relative URI means, below `folder`. The decoded name, or, if only that
/// exists, the name as written.
std::filesystem::path resolveUri(const std::filesystem::path& folder, std::string_view uri);

/// A git-lfs pointer, which stands in for a file that was never fetched.
bool isLfsPointer(std::string_view start);

}  // namespace whittle::gltf
