// Text that comes from files, drivers and the command line, made fit for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace whittle {

/// How much of one line is shown: what is longer loses its middle.
inline constexpr std::size_t kLongestLine = 600;

/// One line: control characters (C0, DEL, C1), line and paragraph separators, characters that change the
/// direction of text (Unicode TR36, "bidirectional text spoofing"), and bytes that are no UTF-8 appear as
/// escapes (\n, \x1b, \u{202e}); of more than `most` characters the middle is left out, since a message ends
/// with what to do.
std::string printableLine(std::string_view text, std::size_t most = kLongestLine);

/// Several lines: as printableLine, line by line, with the ends of the lines kept.
std::string printableLines(std::string_view text);

}  // namespace whittle
