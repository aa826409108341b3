#include "report/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace whittle {
namespace {

/// A character of UTF-8 at the beginning of `text`: its bytes, 0 where there is none, and its code point.
struct Character {
  std::size_t bytes = 0;
  std::uint32_t code = 0;
};

/// RFC 3629: neither overlong forms, nor surrogates, nor more than 0x10ffff.
Character firstCharacter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  if (byte(0) < 0x80) return {1, byte(0)};
  const std::size_t bytes = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < bytes) return {};
  std::uint32_t code = byte(0) & (0xffU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fU);
  }
  const bool overlong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
  if (overlong || (code >= 0xd800 && code <= 0xdfff) || code > 0x10ffff) return {};
  return {bytes, code};
}

bool movesCursor(std::uint32_t code) {
  const bool control = code < 0x20 || (code >= 0x7f && code < 0xa0);
  const bool separates = code == 0x2028 || code == 0x2029;
  const bool turns = code == 0x061c || code == 0x200e || code == 0x200f ||
                     (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  return control || separates || turns;
}

std::string escaped(std::uint32_t code) {
  if (code == '\n') return "\\n";
  if (code == '\r') return "\\r";
  if (code == '\t') return "\\t";
  return code < 0x100 ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{{{:04x}}}", code);
}

/// What each character of the text shows as.
std::vector<std::string> shown(std::string_view text) {
  std::vector<std::string> characters;
  while (!text.empty()) {
    const Character c = firstCharacter(text);
    if (c.bytes == 0)
      characters.push_back(escaped(static_cast<std::uint8_t>(text[0])));
    else if (movesCursor(c.code))
      characters.push_back(escaped(c.code));
    else
      characters.emplace_back(text.substr(0, c.bytes));
    text.remove_prefix(c.bytes == 0 ? 1 : c.bytes);
  }
  return characters;
}

}  // namespace

std::string printableLine(std::string_view text, std::size_t most) {
  // Far more than can be shown: a name of a gigabyte is not taken apart.
  const std::size_t far = 4 * most;
  const bool isHuge = text.size() > 2 * far;
  const std::vector<std::string> head = shown(isHuge ? text.substr(0, far) : text);
  const std::vector<std::string> tail =
      isHuge ? shown(text.substr(text.size() - far)) : std::vector<std::string>{};
  std::string line;
  if (!isHuge && head.size() <= most) {
    for (const std::string& c : head) line += c;
    return line;
  }
  const std::vector<std::string>& end = isHuge ? tail : head;
  const std::size_t first = most * 2 / 3, last = most - first - 1;
  for (std::size_t i = 0; i < first; ++i) line += head[i];
  line += "…";
  for (std::size_t i = end.size() - last; i < end.size(); ++i) line += end[i];
  return line;
}

std::string printableLines(std::string_view text) {
  std::string lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines += printableLine(text.substr(at, end - at));
    if (end < text.size()) lines += '\n';
    at = end + 1;
  }
  return lines;
}

}  // namespace whittle
