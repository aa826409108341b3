// Words and numbers for people: thousands, durations, targets, columns, near misses.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/settings.h"

namespace whittle {

/// "709,726".
std::string formatInteger(std::uint64_t count);
/// Four significant digits without trailing zeros; no "-0".
std::string formatReal(double value);
/// A coordinate of something in a scene `size` metres across: as formatReal, with as many digits more as tell
/// it from a place a thousandth of the size away. 0 below a hundred-thousandth of it.
std::string formatCoordinate(double value, double size);
/// "0.8 s", "3:05 min", "2:10 h".
std::string formatSeconds(double seconds);
/// "12.3 Mrays/s", "850 krays/s".
std::string formatRate(double raysPerSecond);
/// A target error as it was asked for: "0.002 W/(m² sr)", "1 % of the mean".
std::string targetText(const Settings& settings);
/// Of what is traced: "640×360", "100×50 at 20,30 of 640×360".
std::string sizeText(const Settings& settings);
/// "1 light", "3 lights", "no lights".
std::string formatSome(std::uint64_t count, const std::string& one, const std::string& many);

/// Columns a terminal needs for UTF-8 text of single-width characters.
std::size_t columnsOf(const std::string& text);
/// Pads with blanks to `columns`.
std::string padded(const std::string& text, std::size_t columns);
/// Words of `text` in lines of at most `columns`; lines after the first start with `indent` blanks.
std::string wrapped(const std::string& text, std::size_t columns, std::size_t indent);

/// The candidate that a mistyped word is nearest to, or "" if none is near (Levenshtein 1966).
std::string closestWord(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace whittle
