// Names and messages made fit for a terminal: what may move its cursor or turn its text is an escape, the
// rest stays.
#include "report/printable.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

TEST(Printable, WordsOfAnyLanguageStay) {
  for (const char* text : {"", "Kamera 1", "ø Ærø", "写真 'a'", "é", "🙂 \"x\"", "¡\u00a0!"})
    EXPECT_EQ(printableLine(text), text);
}

TEST(Printable, WhatMovesTheCursorIsAnEscape) {
  EXPECT_EQ(printableLine("a\nb\r\tc"), "a\\nb\\r\\tc");
  EXPECT_EQ(printableLine("\x1b[2Jgone\x07"), "\\x1b[2Jgone\\x07");
  EXPECT_EQ(printableLine(std::string_view("\0x", 2)), "\\x00x");
  EXPECT_EQ(printableLine("\x7f"), "\\x7f");
  EXPECT_EQ(printableLine("\u009b2J"), "\\x9b2J") << "the one-character form of ESC [";
  EXPECT_EQ(printableLine("a\u202egpj"), "a\\u{202e}gpj");
  EXPECT_EQ(printableLine("\u2066x\u2069\u2028\u061c\u200f"),
            "\\u{2066}x\\u{2069}\\u{2028}\\u{061c}\\u{200f}");
}

TEST(Printable, WhatIsNoUtf8IsShownByteByByte) {
  EXPECT_EQ(printableLine("a\xff"), "a\\xff");
  EXPECT_EQ(printableLine("\xc0\xaf"), "\\xc0\\xaf") << "overlong";
  EXPECT_EQ(printableLine("\xe0\x80\xaf"), "\\xe0\\x80\\xaf") << "overlong";
  EXPECT_EQ(printableLine("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "a surrogate";
  EXPECT_EQ(printableLine("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond Unicode";
  EXPECT_EQ(printableLine("\xe2\x82"), "\\xe2\\x82") << "cut off";
  EXPECT_EQ(printableLine("\xc3(x"), "\\xc3(x");
}

TEST(Printable, ALongLineKeepsItsBeginningAndItsEnd) {
  const std::string fits(kLongestLine, 'x');
  EXPECT_EQ(printableLine(fits), fits);
  EXPECT_EQ(printableLine("0123456789", 7), "0123…89");
  for (const std::size_t length : {kLongestLine + 1, std::size_t{5000}, std::size_t{50'000'000}}) {
    const std::string line = printableLine("begin " + std::string(length, 'y') + " end: use --this");
    EXPECT_EQ(line.size(), kLongestLine - 1 + std::string("…").size()) << length;
    EXPECT_EQ(line.substr(0, 6), "begin ");
    EXPECT_EQ(line.substr(line.size() - 16), " end: use --this");
  }
}

TEST(Printable, SeveralLinesKeepTheirEnds) {
  EXPECT_EQ(printableLines("a\x1b\nb\n\nc"), "a\\x1b\nb\n\nc");
  EXPECT_EQ(printableLines("a\n"), "a\n");
  EXPECT_EQ(printableLines(""), "");
}

}  // namespace
}  // namespace whittle
