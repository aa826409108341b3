// Pasting kernel files together: once each, with #line directives that let a build log name the
// file's own lines.
#include "cl/kernel_source.h"

#include <gtest/gtest.h>

#include <sstream>

#include "support/temporary_sources.h"

namespace whittle {
namespace {

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

/// "file:line" of the first line that holds `marker`, worked out from the #line directives as
/// a compiler does.
std::string placeOf(const std::string& text, const std::string& marker) {
  std::istringstream lines(text);
  std::string line, file = "?";
  int number = 0;
  while (std::getline(lines, line)) {
    if (line.rfind("#line ", 0) == 0) {
      std::istringstream directive(line.substr(6));
      std::string quoted;
      directive >> number >> quoted;
      file = quoted.substr(1, quoted.size() - 2);
      continue;
    }
    if (line.find(marker) != std::string::npos) return file + ":" + std::to_string(number);
    ++number;
  }
  return "not there";
}

TEST(KernelSource, PastesEachIncludeOnceWhereItFirstAppears) {
  const test::TemporarySources sources;
  sources.write("a.cl", "int a1;\n#include \"lib/common.cl\"\nint a3;\n");
  sources.write("b.cl", "#include \"lib/common.cl\"\nint b2;\n#include \"lib/other.cl\"\nint b4;\n");
  sources.write("lib/common.cl", "int common1;\n#include \"lib/deep.cl\"\nint common3;\n");
  sources.write("lib/other.cl", "#include \"lib/deep.cl\"\n\nint other3;");
  sources.write("lib/deep.cl", "int deep1;\n");
  const std::string text = assembleKernelSource({"a.cl", "b.cl", "a.cl"}, sources.folder());
  for (const char* once : {"int a1;", "int a3;", "int b2;", "int b4;", "int common1;", "int common3;",
                           "int other3;", "int deep1;"})
    EXPECT_EQ(occurrences(text, once), 1U) << once << " in\n" << text;
  EXPECT_EQ(occurrences(text, "#include"), 0U);
  EXPECT_LT(text.find("int a1;"), text.find("int common1;"));
  EXPECT_LT(text.find("int common1;"), text.find("int deep1;"));
  EXPECT_LT(text.find("int deep1;"), text.find("int common3;"));
  EXPECT_LT(text.find("int common3;"), text.find("int a3;"));
}

TEST(KernelSource, KeepsFileAndLineOfEveryLine) {
  const test::TemporarySources sources;
  sources.write("a.cl", "int a1;\n#include \"lib/common.cl\"\nint a3;\n#include \"lib/deep.cl\"\nint a5;\n");
  sources.write("lib/common.cl", "int common1;\n#include \"lib/deep.cl\"\nint common3;\n");
  sources.write("lib/deep.cl", "\n\nint deep3;\n");
  const std::string text = assembleKernelSource({"a.cl"}, sources.folder());
  EXPECT_EQ(placeOf(text, "int a1;"), "a.cl:1");
  EXPECT_EQ(placeOf(text, "int a3;"), "a.cl:3");
  EXPECT_EQ(placeOf(text, "int a5;"), "a.cl:5");
  EXPECT_EQ(placeOf(text, "int common1;"), "lib/common.cl:1");
  EXPECT_EQ(placeOf(text, "int common3;"), "lib/common.cl:3");
  EXPECT_EQ(placeOf(text, "int deep3;"), "lib/deep.cl:3");
}

std::string messageOf(const std::vector<std::string>& stages,
                      const std::optional<std::filesystem::path>& folder) {
  try {
    assembleKernelSource(stages, folder);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "nothing was thrown";
}

TEST(KernelSource, MissingFilesAreNamed) {
  const test::TemporarySources sources;
  sources.write("a.cl", "#include \"lib/gone.cl\"\n");
  EXPECT_NE(messageOf({"a.cl"}, sources.folder()).find("lib/gone.cl"), std::string::npos);
  EXPECT_NE(messageOf({"absent.cl"}, sources.folder()).find("absent.cl"), std::string::npos);
  EXPECT_NE(messageOf({"absent.cl"}, {}).find("absent.cl"), std::string::npos);
}

TEST(KernelSource, TheBinaryHoldsTheFilesOfTheFolder) {
  EXPECT_EQ(embeddedKernelFiles().count("intersect.cl"), 1U);
  EXPECT_EQ(embeddedKernelFiles().count("lib/math.cl"), 1U);
  EXPECT_EQ(embeddedKernelFiles().count("shared/layout.h"), 1U);
  const std::string text = assembleKernelSource({"intersect.cl", "occlude.cl"});
  EXPECT_EQ(occurrences(text, "#include \""), 0U);
  EXPECT_EQ(occurrences(text, "__kernel void intersect("), 1U);
  EXPECT_EQ(occurrences(text, "Real dot3(Real3 a, Real3 b)"), 1U);
}

}  // namespace
}  // namespace whittle
