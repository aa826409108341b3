// See recent_files.h.
#include "view/recent_files.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <span>
#include <string>
#include <utility>

#include "scene/whole_file.h"

namespace whittle::view {

namespace fs = std::filesystem;

RecentFiles::RecentFiles(fs::path store) : store_(std::move(store)) {
  std::error_code error;
  if (store_.empty() || !fs::is_regular_file(store_, error)) return;
  std::ifstream in(store_);
  for (std::string line; files_.size() < kRecentFiles && std::getline(in, line);)
    if (fs::path(line).is_absolute()) files_.emplace_back(line);
}

void RecentFiles::add(const fs::path& file) {
  std::error_code error;
  const fs::path whole = fs::absolute(file, error).lexically_normal();
  // A line is a path.
  if (error || whole.native().find('\n') != std::string::npos) return;
  std::erase(files_, whole);
  files_.insert(files_.begin(), whole);
  if (files_.size() > kRecentFiles) files_.resize(kRecentFiles);
  if (store_.empty()) return;
  fs::create_directories(store_.parent_path(), error);
  std::string text;
  for (const auto& f : files_) text.append(f.native()).push_back('\n');
  try {
    writeWholeFile(store_, std::as_bytes(std::span(text)));
  } catch (const UnwritableFile&) {
    store_.clear();  // as said in the header
  }
}

fs::path recentFilesStore() {
  const auto folderOf = [](const char* variable) {
    const char* const value = std::getenv(variable);
    return value && fs::path(value).is_absolute() ? fs::path(value) : fs::path();
  };
  if (const fs::path state = folderOf("XDG_STATE_HOME"); !state.empty()) return state / "whittle" / "recent";
  if (const fs::path home = folderOf("HOME"); !home.empty())
    return home / ".local" / "state" / "whittle" / "recent";
  return {};
}

}  // namespace whittle::view
