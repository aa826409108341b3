// Sizes are those of nlohmann::json over the C++ library and the allocator of GNU.
#include "gltf/json_cost.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace whittle::gltf {
namespace {

constexpr std::uint64_t kObject = 64;   ///< a std::map
constexpr std::uint64_t kMember = 96;   ///< its node: key and value
constexpr std::uint64_t kArray = 32;    ///< a std::vector
constexpr std::uint64_t kElement = 32;  ///< 16 bytes in a vector that doubled
constexpr std::uint64_t kText = 48;     ///< a std::string
constexpr std::size_t kShortText = 15;  ///< characters that need no memory of their own

std::uint64_t bytesOfText(std::size_t length) { return length > kShortText ? length + 16 : 0; }

}  // namespace

JsonShape shapeOf(std::string_view text) {
  constexpr int kDeepest = 200;
  JsonShape shape;
  std::uint64_t objects = 0, arrays = 0, members = 0, commas = 0, texts = 0;
  int depth = 0;
  std::size_t textBegin = 0;
  bool inText = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inText) {
      if (c == '\\') ++i;
      if (c != '"') continue;
      inText = false;
      shape.bytes += bytesOfText(i - textBegin);
    } else if (c == '"') {
      inText = true;
      textBegin = i;
      ++texts;
    } else if (c == '{' || c == '[') {
      ++(c == '{' ? objects : arrays);
      if (++depth > kDeepest) shape.isTooDeep = true;
    } else if (c == '}' || c == ']') {
      --depth;
    } else if (c == ':') {
      ++members;
    } else if (c == ',') {
      ++commas;
    }
  }
  // A value stands before each comma and at the end of each container; keys are texts as well.
  const std::uint64_t values = commas + objects + arrays;
  shape.bytes += kObject * objects + kArray * arrays + kMember * members +
                 kElement * (values - std::min(values, members)) + kText * (texts - std::min(texts, members));
  return shape;
}

std::uint64_t bytesOf(const nlohmann::json& json) {
  std::uint64_t bytes = 0;
  if (json.is_object()) {
    bytes = kObject;
    for (const auto& [key, value] : json.items()) bytes += kMember + bytesOfText(key.size()) + bytesOf(value);
  } else if (json.is_array()) {
    bytes = kArray;
    for (const auto& value : json) bytes += kElement + bytesOf(value);
  } else if (json.is_string()) {
    bytes = kText + bytesOfText(json.get_ref<const std::string&>().size());
  }
  return bytes;
}

}  // namespace whittle::gltf
