// Help texts: every option of the contract, once, with its default, in 80 columns, without the
// parser's own words.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "report/text.h"
#include "run_whittle.h"
#include "scene/settings.h"

namespace whittle::test {
namespace {

int countLinesStarting(const std::string& text, const std::string& start) {
  std::istringstream in(text);
  int count = 0;
  for (std::string line; std::getline(in, line);) count += line.rfind(start, 0) == 0 ? 1 : 0;
  return count;
}

class Help : public testing::TestWithParam<const char*> {};

TEST_P(Help, FitsATerminalAndSpeaksThisProgramsWords) {
  const std::string command = GetParam();
  const Outcome run = runWhittle(command.empty() ? std::vector<std::string>{"--help"}
                                                 : std::vector<std::string>{command, "--help"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  std::istringstream in(run.out);
  for (std::string line; std::getline(in, line);) {
    EXPECT_LE(columnsOf(line), 80U) << line;
    EXPECT_FALSE(line.ends_with(' ')) << line;
  }
  for (const char* noise : {"REQUIRED", "TEXT", "INT", "FLOAT", "UINT", "Needs", "{", ":NONNEGATIVE"})
    EXPECT_EQ(run.out.find(noise), std::string::npos) << noise << " in:\n" << run.out;
  EXPECT_NE(run.out.find("Example: whittle "), std::string::npos);
  EXPECT_NE(run.out.find("Usage: whittle"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Cli, Help,
                         testing::Values("", "render", "view", "reference", "info", "devices", "check",
                                         "cache", "compare", "bench"),
                         [](const auto& of) { return std::string(*of.param ? of.param : "whittle"); });

/// --rays-per-pixel for raysPerPixel.
std::string optionOf(const std::string& setting) {
  std::string option = "--";
  for (const char c : setting) {
    if (std::isupper(static_cast<unsigned char>(c))) option += '-';
    option += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return option;
}

TEST(HelpOfRender, ShowsEachOptionOnceWithItsDefault) {
  const std::string text = runWhittle({"render", "--help"}).out;
  std::vector<std::string> options{"--stats", "--profile", "--trace",     "--reference",
                                   "--aov",   "--quiet",   "-o, --output"};
  // Two settings of scene/settings.h share another's option.
  eachSetting(Settings{}, [&](const std::string& name, const auto&) {
    if (name != "bump" && name != "targetErrorRelative") options.push_back(optionOf(name));
  });
  for (const auto& option : options)
    EXPECT_EQ(countLinesStarting(text, "  " + option + " ") + countLinesStarting(text, "  " + option + ","),
              1)
        << option;
  for (const char* names : {"--ray-offset, --bump", "--shadows, --no-shadows"})
    EXPECT_EQ(countLinesStarting(text, std::string("  ") + names), 1) << names;
  // The defaults of scene/settings.h, as the contract's users read them.
  for (const char* fallback :
       {"width of the picture [640]", "height of the picture [360]", "[8]", "[random]", "[auto]", "[all]"})
    EXPECT_NE(text.find(fallback), std::string::npos) << fallback;
}

TEST(HelpAlone, IsShortAndWrongUsage) {
  const Outcome run = runWhittle({});
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.err.find("Example: whittle render"), std::string::npos);
  EXPECT_LE(std::count(run.err.begin(), run.err.end(), '\n'), 24) << "longer than a terminal";
}

TEST(HelpAlone, TellsItsVersion) {
  const Outcome run = runWhittle({"--version"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out.rfind("whittle 0.", 0), 0U) << run.out;
}

TEST(Text, NumbersAndWords) {
  EXPECT_EQ(formatInteger(0), "0");
  EXPECT_EQ(formatInteger(999), "999");
  EXPECT_EQ(formatInteger(1000), "1,000");
  EXPECT_EQ(formatInteger(1234567), "1,234,567");
  EXPECT_EQ(formatReal(-0.0), "0");
  EXPECT_EQ(formatReal(2.0), "2");
  EXPECT_EQ(formatSome(0, "light", "lights"), "no lights");
  EXPECT_EQ(formatSome(1, "light", "lights"), "1 light");
  EXPECT_EQ(formatSome(1200, "light", "lights"), "1,200 lights");
  EXPECT_EQ(formatRate(12.34e6), "12.34 Mrays/s");
  EXPECT_EQ(formatRate(850e3), "850 krays/s");
  EXPECT_EQ(formatSeconds(0.25), "0.250 s");
  EXPECT_EQ(formatSeconds(185.0), "3:05 min");
  EXPECT_EQ(formatSeconds(7800.0), "2:10 h");
  EXPECT_EQ(columnsOf("m²"), 2U);
  EXPECT_EQ(wrapped("one two three", 7, 2), "one two\n  three");
  EXPECT_EQ(closestWord("--widht", {"--height", "--width"}), "--width");
  EXPECT_EQ(closestWord("frobnicate", {"render", "info"}), "");
}

TEST(Text, CoordinatesTellApartAThousandthOfTheScene) {
  EXPECT_EQ(formatCoordinate(1.23456, 20), "1.235") << "a scene about the origin: four digits";
  EXPECT_EQ(formatCoordinate(-0.0, 20), "0");
  EXPECT_EQ(formatCoordinate(1e-7, 20), "0") << "rounding";
  // Ten metres across, 5000 km away: to the centimetre, the thousandth part.
  EXPECT_EQ(formatCoordinate(5000000.123, 10), "5000000.12");
  EXPECT_EQ(formatCoordinate(-4649777.02, 100), "-4649777");
  EXPECT_EQ(formatCoordinate(500123.37, 100), "500123.4");
  EXPECT_EQ(formatCoordinate(1.5, 0), "1.5") << "a point";
  EXPECT_EQ(formatCoordinate(1e30, 1), "1e+30") << "beyond what a double holds";
}

}  // namespace
}  // namespace whittle::test
