// Words and numbers for people.
#include "report/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace whittle {
namespace {

std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

}  // namespace

std::string formatInteger(std::uint64_t count) {
  const std::string digits = std::to_string(count);
  std::string out;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) out.push_back(',');
    out.push_back(digits[i]);
  }
  return out;
}

std::string formatReal(double value) { return fmt::format("{:.4g}", value == 0.0 ? 0.0 : value); }

std::string formatCoordinate(double value, double size) {
  constexpr int kFewest = 4, kMost = 16;  // significant digits; a double has no more
  // What is far below the size is rounding of the file's transformations.
  if (!(std::abs(value) > 1e-5 * size)) return "0";
  if (!(size > 0.0)) return formatReal(value);
  const double places = std::floor(std::log10(std::abs(value))) - std::floor(std::log10(size));
  return fmt::format("{:.{}g}", value,
                     static_cast<int>(std::clamp(places + kFewest, 1.0 * kFewest, 1.0 * kMost)));
}

std::string formatSeconds(double seconds) {
  if (seconds < 1.0) return fmt::format("{:.3f} s", seconds);
  if (seconds < 60.0) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long>(seconds);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

std::string formatRate(double raysPerSecond) {
  return raysPerSecond >= 1e6 ? fmt::format("{:.2f} Mrays/s", raysPerSecond * 1e-6)
                              : fmt::format("{:.0f} krays/s", raysPerSecond * 1e-3);
}

std::string sizeText(const Settings& s) {
  const std::string whole = fmt::format("{}×{}", s.width, s.height);
  return s.crop
             ? fmt::format("{}×{} at {},{} of {}", s.crop->width, s.crop->height, s.crop->x, s.crop->y, whole)
             : whole;
}

std::string formatSome(std::uint64_t count, const std::string& one, const std::string& many) {
  if (count == 0) return "no " + many;
  return count == 1 ? "1 " + one : formatInteger(count) + " " + many;
}

std::size_t columnsOf(const std::string& text) {
  // Continuation bytes of UTF-8 are 10xxxxxx.
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string padded(const std::string& text, std::size_t columns) {
  const std::size_t width = columnsOf(text);
  return width < columns ? text + std::string(columns - width, ' ') : text;
}

std::string wrapped(const std::string& text, std::size_t columns, std::size_t indent) {
  std::istringstream in(text);
  std::string out, word;
  std::size_t used = 0;
  while (in >> word) {
    const std::size_t width = columnsOf(word);
    if (used > 0 && used + 1 + width > columns) {
      out += '\n';
      out.append(indent, ' ');
      used = 0;
    } else if (used > 0) {
      out += ' ';
      ++used;
    }
    out += word;
    used += width;
  }
  return out;
}

std::string closestWord(const std::string& word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const auto& candidate : candidates) {
    const std::size_t distance = editDistance(word, candidate);
    if (distance < least) least = distance, best = candidate;
  }
  return best;
}

std::string targetText(const Settings& s) {
  if (s.targetErrorRelative > 0.0) return formatReal(100.0 * s.targetErrorRelative) + " % of the mean";
  return formatReal(s.targetError) + " W/(m² sr)";
}

}  // namespace whittle
