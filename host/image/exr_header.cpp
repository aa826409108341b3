#include "image/exr_header.h"

#include <fmt/format.h>

#include <cstdint>
#include <string_view>

#include "image/byte_order.h"
#include "scene/input_error.h"

namespace whittle {
namespace {

/// What is left of the bytes; reading past their end empties it.
class Rest {
 public:
  explicit Rest(std::span<const std::byte> bytes)
      : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()) {}

  bool empty() const { return text_.empty(); }

  std::uint32_t integer() { return littleEndian(std::as_bytes(std::span(take(4)))); }

  /// Up to a zero, which is taken too.
  std::string_view name() {
    const std::size_t end = text_.find('\0');
    if (end == std::string_view::npos) return take(text_.size());
    const std::string_view name = take(end);
    take(1);
    return name;
  }

  Rest piece(std::size_t size) { return Rest(take(size)); }
  void skip(std::size_t size) { take(size); }

 private:
  explicit Rest(std::string_view text) : text_(text) {}

  std::string_view take(std::size_t size) {
    const std::string_view taken = text_.substr(0, size);
    text_.remove_prefix(taken.size());
    return taken;
  }

  std::string_view text_;
};

/// The value of an attribute of the type "chlist".
void checkChannels(Rest list, const std::string& file) {
  constexpr std::uint32_t kTypes = 3;
  constexpr std::size_t kBehindType = 12;  // linear or not, three spare bytes, two rates of samples
  while (!list.empty()) {
    const std::string_view channel = list.name();
    if (channel.empty() || list.empty()) return;
    const std::uint32_t type = list.integer();
    if (type >= kTypes)
      throw InputError(fmt::format("{}: channel {} has samples of type {}, which OpenEXR does not define",
                                   file, channel, type));
    list.skip(kBehindType);
  }
}

}  // namespace

bool isExrFile(std::span<const std::byte> bytes) {
  constexpr std::uint32_t kMagic = 20000630;
  return bytes.size() >= 4 && Rest(bytes).integer() == kMagic;
}

void checkSampleTypes(std::span<const std::byte> bytes, const std::string& name) {
  constexpr std::uint32_t kSeveralParts = 0x1000;
  if (!isExrFile(bytes)) return;
  Rest rest(bytes.subspan(4));
  const bool hasSeveral = (rest.integer() & kSeveralParts) != 0;
  // A header is attributes and an empty name; the headers of several parts end with an empty one.
  for (bool isFirst = true; !rest.empty();) {
    const std::string_view attribute = rest.name();
    if (attribute.empty()) {
      if (isFirst || !hasSeveral) return;
      isFirst = true;
      continue;
    }
    isFirst = false;
    const std::string_view type = rest.name();
    const std::uint32_t size = rest.integer();
    const Rest value = rest.piece(size);
    if (type == "chlist") checkChannels(value, name);
  }
}

}  // namespace whittle
