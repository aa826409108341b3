#include "cli/speech.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "cli/guard.h"
#include "report/printable.h"

namespace whittle::cli {
namespace {

/// In one piece where the system takes it so; what it does not take is lost.
void writeError(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void sayLine(const char* kind, const std::string& text) { writeError(kind + printableLine(text) + "\n"); }

/// Standard output did not take something, for the reason in `error`.
[[noreturn]] void failOutput(int error) {
  if (error == EPIPE) {
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
  }
  throw std::runtime_error(fmt::format("standard output cannot be written: {}", std::strerror(error)));
}

void put(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) failOutput(errno);
}

}  // namespace

void settleStreams() {
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; ++fd) {
    if (::fcntl(fd, F_GETFD) != -1 || errno != EBADF) continue;
    // The lowest free descriptor: this one, since those below are open by now.
    [[maybe_unused]] const int opened = ::open("/dev/null", fd == STDIN_FILENO ? O_RDONLY : O_WRONLY);
  }
  std::signal(SIGPIPE, SIG_IGN);
}

void warn(const std::string& text) { sayLine("warning: ", text); }
void warnIfAny(const std::string& text) {
  if (!text.empty()) warn(text);
}
void note(const std::string& text) { sayLine("note: ", text); }
void complain(const std::string& text) {
  haveExplained();
  sayLine("whittle: ", text);
}
void tellError(const std::string& lines) {
  haveExplained();
  writeError(printableLines(lines));
}
void drawError(const std::string& text) { writeError(text); }
void tell(const std::string& lines) { put(printableLines(lines)); }
void tellJson(const std::string& json) { put(json); }

void finishOutput() {
  if (std::fflush(stdout) != 0) failOutput(errno);
}

}  // namespace whittle::cli
