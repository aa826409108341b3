// What the loader, the analysis and the renderer want the user to know without stopping.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace whittle {

/// Collected while loading; printed by the command line, one line each. A warning says that something in the
/// file was wrong, dropped or ignored; a note says what was chosen on the user's behalf.
struct Notices {
  std::vector<std::string> warnings;
  std::vector<std::string> notes;
  std::vector<std::filesystem::path> files;  ///< that the scene's file asked for, besides itself

  void warn(std::string text) { warnings.push_back(std::move(text)); }
  void note(std::string text) { notes.push_back(std::move(text)); }
};

}  // namespace whittle
