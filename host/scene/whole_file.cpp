// Writes a nameless file beside the target, names it when it is whole, and renames it: rename() within a
// folder is atomic (POSIX.1). The data reach the disk (fsync) before the name does, so that a crash leaves
// the old file or the new one.
#include "scene/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <system_error>

#include "scene/input_error.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int error) {
  throw UnwritableFile(
      fmt::format("{}: cannot be written: {}", path.string(), std::generic_category().message(error)));
}

fs::path folderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// Where the bytes really go: a link keeps pointing at its file, whose folder then holds the temporary one.
fs::path followLink(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path target = fs::weakly_canonical(path, error);
  return error ? path : target;
}

constexpr const char *kPartBegin = ".whittle-", *kPartEnd = ".part";

/// A file of its own that goes away again unless it became the target. It has no name while it is written
/// (O_TMPFILE), so that nothing stays behind whatever ends the process; where the file system knows no such
/// files it has one from the beginning.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target) : target_(target) {
    file_ = ::open(folderOf(target).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (file_ >= 0) return;
    takeName([&] { return file_ = ::open(name_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666); });
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (file_ >= 0) ::close(file_);
    if (!name_.empty() && !renamed_) ::unlink(name_.c_str());
  }

  void write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(file_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(target_, errno);
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
  }

  void becomeTarget() {
    // EINVAL, ENOTSUP: a file system that cannot flush is no reason to lose the picture.
    if (::fsync(file_) != 0 && errno != EINVAL && errno != ENOTSUP) fail(target_, errno);
    const std::string open = fmt::format("/proc/self/fd/{}", file_);
    const auto link = [&](const fs::path& name) {
      return ::linkat(AT_FDCWD, open.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW);
    };
    const bool isNew = name_.empty() && link(target_) == 0;
    // What is there already can only be replaced by a file that has a name.
    if (!isNew && name_.empty()) takeName([&] { return link(name_); });
    const int closed = ::close(file_);
    file_ = -1;
    if (closed != 0) fail(target_, errno);
    if (isNew) return;
    if (::rename(name_.c_str(), target_.c_str()) != 0) fail(target_, errno);
    renamed_ = true;
  }

 private:
  /// `make` makes a file called name_ and returns a number below 0 where it cannot. The name does not contain
  /// the target's: that one may already be as long as the file system allows.
  template <typename Make>
  void takeName(const Make& make) {
    for (int attempt = 0;; ++attempt) {
      name_ = folderOf(target_) / fmt::format("{}{}-{}{}", kPartBegin, ::getpid(), attempt, kPartEnd);
      if (make() >= 0) return;
      if (errno == EEXIST) continue;
      name_.clear();
      fail(target_, errno);
    }
  }

  fs::path target_;
  fs::path name_;
  int file_ = -1;
  bool renamed_ = false;
};

}  // namespace

void writeWholeFile(const fs::path& path, std::span<const std::byte> bytes) {
  TemporaryFile file(followLink(path));
  file.write(bytes);
  file.becomeTarget();
}

void checkFolderWritable(const fs::path& path) {
  std::error_code error;
  const fs::path target = followLink(path);
  const fs::path folder = folderOf(target);
  if (fs::is_directory(target, error))
    throw InputError(fmt::format("{}: is a folder, not a file", path.string()));
  const fs::file_status status = fs::status(folder, error);
  if (!fs::is_directory(status)) {
    const bool isAbsent = status.type() == fs::file_type::not_found;
    throw InputError(
        fmt::format("{}: the folder {} {}", path.string(), folder.string(),
                    isAbsent ? "does not exist"
                             : (fs::exists(status) ? "is a file" : "cannot be used: " + error.message())));
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw InputError(fmt::format("{}: the folder {} is not writable: {}", path.string(), folder.string(),
                                 std::generic_category().message(errno)));
  }
}

void sweepOldFiles(const fs::path& folder, const std::function<bool(const std::string& name)>& isOurs) {
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(1);
  std::error_code error;
  fs::directory_iterator file(folder, error);
  for (; !error && file != fs::directory_iterator(); file.increment(error)) {
    if (!isOurs(file->path().filename().string())) continue;
    std::error_code gone;
    const auto written = file->last_write_time(gone);
    if (!gone && file->is_regular_file(gone) && written < old) fs::remove(file->path(), gone);
  }
}

void tryFolder(const fs::path& path) {
  checkFolderWritable(path);
  static constexpr std::array<std::byte, 4096> kLittle{};
  TemporaryFile(followLink(path)).write(kLittle);
  sweepOldFiles(folderOf(followLink(path)), [](const std::string& name) {
    return name.starts_with(kPartBegin) && name.ends_with(kPartEnd);
  });
}

}  // namespace whittle
