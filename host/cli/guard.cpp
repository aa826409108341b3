// The guard's waiting, and what it says of an end.
#include "cli/guard.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <optional>
#include <string_view>

#include "cli/speech.h"
#include "cli/starvation.h"
#include "scene/byte_counts.h"
#include "scene/machine_memory.h"

namespace whittle::cli {
namespace {

/// What the worker tells the guard, in a page that both see. A text that does not fit loses its end.
class Ledger {
 public:
  void doing(std::string_view phase) { phase_.replace(phase); }
  void wrote(std::string_view file) { written_.append(written_.empty() ? file : ", " + std::string(file)); }
  void explain() { explained_ = true; }
  bool isExplained() const { return explained_; }
  void guardIt() { isGuarded_ = true; }
  bool isGuarded() const { return isGuarded_; }
  void answer() { answers_ = true; }
  bool answers() const { return answers_; }
  void wantEnd() { isEndWanted_ = true; }
  bool isEndWanted() const { return isEndWanted_; }
  std::string phase() const { return phase_.text(); }
  std::string written() const { return written_.text(); }

 private:
  /// The length goes last: a reader sees whole texts, whenever the writer ends.
  template <std::size_t capacity>
  class Text {
   public:
    bool empty() const { return size_ == 0; }
    void replace(std::string_view text) {
      size_ = 0;
      append(text);
    }
    void append(std::string_view text) {
      const std::size_t room = capacity - size_;
      std::memcpy(bytes_.data() + size_, text.data(), std::min(room, text.size()));
      size_ += std::min(room, text.size());
    }
    std::string text() const { return {bytes_.data(), size_}; }

   private:
    std::atomic<std::size_t> size_ = 0;
    std::array<char, capacity> bytes_{};
  };
  Text<200> phase_;
  Text<3000> written_;
  std::atomic<bool> explained_ = false, isGuarded_ = false, answers_ = false, isEndWanted_ = false;
};

/// Set before the worker starts, and only ever read after: the one exception to "no globals", since every
/// writer of a file would have to carry it.
Ledger* ledger = nullptr;

constexpr std::array kEndings{SIGINT, SIGTERM, SIGHUP};

bool isIgnored(int signal) {
  struct sigaction now {};
  return ::sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

/// SIGCHLD, and what a user ends programs with; nohup and background jobs ignore some of these, and that
/// stays so.
sigset_t awaitedSignals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGCHLD);
  for (const int signal : kEndings)
    if (!isIgnored(signal)) sigaddset(&set, signal);
  return set;
}

/// Ends this process as `signal` ends others.
[[noreturn]] void dieOf(int signal) {
  std::signal(signal, SIG_DFL);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  ::sigprocmask(SIG_UNBLOCK, &set, nullptr);
  std::raise(signal);
  ::_exit(128 + signal);
}

std::string whatIsWritten() {
  const std::string files = ledger->written();
  return files.empty() ? ", nothing written" : "; written: " + files;
}

void wipeProgress() {
  if (::isatty(STDERR_FILENO)) drawError("\r\033[K");
}

void sayEnd(const std::string& what) {
  wipeProgress();
  complain(what + whatIsWritten());
}

std::string whileDoing() {
  const std::string phase = ledger->phase();
  return phase.empty() ? "" : " while " + phase;
}

/// Of a worker that nobody wanted to end.
std::string explainCrash(int signal, const std::optional<std::uint64_t>& limit) {
  const char* const name = ::sigabbrev_np(signal);
  const std::string how = fmt::format("SIG{}{}", name ? name : std::to_string(signal), whileDoing());
  if (limit)
    return fmt::format("out of memory? A library or driver ended the program ({}), which has {} (ulimit -v)",
                       how, formatBytes(*limit));
  if (signal == SIGKILL)
    return fmt::format("ended from outside ({}), as systems do that run out of memory", how);
  return fmt::format("a crash in a library or the OpenCL driver ended the program ({})", how);
}

class Guard {
 public:
  Guard(pid_t worker, const sigset_t& awaited) : worker_(worker), awaited_(awaited) {}

