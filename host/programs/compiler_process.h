// A second process that compiles kernels into the folder where the platform keeps them, while the first
// compiles others.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "programs/kernel_programs.h"

namespace whittle {

/// What the second process is told on its command line.
struct CompilerJob {
  int device = 0;  ///< as listed by `whittle devices`
  std::uint64_t features = 0;
  CompileTarget target;
  std::optional<std::filesystem::path> folder;  ///< of the kernels; unset: the binary's
  std::vector<std::string> stages;              ///< that will be launched
  /// Of the programs: those before it are somebody else's. 0: it is a CompilerRun.
  int first = 1;
  /// Nobody waits: it takes a processor only when nothing else wants it, ends at once where another such
  /// process compiles already, and is ended by the system after some minutes.
  bool isBeside = false;
};

/// First word of its command line; no command for people.
inline constexpr const char* kCompilerCommand = "compile-kernels";

/// The job as words behind kCompilerCommand, and back; throws std::invalid_argument for too few.
std::vector<std::string> commandLine(const CompilerJob& job);
CompilerJob compilerJob(const std::vector<std::string>& words);

/// Starts `binary` on all programs of the job but the first. Returns what waits for its end; whatever goes
/// wrong there goes wrong again, and is said, when its work is done once more here. Nothing is started where
/// that fails.
std::function<void()> startCompilerProcess(const std::filesystem::path& binary, const CompilerJob& job);

/// One that is started on all programs of its job (CompilerJob::first 0) and that nobody has to wait for. It
/// ends when this object does, or its process, unless that let it go.
class CompilerRun {
 public:
  /// Nothing where it cannot be started.
  static std::optional<CompilerRun> start(const std::filesystem::path& binary, CompilerJob job);
  ~CompilerRun();
  CompilerRun(CompilerRun&& other) noexcept;
  CompilerRun& operator=(CompilerRun&&) = delete;

  /// Its exit status once it has ended.
  std::optional<int> ended();
  /// It goes on when its starter ends, so that the next run finds what it makes.
  void letGo() const;

 private:
  CompilerRun(pid_t process, int life) : process_(process), life_(life) {}
  pid_t process_;
  int life_;  ///< the end of a pipe whose other end is its standard input
  std::optional<int> status_;
};

/// The second process: `arguments` are those behind kCompilerCommand. Throws what compiling throws.
void compilerProcessMain(const std::vector<std::string>& arguments);

}  // namespace whittle
