// The files that were opened last, kept from one start to the next.
#pragma once

#include <filesystem>
#include <vector>

namespace whittle::view {

inline constexpr std::size_t kRecentFiles = 12;

class RecentFiles {
 public:
  /// `store`: a text file with a path on each line, the newest first; what cannot be read is no list. Empty:
  /// none is kept.
  explicit RecentFiles(std::filesystem::path store);

  /// Absolute, the newest first, at most kRecentFiles, whether they are still there or not.
  const std::vector<std::filesystem::path>& files() const { return files_; }
  /// Puts `file` first and writes the list, with its folder where there is none. A list that cannot be
  /// written is no fault: it lasts as long as this object.
  void add(const std::filesystem::path& file);

 private:
  std::filesystem::path store_;
  std::vector<std::filesystem::path> files_;
};

/// $XDG_STATE_HOME/whittle/recent, ~/.local/state/whittle/recent (XDG Base Directory Specification 0.8);
/// empty where there is neither.
std::filesystem::path recentFilesStore();

}  // namespace whittle::view