  int wait() {
    for (;;) {
      if (const auto status = ended()) return explain(*status);
      siginfo_t info{};
      const timespec step{0, 100'000'000};
      const int signal = limit_ ? ::sigtimedwait(&awaited_, &info, &step) : ::sigwaitinfo(&awaited_, &info);
      if (std::find(kEndings.begin(), kEndings.end(), signal) != kEndings.end()) askToEnd(signal);
      // Outside the phases it waits for people: for who reads its standard output.
      const bool starved = limit_ && starvation_.isStarved(worker_, *limit_);
      if (starved && !ledger->phase().empty()) return endStarved();
    }
  }

 private:
  std::optional<int> ended() const {
    int status = 0;
    return ::waitpid(worker_, &status, WNOHANG) == worker_ ? std::optional(status) : std::nullopt;
  }

  void kill() const {
    ::kill(worker_, SIGKILL);
    while (::waitpid(worker_, nullptr, 0) < 0 && errno == EINTR) continue;
  }

  void askToEnd(int signal) {
    if (asked_ != 0 || !ledger->answers()) endBy(signal);
    asked_ = signal;
    ledger->wantEnd();
    wipeProgress();
    complain("interrupted: what there is will be written; the next signal ends at once");
  }

  /// Files have no name before they are whole: nothing half done stays.
  [[noreturn]] void endBy(int signal) const {
    kill();
    sayEnd("interrupted");
    dieOf(signal);
  }

  int endStarved() const {
    kill();
    sayEnd(fmt::format("out of memory{}: the limit is {} (ulimit -v), and a library waits for ever",
                       whileDoing(), formatBytes(*limit_)));
    return 1;
  }

  int explain(int status) const {
    if (asked_ != 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0) dieOf(asked_);
    if (WIFEXITED(status)) {
      // Compilers leave by exit() where they cannot write.
      if (WEXITSTATUS(status) != 0 && !ledger->isExplained())
        sayEnd(fmt::format("a library or the OpenCL driver left the program{}", whileDoing()));
      return WEXITSTATUS(status);
    }
    const int signal = WTERMSIG(status);
    // The reader of standard output has gone, or a terminal signals both processes.
    if (signal == SIGPIPE || signal == SIGQUIT) dieOf(signal);
    if (std::find(kEndings.begin(), kEndings.end(), signal) != kEndings.end()) {
      sayEnd("interrupted");
      dieOf(signal);
    }
    sayEnd(explainCrash(signal, limit_));
    return 1;
  }

  pid_t worker_;
  sigset_t awaited_;
  std::optional<std::uint64_t> limit_ = addressLimit();
  Starvation starvation_;
  int asked_ = 0;  ///< the signal that the worker answers
};

}  // namespace

int runGuarded(const std::function<int()>& program) {
  // A write past a limit becomes an ordinary error.
  std::signal(SIGXFSZ, SIG_IGN);
  void* const page =
      ::mmap(nullptr, sizeof(Ledger), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED) return program();
  ledger = new (page) Ledger;
  const sigset_t awaited = awaitedSignals();
  sigset_t before;
  ::sigprocmask(SIG_BLOCK, &awaited, &before);
  const pid_t guard = ::getpid();
  const pid_t worker = ::fork();
  if (worker > 0) return Guard(worker, awaited).wait();
  ::sigprocmask(SIG_SETMASK, &before, nullptr);
  if (worker == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != guard) ::_exit(1);  // it ended before the line above
    ledger->guardIt();
  }
  return program();
}

void nowDoing(const std::string& phase) {
  if (ledger) ledger->doing(phase);
}

void answerSignals() {
  if (!ledger || !ledger->isGuarded()) return;
  // A terminal sends them to both processes.
  for (const int signal : kEndings) std::signal(signal, SIG_IGN);
  ledger->answer();
}

bool endIsWanted() { return ledger && ledger->isEndWanted(); }

void haveExplained() {
  if (ledger) ledger->explain();
}

void haveWritten(const std::string& file) {
  if (ledger) ledger->wrote(file);
}

}  // namespace whittle::cli
