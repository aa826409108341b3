// See edited_container.h. Container: glTF 2.0, 4.4.
#include "gltf/edited_container.h"

#include <fmt/format.h>

#include <limits>
#include <span>
#include <string_view>

#include "gltf/container.h"
#include "gltf/uri.h"

namespace whittle::gltf {
namespace {

constexpr std::size_t kHeader = 12, kChunkHeader = 8;

bool isBinary(const Document& document) { return asText(document.file).starts_with("glTF"); }

std::uint32_t wordAt(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
  return value;
}

void append(Bytes& bytes, std::uint32_t word) {
  for (std::size_t i = 0; i < 4; ++i) bytes.push_back(static_cast<std::byte>(word >> (8 * i) & 0xffU));
}
void append(Bytes& bytes, std::span<const std::byte> more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

/// What a path may not hold in a URI (RFC 3986); letters beyond ASCII stay, as most writers leave them.
std::string percentEncoded(std::string_view path) {
  std::string uri;
  for (const char c : path) {
    const auto code = static_cast<unsigned char>(c);
    if (code <= 0x20 || code == 0x7f || std::string_view("%?#\"<>\\^`{|}:").find(c) != std::string_view::npos)
      uri += fmt::format("%{:02X}", code);
    else
      uri += c;
  }
  return uri;
}

}  // namespace

std::filesystem::path freeName(const Document& document, const std::filesystem::path& wanted) {
  std::filesystem::path stem = wanted;
  if (wanted.empty()) {
    const std::filesystem::path file(document.name);
    stem = file.parent_path() / file.stem();
    stem += "-edited";
  } else if (const std::string ending = wanted.extension().string(); ending == ".glb" || ending == ".gltf") {
    stem.replace_extension();
  }
  const char* const ending = isBinary(document) ? ".glb" : ".gltf";
  for (int i = 1;; ++i) {
    std::filesystem::path name = stem;
    name += i == 1 ? std::string(ending) : fmt::format("-{}{}", i, ending);
    std::error_code error;
    if (!std::filesystem::exists(std::filesystem::symlink_status(name, error))) return name;
  }
}

void moveUris(const Document& document, const std::filesystem::path& folder, nlohmann::ordered_json& root) {
  const auto real = [](const std::filesystem::path& path) {
    std::error_code error;
    return std::filesystem::weakly_canonical(path.empty() ? "." : path, error);
  };
  const std::filesystem::path to = real(folder);
  if (real(document.folder) == to) return;
  for (const char* list : {"buffers", "images"}) {
    if (!root.contains(list)) continue;
    for (auto& thing : root[list]) {
      if (!thing.contains("uri") || !thing["uri"].is_string()) continue;
      const auto uri = thing["uri"].get<std::string>();
      if (isDataUri(uri) || isAbsoluteUri(uri)) continue;
      const std::filesystem::path file = real(resolveUri(document.folder, uri).path);
      thing["uri"] = percentEncoded(file.lexically_relative(to).generic_string());
    }
  }
}

Bytes containerWith(const Document& document, std::string json) {
  Bytes out;
  if (!isBinary(document)) {
    append(out, std::as_bytes(std::span(json)));
    return out;
  }
  while (json.size() % 4 != 0) json += ' ';
  const std::span<const std::byte> file(document.file);
  const auto others = file.first(wordAt(file, 8)).subspan(kHeader + kChunkHeader + wordAt(file, kHeader));
  const std::size_t length = kHeader + kChunkHeader + json.size() + others.size();
  if (length > std::numeric_limits<std::uint32_t>::max()) document.fail("its copy would be larger than 4 GB");
  out.reserve(length);
  append(out, file.first(8));  // magic and version
  append(out, static_cast<std::uint32_t>(length));
  append(out, static_cast<std::uint32_t>(json.size()));
  append(out, wordAt(file, kHeader + 4));  // that the chunk is JSON
  append(out, std::as_bytes(std::span(json)));
  append(out, others);
  return out;
}

}  // namespace whittle::gltf
