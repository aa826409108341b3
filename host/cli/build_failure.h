// What a person is told where kernels do not compile.
#pragma once

#include <filesystem>

#include "cl/error.h"

namespace whittle::cli {

/// Throws std::runtime_error with the first error in one line. Whoever reads kernels from a folder
/// works on them: the whole log follows, indented. For others it goes to a file beside the
/// temporary ones, which the line names.
[[noreturn]] void explainBuildFailure(const BuildError& e, const std::filesystem::path& kernelFolder);

}  // namespace whittle::cli
