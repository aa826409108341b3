#include "cli/output_writer.h"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>

#include "cli/guard.h"
#include "cli/outputs.h"
#include "cli/speech.h"
#include "report/printable.h"
#include "scene/input_error.h"
#include "scene/whole_file.h"

namespace whittle::cli {
namespace {

namespace fs = std::filesystem;

/// `name` in `folder`, with a number before its extension if that is taken.
fs::path freeName(const fs::path& folder, const fs::path& name) {
  std::error_code error;
  fs::path free = folder / name;
  for (int i = 1; fs::exists(fs::symlink_status(free, error)); ++i)
    free = folder / fmt::format("{}-{}{}", name.stem().string(), i, name.extension().string());
  return free;
}

/// Where a file goes that cannot go where it should, best first.
std::vector<fs::path> refuges(const fs::path& file) {
  std::vector<fs::path> folders;
  std::error_code error;
  const fs::path lost = fs::absolute(file, error).parent_path();
  const auto offer = [&](const fs::path& folder) {
    if (!error && fs::is_directory(folder, error) && folder != lost) folders.push_back(folder);
    error.clear();
  };
  offer(fs::current_path(error));
  offer(fs::temp_directory_path(error));
  return folders;
}

}  // namespace

void OutputWriter::add(const fs::path& file, const std::string& remark, const Write& write) {
  try {
    write(file);
    wrote(file, remark);
    return;
  } catch (const InputError& e) {  // its folder has vanished, or became a file
    rescue(file, remark, write, e.what());
  } catch (const UnwritableFile& e) {
    rescue(file, remark, write, e.what());
  } catch (const std::exception& e) {  // no place would help
    complain(e.what());
  }
  complete_ = false;
}

void OutputWriter::wrote(const fs::path& file, const std::string& remark) {
  if (!isStandardOutput(file)) haveWritten(file.string());
  summary_ += fmt::format("wrote {}{}\n", printableLine(file.string()), remark);
}

void OutputWriter::rescue(const fs::path& file, const std::string& remark, const Write& write,
                          const std::string& problem) {
  for (const fs::path& folder : refuges(file)) {
    const fs::path there = freeName(folder, file.filename());
    try {
      write(there);
    } catch (const std::exception&) {
      continue;
    }
    wrote(there, remark);
    complain(fmt::format("{}; it is in {} instead", problem, there.string()));
    return;
  }
  complain(problem);
}

}  // namespace whittle::cli
