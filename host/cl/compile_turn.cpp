// A file of bytes, one for all keys of a hash. A byte counts how often a turn was done; its lock (an open
// file description lock, Linux: other threads of one process wait as well) is held exclusively by who
// compiles, and asked for in shared mode by who waits, so that all of them go on at once.
#include "cl/compile_turn.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include "cl/kernel_cache.h"

namespace whittle {
namespace {

constexpr std::size_t kSlots = 4096;

/// Of one byte of an open file. False where another has it, and where there are no locks.
bool lock(int file, off_t slot, short type, int command) {
  struct flock range {};
  range.l_type = type;
  range.l_whence = SEEK_SET;
  range.l_start = slot;
  range.l_len = 1;
  int result = 0;
  do result = ::fcntl(file, command, &range);
  while (result != 0 && errno == EINTR);
  return result == 0;
}

bool isBusy() { return errno == EAGAIN || errno == EACCES; }

std::filesystem::path poclFolder() {
  const char* const folder = std::getenv("POCL_CACHE_DIR");
  return folder ? folder : "";
}

}  // namespace

CompileTurn::CompileTurn(const std::string& key) : CompileTurn(key, poclFolder()) {}

CompileTurn::CompileTurn(const std::string& key, const std::filesystem::path& folder)
    : slot_(static_cast<off_t>(std::hash<std::string>{}(key) % kSlots)) {
  if (folder.empty()) return;
  file_ = ::open((folder / kTurnsFile).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) return;
  for (;;) {
    const unsigned char before = timesDone();
    mine_ = lock(file_, slot_, F_WRLCK, F_OFD_SETLK);
    if (mine_ || !isBusy()) return;
    if (!lock(file_, slot_, F_RDLCK, F_OFD_SETLKW)) return;
    lock(file_, slot_, F_UNLCK, F_OFD_SETLK);
    if (timesDone() != before) return;  // else who had it has died over it
  }
}

CompileTurn::~CompileTurn() {
  if (file_ >= 0) ::close(file_);  // and with it the lock
}

void CompileTurn::done() {
  if (!mine_) return;
  const auto times = static_cast<unsigned char>(timesDone() + 1);
  // Unwritten, it only has the others compile as well.
  [[maybe_unused]] const ssize_t ignored = ::pwrite(file_, &times, 1, slot_);
}

unsigned char CompileTurn::timesDone() const {
  unsigned char times = 0;
  [[maybe_unused]] const ssize_t ignored = ::pread(file_, &times, 1, slot_);  // behind the end: 0
  return times;
}

}  // namespace whittle
