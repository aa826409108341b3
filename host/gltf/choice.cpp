// See choice.h.
#include "gltf/choice.h"

#include <fmt/format.h>

#include <charconv>

namespace whittle::gltf {

std::size_t indexCalled(const Document& document, std::string_view what,
                        const std::vector<std::string>& names, const std::string& wanted) {
  constexpr std::size_t kLongestList = 150;  // characters after which no more are listed
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == wanted) return i;
    if (list.size() < kLongestList)
      list += fmt::format("{}{}{}", i > 0 ? ", " : "", i,
                          names[i].empty() ? " without a name" : quotedName(names[i]));
  }
  std::size_t number = 0;
  const char* end = wanted.data() + wanted.size();
  const auto [parsed, error] = std::from_chars(wanted.data(), end, number);
  if (error == std::errc() && parsed == end && number < names.size()) return number;
  document.fail(
      fmt::format("has no {}{} (it has: {})", what, quotedName(wanted), list.empty() ? "none" : list));
}

}  // namespace whittle::gltf
