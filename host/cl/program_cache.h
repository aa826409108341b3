// Device binaries of programs on disk: what makes a start without a compiler. One file for each program, in a
// folder of our own; each holds its key, a checksum of its contents, and what it is for.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace whittle {

class ProgramCache {
 public:
  /// Room for some ten versions of the general programs, of 3 MB each.
  static constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20;

  /// `folder` need not be there. `most`: bytes of all entries.
  explicit ProgramCache(std::filesystem::path folder, std::uint64_t most = kMostBytes);

  const std::filesystem::path& folder() const { return folder_; }
  std::uint64_t most() const { return most_; }

  /// The binary that was stored under `key`. One that is damaged, or of another format, is removed and counts
  /// as not there. An entry that is found is the one used last.
  std::optional<std::vector<unsigned char>> load(const std::string& key) const;
  /// Whether there is an entry, whole or not.
  bool has(const std::string& key) const;
  /// Puts it there whole or not at all, and takes out those that were used longest ago until all have room.
  /// `what`: for people, in one line. Throws UnwritableFile. Processes may store and load at once.
  void store(const std::string& key, const std::string& what, std::span<const unsigned char> binary) const;
  /// Takes an entry out, as one that the driver refuses.
  void remove(const std::string& key) const;

  struct Entry {
    std::string what;
    std::uint64_t bytes = 0;                 ///< of its file
    std::chrono::seconds age{0}, unused{0};  ///< since it was made, and since it was last used
  };
  /// The one used last comes first; files that are no entries are left out.
  std::vector<Entry> entries() const;
  /// Removes all entries, and what killed writers left; returns how many entries there were.
  std::size_t clear() const;

 private:
  std::filesystem::path fileOf(const std::string& key) const;
  void makeRoom() const;

  std::filesystem::path folder_;
  std::uint64_t most_;
};

/// Of a text, 16 hexadecimal digits; the same in every process.
std::string stableHash(const std::string& text);

}  // namespace whittle
