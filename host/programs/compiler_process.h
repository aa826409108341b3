// A second process that compiles kernels into the folder where the platform keeps them, while the first
// compiles others.
#pragma once

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

/// The second process: `arguments` are those behind kCompilerCommand. Throws what compiling throws.
void compilerProcessMain(const std::vector<std::string>& arguments);

}  // namespace whittle
