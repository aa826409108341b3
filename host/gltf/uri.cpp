// URIs of buffers and images: base64, percent signs, files beside the scene.
#include "gltf/uri.h"

#include <algorithm>
#include <cctype>
#include <cstdint>

namespace whittle::gltf {

namespace {

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

int base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;  // '-' and '_': the alphabet for URLs
  if (c == '/' || c == '_') return 63;
  return -1;
}

std::optional<std::vector<std::byte>> decodeBase64(std::string_view text) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int have = 0;
  for (const char c : text) {
    const int digit = base64Digit(c);
    if (digit < 0) return std::nullopt;
    bits = (bits << 6 | static_cast<std::uint32_t>(digit)) & 0xffffU;
    have += 6;
    if (have >= 8) {
      have -= 8;
      bytes.push_back(static_cast<std::byte>(bits >> have & 0xffU));
    }
  }
  return bytes;
}

/// Whether `text` begins with `start`, which is in lower case; case does not count in schemes (RFC
/// 3986, 3.1).
bool beginsWith(std::string_view text, std::string_view start) {
  const auto isSame = [](char lower, char c) { return lower == std::tolower(static_cast<unsigned char>(c)); };
  return text.size() >= start.size() && std::equal(start.begin(), start.end(), text.begin(), isSame);
}

bool isBase64(std::string_view mediaType) {
  constexpr std::string_view kEnd = ";base64";
  return mediaType.size() >= kEnd.size() &&
         beginsWith(mediaType.substr(mediaType.size() - kEnd.size()), kEnd);
}

/// "file:///a" and "file://localhost/a" mean /a; "file://a" and "file:a", which many write, a file a here.
std::string_view withoutFileScheme(std::string_view uri) {
  constexpr std::string_view kScheme = "file:", kHere = "localhost/";
  if (!beginsWith(uri, kScheme)) return uri;
  uri.remove_prefix(kScheme.size());
  if (!uri.starts_with("//")) return uri;
  uri.remove_prefix(2);
  return beginsWith(uri, kHere) ? uri.substr(kHere.size() - 1) : uri;
}

bool isThere(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored) && !std::filesystem::is_directory(path, ignored);
}

std::vector<std::byte> toBytes(std::string_view text) {
  std::vector<std::byte> bytes;
  bytes.reserve(text.size());
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
  return bytes;
}

}  // namespace

bool isDataUri(std::string_view uri) { return beginsWith(uri, "data:"); }

bool isAbsoluteUri(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  if (colon == std::string_view::npos || colon < 2 || isDataUri(uri) || beginsWith(uri, "file:")) {
    return false;
  }
  for (const char c : uri.substr(0, colon)) {
    const bool schemeCharacter =
        std::isalnum(static_cast<unsigned char>(c)) || c == '+' || c == '-' || c == '.';
    if (!schemeCharacter) return false;
  }
  return uri.substr(colon).starts_with("://");
}

std::optional<std::vector<std::byte>> decodeDataUri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (!isDataUri(uri) || comma == std::string_view::npos) return std::nullopt;
  const std::string_view kind = uri.substr(0, comma);
  const std::string_view body = uri.substr(comma + 1);
  if (!isBase64(kind)) return toBytes(percentDecode(body));
  // Percent-encoded padding ("%3D") is legal in a URI.
  return body.find('%') == std::string_view::npos ? decodeBase64(body) : decodeBase64(percentDecode(body));
}

std::string percentDecode(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = text[i] == '%' && i + 2 < text.size() ? hexDigit(text[i + 1]) : -1;
    const int low = high >= 0 ? hexDigit(text[i + 2]) : -1;
    if (low >= 0) {
      out.push_back(static_cast<char>(high * 16 + low));
      i += 2;
    } else {
      out.push_back(text[i]);
    }
  }
  return out;
}

LocalFile resolveUri(const std::filesystem::path& folder, std::string_view uri) {
  const std::string_view path = withoutFileScheme(uri);
  std::vector<std::string> readings;
  for (const std::string_view text : {uri, path, path.substr(0, path.find_first_of("?#"))}) {
    readings.push_back(percentDecode(text));
    readings.emplace_back(text);
  }
  for (const std::string& reading : readings) {
    if (isThere(folder / reading)) return {folder / reading};
  }
  for (std::string& reading : readings) {
    std::replace(reading.begin(), reading.end(), '\\', '/');
    if (isThere(folder / reading)) return {folder / reading, true};
  }
  return {folder / percentDecode(path)};
}

bool isLfsPointer(std::string_view start) {
  return start.starts_with("version https://git-lfs.github.com/spec/");
}

}  // namespace whittle::gltf
