#include "scene/byte_counts.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>

namespace whittle {
namespace {

constexpr std::string_view kPrefixes = "KMGT";

/// What the unit behind a number stands for: 1000^n or, with an i, 1024^n; 0 for anything else.
double factorOf(std::string_view unit) {
  if (unit.empty() || unit == "B" || unit == "b") return 1.0;
  const auto power = kPrefixes.find(static_cast<char>(std::toupper(static_cast<unsigned char>(unit[0]))));
  if (power == std::string_view::npos) return 0.0;
  unit.remove_prefix(1);
  const bool isBinary = unit.starts_with('i');
  if (isBinary) unit.remove_prefix(1);
  if (!unit.empty() && unit != "B" && unit != "b") return 0.0;
  double factor = 1.0;
  for (std::size_t i = 0; i <= power; ++i) factor *= isBinary ? 1024.0 : 1000.0;
  return factor;
}

}  // namespace

std::string formatBytes(std::uint64_t bytes) {
  static const char* const kUnits[] = {"B", "kB", "MB", "GB", "TB"};
  double value = static_cast<double>(bytes);
  int unit = 0;
  while (value >= 1000.0 && unit < 4) value /= 1000.0, ++unit;
  return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.3g} {}", value, kUnits[unit]);
}

std::optional<std::uint64_t> parseBytes(std::string_view text) {
  double number = 0.0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
  if (error != std::errc()) return std::nullopt;
  std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
  if (unit.size() > 1 && unit.front() == ' ') unit.remove_prefix(1);
  const double bytes = number * factorOf(unit);
  constexpr double kMost = 9007199254740992.0;
  if (!(bytes >= 1.0 && bytes <= kMost)) return std::nullopt;
  return static_cast<std::uint64_t>(bytes);
}

}  // namespace whittle
