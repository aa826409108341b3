// `render --explain X,Y`, beside the reference: as text, as JSON and in the window.
#include "window_fixture.h"

namespace whittle::test {
namespace {

Outcome explain(std::vector<std::string> more) {
  std::vector<std::string> args{"render",  scene(), "--explain", "20,20", "--with-reference",
                                "--width", "32",    "--height",  "32",    "--quiet"};
  args.insert(args.end(), more.begin(), more.end());
  return runWhittle(args);
}

TEST(ExplainBesideTheReference, EndsWithWhetherTheyPart) {
  const Outcome run = explain({});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("[0] eye ray from "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("; no difference beyond rounding\n"), std::string::npos) << run.out;
  EXPECT_EQ(run.err, "");
}

TEST(ExplainBesideTheReference, TheJsonHasBothTrees) {
  const Outcome run = explain({"--json", "--rays-per-pixel", "2"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  ASSERT_EQ(json["samples"].size(), 2U);
  for (const auto& sample : json["samples"]) {
    const auto& reference = sample["reference"];
    EXPECT_EQ(reference["rays"].size(), sample["rays"].size());
    EXPECT_EQ(reference["partners"].size(), sample["rays"].size());
    EXPECT_TRUE(reference["parting"].is_null());
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(reference["sum"][c].get<double>(), sample["sum"][c].get<double>(),
                  1e-4 * reference["sum"][c].get<double>());
  }
}

class ExplanationPanel : public WindowTest {};

TEST_F(ExplanationPanel, ComparesWithTheReferenceWhenItIsAskedTo) {
  expectPlayed(
      "wait refined\nclick 88 60\nwait 2\nexpect view.explainedRays > 1\nexpect view.isCompared == false\n"
      "set with-reference on\nwait 2\nexpect view.isCompared == true\nexpect view.parts == false\n"
      "screenshot compared.png\nset with-reference off\nwait 1\nexpect view.isCompared == false\n"
      "set with-reference on\nwait 0.2\nkey Escape\nwait 2\nexpect view.explainedRays == 0\n"
      "click 20 20\nwait 2\nexpect view.isCompared == true\nset bounces 2\nexpect view.isCompared == false\n"
      "wait refined\n");
  EXPECT_NE(play("set with-reference maybe\n").err.find("'maybe' is not one of on|off"), std::string::npos);
}

/// The switch itself, in the window of 1280×720, while the picture is still under way: the list goes and
/// comes anew.
TEST_F(ExplanationPanel, IsAskedAnewWhileThePictureRefines) {
  std::vector<std::string> many = kSmall;
  many[5] = "100000";  // rays for each pixel
  expectPlayed(
      "wait picture\nclick 88 60\nwait 2\nexpect view.explainedRays > 1\nexpect view.finished == false\n"
      "click 1000 99 window\nwait 3\nexpect view.isCompared == true\nexpect view.explainedRays > 1\n",
      many);
}

}  // namespace
}  // namespace whittle::test
