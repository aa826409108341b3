#include "cl/kernel_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "cl/program_cache.h"
#include "scene/byte_counts.h"
#include "scene/whole_file.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVariable = "POCL_CACHE_DIR";

/// PoCL refuses longer ones in ways of its own; below its folder come some 150 characters more.
constexpr std::size_t kLongestFolder = 512;

/// One program with its kernels, and the compiler's files between.
constexpr std::uint64_t kRoom = 16 << 20;

fs::path variable(const char* name) {
  const char* const value = std::getenv(name);
  return value && *value ? fs::path(value) : fs::path();
}

/// What the variable `own` says, else `below` in the user's folder of caches; empty where nothing says one.
fs::path wantedFolder(const char* own, const fs::path& below) {
  if (const fs::path folder = variable(own); !folder.empty()) return folder;
  if (const fs::path folder = variable("XDG_CACHE_HOME"); !folder.empty()) return folder / below;
  if (const fs::path folder = variable("HOME"); !folder.empty()) return folder / ".cache" / below;
  return {};
}

std::string reason(int error) { return std::generic_category().message(error); }

/// Why compiled kernels cannot be kept in `folder`, which is made where it is missing; empty where they can.
std::string problemOf(const fs::path& folder) {
  if (folder.native().size() > kLongestFolder) return "its name is too long for PoCL";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return error.message();
  std::string probe = (folder / "whittle-XXXXXX").string();
  const int file = ::mkstemp(probe.data());
  if (file < 0) return reason(errno);
  static constexpr std::array<char, 4096> kLittle{};
  const bool isWritten =
      ::write(file, kLittle.data(), kLittle.size()) == static_cast<ssize_t>(kLittle.size());
  const int problem = errno;
  ::close(file);
  ::unlink(probe.c_str());
  if (!isWritten) return reason(problem);
  struct statvfs room {};
  if (::statvfs(folder.c_str(), &room) == 0 && room.f_bavail * room.f_frsize < kRoom)
    return fmt::format("its disk has less than {} free", formatBytes(kRoom));
  return {};
}

/// A folder among the temporary files that nobody else can write to: kernels found there are run. One of a
/// fixed name, so that the next run finds them; another where that name is taken by somebody.
fs::path privateFolder() {
  std::error_code error;
  fs::path temporary = fs::temp_directory_path(error);
  if (error || ::access(temporary.c_str(), W_OK | X_OK) != 0)
    temporary = "/tmp";  // $TMPDIR says nothing good
  const fs::path folder = temporary / fmt::format("whittle-kernels-{}", ::geteuid());
  struct stat status {};
  ::mkdir(folder.c_str(), 0700);
  const bool isOurs = ::lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) &&
                      status.st_uid == ::geteuid() && (status.st_mode & 077) == 0;
  if (isOurs) return folder;
  std::string other = (temporary / "whittle-kernels-XXXXXX").string();
  return ::mkdtemp(other.data()) ? fs::path(other) : fs::path();
}

/// Files that PoCL makes while it compiles, under the names that it gives them, and our probes.
bool isLeftover(const std::string& name) {
  return name.starts_with("tempfile") ||
         (name.starts_with("whittle-") && name != kTurnsFile && name != kBesideFile);
}

void settle(const fs::path& folder) {
  std::error_code error;
  const fs::path whole = fs::absolute(folder, error);
  ::setenv(kVariable, (error ? folder : whole).c_str(), 1);
  sweepOldFiles(folder, isLeftover);
}

/// A file for each key: that its kernels are in the folder beside it.
fs::path compiledMark(const std::string& key) {
  const fs::path folder = variable(kVariable);
  return folder.empty() ? fs::path() : folder / "whittle-compiled" / stableHash(key);
}

}  // namespace

fs::path programCacheFolder() {
  const fs::path wanted = wantedFolder("WHITTLE_CACHE_DIR", "whittle");
  return wanted.empty() ? privateFolder() / "programs" : wanted;
}

void noteCompiled(const std::string& key) {
  const fs::path mark = compiledMark(key);
  std::error_code error;
  if (mark.empty() || fs::exists(mark, error)) return;
  fs::create_directories(mark.parent_path(), error);
  const int file = ::open(mark.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0666);
  if (file >= 0) ::close(file);  // unwritten, the next run only thinks that it has to compile
}

bool wasCompiled(const std::string& key) {
  const fs::path mark = compiledMark(key);
  std::error_code error;
  return !mark.empty() && fs::exists(mark, error);
}

std::string settleKernelCache() {
  const fs::path wanted = wantedFolder(kVariable, "pocl/kcache");
  const std::string problem = wanted.empty() ? "HOME is not set" : problemOf(wanted);
  if (problem.empty()) {
    settle(wanted);
    return {};
  }
  const fs::path refuge = privateFolder();
  const std::string lost =
      wanted.empty() ? fmt::format("no folder for compiled kernels: {}", problem)
                     : fmt::format("compiled kernels cannot be kept in {}: {}", wanted.string(), problem);
  if (refuge.empty() || !problemOf(refuge).empty())
    return fmt::format("{}; set {} to a folder that can be written to", lost, kVariable);
  settle(refuge);
  return fmt::format("{}; they go to {}; set {} to another folder", lost, refuge.string(), kVariable);
}

}  // namespace whittle
