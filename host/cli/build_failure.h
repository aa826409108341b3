// What a person is told where kernels do not compile.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "cl/error.h"

namespace whittle::cli {

/// One line, and what is to follow it: lines with their ends, or nothing.
struct BuildFailure : std::runtime_error {
  BuildFailure(const std::string& line, std::string following)
      : std::runtime_error(line), log(std::move(following)) {}
  std::string log;
};

/// Throws BuildFailure with the first error in its line. Whoever reads kernels from a folder works on them:
/// the whole log follows, indented. For others it goes to a file beside the temporary ones, which the line
/// names.
[[noreturn]] void explainBuildFailure(const BuildError& e, const std::filesystem::path& kernelFolder);

}  // namespace whittle::cli
