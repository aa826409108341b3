// Report pages are one file, whatever their data hold.
#include "report/page.h"

#include <gtest/gtest.h>

#include <regex>

namespace whittle {
namespace {

TEST(ReportPage, HoldsItsDataWhateverAreCalledThings) {
  const nlohmann::ordered_json data{{"scene", "</script><script>alert(1)</script>"},
                                    {"name", "<!-- \" ' & é"}};
  const std::string page = pageText("a <b> & c", "scale.js", data);
  std::smatch found;
  ASSERT_TRUE(std::regex_search(page, found, std::regex("id=\"data\">([^<]*)</script>")))
      << "no < in the data";
  EXPECT_EQ(nlohmann::ordered_json::parse(found[1].str()), data);
  EXPECT_NE(page.find("<title>a &lt;b> &amp; c</title>"), std::string::npos);
}

TEST(ReportPage, AsksForNoOtherFile) {
  const std::string page = pageText("t", "scale.js", {});
  EXPECT_FALSE(std::regex_search(page, std::regex("(src|href)=\"(?!data:,\")|@import|url\\(")));
  // A name of a kind of element, not an address.
  EXPECT_EQ(page.find("http"), page.find("http://www.w3.org/2000/svg"));
  EXPECT_THROW((void)pageText("t", "none.js", {}), std::out_of_range);
}

}  // namespace
}  // namespace whittle
