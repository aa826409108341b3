// Reads a file and splits a .glb into its chunks.
#include "gltf/container.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "gltf/json_cost.h"
#include "gltf/uri.h"
#include "scene/byte_counts.h"

namespace whittle::gltf {

namespace {

std::uint32_t littleEndian(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
  return value;
}

constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

/// Splits a .glb into its JSON text and, into `document`, its BIN chunk.
std::string_view splitBinary(Document& document) {
  const std::span<const std::byte> file(document.file);
  if (file.size() < 20) document.fail("the .glb is truncated: it ends within its header");
  const std::uint32_t version = littleEndian(file, 4);
  if (version != 2) {
    document.fail(
        fmt::format("is .glb version {}; Whittle reads glTF 2.0 (convert the file first)", version));
  }
  const std::uint32_t length = littleEndian(file, 8);
  if (length > file.size()) {
    document.fail(fmt::format("the .glb is truncated: {} bytes of {}", file.size(), length));
  }
  std::string_view json;
  bool hasJson = false;
  // Chunk headers are eight bytes; a shorter rest is padding.
  for (std::size_t at = 12; at + 8 <= length;) {
    const std::size_t size = littleEndian(file, at);
    const std::uint32_t type = littleEndian(file, at + 4);
    if (size > length - at - 8) document.fail("the .glb is damaged: a chunk reaches beyond its end");
    const auto chunk = file.subspan(at + 8, size);
    if (!hasJson) {
      if (type != kJsonChunk) document.fail("the .glb is damaged: its first chunk is not JSON");
      json = asText(chunk);
      hasJson = true;
    } else if (type == kBinaryChunk && !document.hasBinary) {
      document.binary = chunk;
      document.hasBinary = true;
    }
    at += 8 + size;
  }
  if (!hasJson) document.fail("the .glb has no JSON chunk");
  while (!json.empty() && (json.back() == '\0' || json.back() == ' ')) json.remove_suffix(1);
  return json;
}

Json parseJson(const Document& document, std::string_view text) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) document.fail("is empty");
  if (isLfsPointer(text)) document.fail("is a git-lfs pointer, not the file itself (run git lfs pull)");
  const JsonShape shape = shapeOf(text);
  if (shape.isTooDeep) document.fail("its JSON is nested deeper than any glTF file needs");
  document.pass(shape.bytes, fmt::format("its JSON of {}", formatBytes(text.size())));
  try {
    return Json::parse(text);
  } catch (const Json::exception& e) {
    std::string_view what = e.what();  // "[json.exception.parse_error.101] parse error at line 1, …"
    if (const auto end = what.find("] "); end != std::string_view::npos) what.remove_prefix(end + 2);
    document.fail(fmt::format("not a glTF file: its JSON cannot be read ({})", what));
  }
}

}  // namespace

std::string_view asText(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::optional<std::string> readStart(const std::filesystem::path& path, std::uint64_t most, Bytes& bytes) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) return "does not exist";
  if (!std::filesystem::status_known(status)) return "cannot be read: " + error.message();
  if (std::filesystem::is_directory(status)) return "is a folder, not a file";
  if (!std::filesystem::is_regular_file(status)) return "is not a regular file";
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return "cannot be read: " + error.message();
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return "cannot be read: " + std::generic_category().message(errno);
  bytes.resize(std::min<std::uintmax_t>(size, most));
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (stream.gcount() != static_cast<std::streamsize>(bytes.size())) return "cannot be read to its end";
  return std::nullopt;
}

std::string_view readText(Document& document) {
  if (document.file.empty()) document.fail("is empty");
  const bool isBinary = asText(document.file).starts_with("glTF");
  return isBinary ? splitBinary(document) : asText(document.file);
}

Json readContainer(Document& document) { return parseJson(document, readText(document)); }

}  // namespace whittle::gltf
