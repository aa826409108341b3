// What the loader, the analysis and the renderer want the user to know without stopping.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace whittle {

/// Collected while loading; printed by the command line, one line each. A warning says that something in the
/// file was wrong, dropped or ignored; a note says what was chosen on the user's behalf.
struct Notices {
  std::vector<std::string> warnings;
  std::vector<std::string> notes;
  std::vector<std::filesystem::path> files;  ///< that the scene's file asked for, besides itself
  std::vector<std::string> variants;         ///< of its materials, by name, which may be empty

  /// What was compressed in the file.
  struct Unpacked {
    std::string extension;
    std::uint64_t parts = 0;  ///< buffer views, or triangle meshes
    std::uint64_t packedBytes = 0, bytes = 0;
  };
  std::vector<Unpacked> unpacked;  ///< one for each extension

  /// Adds a part to what its extension comes to.
  void unpack(std::string_view extension, std::uint64_t packedBytes, std::uint64_t bytes) {
    auto found = std::find_if(unpacked.begin(), unpacked.end(),
                              [&](const Unpacked& u) { return u.extension == extension; });
    if (found == unpacked.end()) found = unpacked.insert(found, Unpacked{std::string(extension)});
    ++found->parts;
    found->packedBytes += packedBytes;
    found->bytes += bytes;
  }
  void warn(std::string text) { warnings.push_back(std::move(text)); }
  void note(std::string text) { notes.push_back(std::move(text)); }
};

}  // namespace whittle
