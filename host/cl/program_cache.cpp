// An entry's file: kMagic, then a head of fixed size, then what it is for, then the binary. Its name is the
// hash of the key. It was made at its birth time as the head has it, and last used at its modification time.
#include "cl/program_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "scene/hash.h"
#include "scene/whole_file.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;
using WallClock = std::chrono::system_clock;

/// Its last digit is the version of the format.
constexpr std::array<char, 8> kMagic{'W', 'H', 'I', 'T', 'T', 'L', 'E', '1'};
constexpr const char* kEnding = ".program";

struct Head {
  std::uint64_t checksum = 0;   ///< of all that follows, and of the members below
  std::uint64_t keyCheck = 0;   ///< another hash of the key than the file's name
  std::int64_t madeAt = 0;      ///< seconds since 1970
  std::uint64_t whatBytes = 0;  ///< of the text
  std::uint64_t binaryBytes = 0;
};

std::uint64_t checksumOf(const Head& head, std::span<const unsigned char> rest) {
  const auto own = std::as_bytes(std::span(&head, 1)).subspan(sizeof(head.checksum));
  const std::array<std::uint64_t, 2> parts{hashOf(own), hashOf(std::as_bytes(rest))};
  return hashOf(std::as_bytes(std::span(parts)));
}

std::uint64_t keyCheckOf(const std::string& key) { return hashOf(std::as_bytes(std::span(key))); }

constexpr std::size_t kBeforeText = kMagic.size() + sizeof(Head);

std::optional<Head> readHead(std::istream& in) {
  std::array<char, kBeforeText> bytes{};
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in || !std::equal(kMagic.begin(), kMagic.end(), bytes.begin())) return std::nullopt;
  Head head;
  std::memcpy(&head, bytes.data() + kMagic.size(), sizeof(Head));
  return head;
}

std::chrono::seconds since(fs::file_time_type time) {
  return std::chrono::duration_cast<std::chrono::seconds>(fs::file_time_type::clock::now() - time);
}

struct File {
  fs::path path;
  std::uint64_t bytes = 0;
  fs::file_time_type used;
};

/// The one used last comes first.
std::vector<File> filesIn(const fs::path& folder) {
  std::vector<File> files;
  std::error_code error;
  fs::directory_iterator file(folder, error);
  for (; !error && file != fs::directory_iterator(); file.increment(error)) {
    std::error_code gone;
    if (file->path().extension() != kEnding || !file->is_regular_file(gone)) continue;
    const std::uint64_t bytes = file->file_size(gone);
    const auto used = file->last_write_time(gone);
    if (!gone) files.push_back({file->path(), bytes, used});
  }
  std::sort(files.begin(), files.end(), [](const File& a, const File& b) { return a.used > b.used; });
  return files;
}

/// What killed writers left (scene/whole_file.h).
bool isUnfinished(const std::string& name) { return name.starts_with(".whittle-"); }

}  // namespace

/// FNV-1a (Fowler, Noll, Vo), 64 bits.
std::string stableHash(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return fmt::format("{:016x}", hash);
}

ProgramCache::ProgramCache(fs::path folder, std::uint64_t most) : folder_(std::move(folder)), most_(most) {}

fs::path ProgramCache::fileOf(const std::string& key) const { return folder_ / (stableHash(key) + kEnding); }

bool ProgramCache::has(const std::string& key) const {
  std::error_code error;
  return fs::is_regular_file(fileOf(key), error);
}

std::optional<std::vector<unsigned char>> ProgramCache::load(const std::string& key) const {
  const fs::path path = fileOf(key);
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  std::error_code error;
  const std::uint64_t bytes = fs::file_size(path, error);
  const std::optional<Head> head = readHead(in);
  std::vector<unsigned char> rest;
  bool isWhole = !error && head && head->keyCheck == keyCheckOf(key) && head->whatBytes <= bytes &&
                 head->binaryBytes == bytes - kBeforeText - head->whatBytes;
  if (isWhole) {
    rest.resize(bytes - kBeforeText);
    in.read(reinterpret_cast<char*>(rest.data()), static_cast<std::streamsize>(rest.size()));
    isWhole = in && checksumOf(*head, rest) == head->checksum;
  }
  if (!isWhole) {
    fs::remove(path, error);
    return std::nullopt;
  }
  fs::last_write_time(path, fs::file_time_type::clock::now(), error);  // or it is an older one
  rest.erase(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(head->whatBytes));
  return rest;
}

void ProgramCache::store(const std::string& key, const std::string& what,
                         std::span<const unsigned char> binary) const {
  std::error_code error;
  fs::create_directories(folder_, error);
  sweepOldFiles(folder_, isUnfinished);
  std::vector<unsigned char> file(kBeforeText);
  file.reserve(kBeforeText + what.size() + binary.size());
  file.insert(file.end(), what.begin(), what.end());
  file.insert(file.end(), binary.begin(), binary.end());
  const auto now = std::chrono::duration_cast<std::chrono::seconds>(WallClock::now().time_since_epoch());
  Head head{0, keyCheckOf(key), now.count(), what.size(), binary.size()};
  head.checksum = checksumOf(head, std::span(file).subspan(kBeforeText));
  std::memcpy(file.data(), kMagic.data(), kMagic.size());
  std::memcpy(file.data() + kMagic.size(), &head, sizeof(Head));
  writeWholeFile(fileOf(key), std::as_bytes(std::span(file)));
  makeRoom();
}

/// The newest stays, however large it is.
void ProgramCache::makeRoom() const {
  std::uint64_t sum = 0;
  for (const File& file : filesIn(folder_)) {
    const bool isFirst = sum == 0;
    sum += file.bytes;
    std::error_code gone;
    if (!isFirst && sum > most_) fs::remove(file.path, gone);
  }
}

void ProgramCache::remove(const std::string& key) const {
  std::error_code error;
  fs::remove(fileOf(key), error);
}

std::vector<ProgramCache::Entry> ProgramCache::entries() const {
  std::vector<Entry> entries;
  for (const File& file : filesIn(folder_)) {
    std::ifstream in(file.path, std::ios::binary);
    const std::optional<Head> head = readHead(in);
    if (!head || head->whatBytes > file.bytes) continue;
    std::string what(head->whatBytes, ' ');
    in.read(what.data(), static_cast<std::streamsize>(what.size()));
    const auto made = WallClock::time_point(std::chrono::seconds(head->madeAt));
    const auto age = std::chrono::duration_cast<std::chrono::seconds>(WallClock::now() - made);
    entries.push_back({what, file.bytes, age, since(file.used)});
  }
  return entries;
}

std::size_t ProgramCache::clear() const {
  std::size_t removed = 0;
  for (const File& file : filesIn(folder_)) {
    std::error_code gone;
    removed += fs::remove(file.path, gone) ? 1 : 0;
  }
  sweepOldFiles(folder_, isUnfinished);
  return removed;
}

}  // namespace whittle
