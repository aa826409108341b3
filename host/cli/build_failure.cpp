// A failed kernel build as one line of error, with the compiler's log beside it.
#include "cli/build_failure.h"

#include <fmt/format.h>
#include <unistd.h>

#include <exception>
#include <sstream>
#include <stdexcept>

#include "cli/outputs.h"

namespace whittle::cli {
namespace {

std::string indented(const std::string& log) {
  std::istringstream lines(log);
  std::string out;
  for (std::string line; std::getline(lines, line);) out += line.empty() ? "" : "    " + line + "\n";
  return out;
}

/// Where the log went, for the end of a line; nothing where no file can be written.
std::string logElsewhere(const std::string& log) {
  try {
    const auto file =
        std::filesystem::temp_directory_path() / fmt::format("whittle-kernels-{}.log", ::getpid());
    writeTextFile(file, log);
    return fmt::format("; the whole log is in {}", file.string());
  } catch (const std::exception&) {
    return "";
  }
}

}  // namespace

void explainBuildFailure(const BuildError& e, const std::filesystem::path& kernelFolder) {
  if (kernelFolder.empty()) throw BuildFailure(e.what() + logElsewhere(e.log()), "");
  throw BuildFailure(e.what(), indented(e.log()));
}

}  // namespace whittle::cli
