// Files that appear whole or not at all: written under another name in the same folder, then renamed (POSIX).
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace whittle {

/// Puts `bytes` at `path`, replacing what is there; a reader never sees a part of them. A symbolic link is
/// followed. Throws std::runtime_error with one line (the path and the system's reason) and leaves nothing
/// behind on failure.
void writeWholeFile(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Throws InputError unless the folder of `path` exists and takes new files, and `path` itself is no folder.
void checkFolderWritable(const std::filesystem::path& path);

}  // namespace whittle
