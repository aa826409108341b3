// Files that appear whole or not at all: written under another name in the same folder, then renamed (POSIX).
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>

namespace whittle {

/// A file that the system does not take: one line with its path and the system's reason.
class UnwritableFile : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Puts `bytes` at `path`, replacing what is there; a reader never sees a part of them. A symbolic link is
/// followed. Throws UnwritableFile and leaves nothing behind on failure.
void writeWholeFile(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Throws InputError unless the folder of `path` exists and may be written to, and `path` itself is no
/// folder.
void checkFolderWritable(const std::filesystem::path& path);

/// Takes away the regular files directly in `folder` whose names are `isOurs` and that nobody has written to
/// for an hour: whoever made them was killed. By their age, since they may be another machine's. What cannot
/// be looked at or removed stays.
void sweepOldFiles(const std::filesystem::path& folder,
                   const std::function<bool(const std::string& name)>& isOurs);

/// Writes a little beside `path` and takes it away again: a full disk, a used-up quota and a file system that
/// is read-only show before the work and not after it. Sweeps what killed writers left in the folder an hour
/// ago or longer. Throws as checkFolderWritable, and UnwritableFile.
void tryFolder(const std::filesystem::path& path);

}  // namespace whittle
