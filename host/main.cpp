// Parse, run, exit status; the only place that catches. 0 done, 1 the run failed, 2
// wrong usage or unusable input.
#include <unistd.h>

#include <atomic>
#include <exception>
#include <new>
#include <stdexcept>
#include <system_error>

#include "cli/application.h"
#include "cli/build_failure.h"
#include "cli/guard.h"
#include "cli/speech.h"
#include "programs/compiler_process.h"
#include "scene/input_error.h"

namespace {

/// Not an exception: where the driver asks for memory it would pass through code that holds its locks, and
/// our way out would wait for them for ever. What is written takes its name when it is whole, so that nothing
/// half done stays.
[[noreturn]] void endForLackOfMemory() {
  static constexpr char kText[] =
      "whittle: out of memory; a smaller picture, --wavefront or scene needs less\n";
  static std::atomic<bool> isEnding = false;
  while (isEnding.exchange(true)) ::pause();  // several threads may run out of it at once
  whittle::cli::haveExplained();
  [[maybe_unused]] const auto ignored = ::write(STDERR_FILENO, kText, sizeof(kText) - 1);
  ::_exit(1);
}

/// A library that cannot start a thread, or throws where nobody may: mostly for lack of memory.
[[noreturn]] void endForLackOfThreads() {
  whittle::cli::complain("a library cannot go on: out of memory or of threads?");
  ::_exit(1);
}

int work(int argc, char** argv) {
  std::set_new_handler(endForLackOfMemory);
  std::set_terminate(endForLackOfThreads);
  const auto fail = [](const char* text, int status) {
    whittle::cli::complain(text);
    return status;
  };
  try {
    return whittle::cli::runApplication(argc, argv);
  } catch (const whittle::InputError& e) {
    return fail(e.what(), 2);
  } catch (const std::invalid_argument& e) {
    return fail(e.what(), 2);
  } catch (const whittle::cli::BuildFailure& e) {
    fail(e.what(), 1);
    whittle::cli::tellError(e.log);
    return 1;
  } catch (const std::bad_alloc&) {
    return fail("out of memory; a smaller picture, --wavefront or scene needs less", 1);
  } catch (const std::system_error& e) {
    if (e.code() != std::errc::resource_unavailable_try_again) return fail(e.what(), 1);
    return fail("no more threads: out of memory, or of what this user may run (ulimit -u)", 1);
  } catch (const std::exception& e) {
    return fail(e.what(), 1);
  }
}

}  // namespace

int main(int argc, char** argv) {
  whittle::cli::settleStreams();
  // Its parent is guarded, and waits for it.
  if (argc > 1 && argv[1] == std::string(whittle::kCompilerCommand)) return work(argc, argv);
  return whittle::cli::runGuarded([&] { return work(argc, argv); });
}
