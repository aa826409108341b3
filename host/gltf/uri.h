// URIs of glTF buffers and images: data URIs (RFC 2397, base64 of RFC 4648), percent-encoded relative paths
// (RFC 3986), file URIs (RFC 8089).
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace whittle::gltf {

bool isDataUri(std::string_view uri);
/// "http://", "https://" and the like: somewhere else than among the files of this machine.
bool isAbsoluteUri(std::string_view uri);

/// The bytes of a data URI; nothing if it is malformed.
std::optional<std::vector<std::byte>> decodeDataUri(std::string_view uri);

/// %41 to A. A percent sign without two hexadecimal digits stays as it is.
std::string percentDecode(std::string_view text);

struct LocalFile {
  std::filesystem::path path;
  bool hadBackslashes = false;  ///< the file has slashes in their places
};

/// The file that a URI means; relative ones start at `folder`. Of these the first that is there, for names on
/// disk may hold any of it: the decoded name, the name as written, the path of a "file:" URI, what stands
/// before '?' and '#'; then the same with slashes for backslashes.
LocalFile resolveUri(const std::filesystem::path& folder, std::string_view uri);

/// A git-lfs pointer, which stands in for a file that was never fetched.
bool isLfsPointer(std::string_view start);

}  // namespace whittle::gltf
