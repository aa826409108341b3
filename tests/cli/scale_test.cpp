// whittle scale: lists, points, that all of them draw the same picture, and what is said of them. Times are
// not tested; the arithmetic on them is, in tests/measure.
#include <gtest/gtest.h>
#include <signal.h>

#include <set>
#include <sstream>

#include "report/text.h"
#include "run_whittle.h"

namespace whittle::test {
namespace {

using Json = nlohmann::json;

std::vector<std::string> smallSweep(const std::vector<std::string>& more) {
  std::vector<std::string> args{"scale", scene("shadow.glb"), "--width", "48",           "--height",
                                "27",    "--within",          "50%",     "--time-limit", "1"};
  args.insert(args.end(), more.begin(), more.end());
  return args;
}

Json jsonOf(const std::vector<std::string>& more) {
  std::vector<std::string> args = smallSweep(more);
  args.emplace_back("--json");
  const Outcome run = runWhittle(args);
  EXPECT_EQ(run.status, 0) << run.err;
  return Json::parse(run.out);
}

TEST(Scale, MeasuresEveryCombinationAndAllDrawTheSamePicture) {
  const Json json = jsonOf({"--threads", "1-2", "--work-group", "8,64", "--lanes", "1,16"});
  ASSERT_EQ(json["points"].size(), 8U);
  std::set<std::string> pictures, values;
  for (const Json& point : json["points"]) {
    pictures.insert(point["picture"]);
    values.insert(point["values"].dump());
    EXPECT_EQ(point["values"]["threads"], std::to_string(point["settings"]["threads"].get<int>()));
    EXPECT_EQ(point["values"]["work-group"], std::to_string(point["settings"]["workGroup"].get<int>()));
    EXPECT_EQ(point["values"]["lanes"], point["settings"]["lanes"]);
    EXPECT_GE(point["frames"], 1);
    EXPECT_GT(point["seconds"]["median"], 0.0);
    double stages = 0.0;
    for (const Json& stage : point["stages"]) stages += stage["seconds"]["median"].get<double>();
    EXPECT_GT(stages, 0.0);
  }
  EXPECT_EQ(pictures.size(), 1U);
  EXPECT_EQ(values.size(), 8U);
  EXPECT_TRUE(json["differing"].empty());
  std::set<int> threads;
  for (const Json& ceiling : json["machine"]) threads.insert(ceiling["threads"].get<int>());
  EXPECT_TRUE(threads.contains(1) && threads.contains(2));
  EXPECT_GT(json["machine"][0]["flopsPerSecond"], 1e8);
  EXPECT_EQ(json["points"][0]["speedUp"]["median"], 1.0) << "the first is what the others are compared with";
}

TEST(Scale, OneAtATimeVariesEachAxisAboutTheFirstValues) {
  const Json json = jsonOf({"--work-group", "8,16,64", "--wavefront", "4k,1M", "--one-at-a-time"});
  ASSERT_EQ(json["points"].size(), 4U);
  EXPECT_EQ(json["points"][0]["values"], (Json{{"work-group", "8"}, {"wavefront", "4096"}}));
  EXPECT_EQ(json["points"][1]["values"], (Json{{"work-group", "8"}, {"wavefront", "1048576"}}));
  EXPECT_EQ(json["points"][3]["values"], (Json{{"work-group", "64"}, {"wavefront", "4096"}}));
  EXPECT_TRUE(json["machine"].empty()) << "nobody asked for threads";
}

TEST(Scale, PicturesOfOtherSizesOrSamplesNeedNotBeTheSame) {
  const Json json = jsonOf({"--size", "48x27,32x18", "--rays-per-pixel", "1,2"});
  ASSERT_EQ(json["points"].size(), 4U);
  EXPECT_TRUE(json["differing"].empty());
  // Axes have the order of the help.
  EXPECT_EQ(json["points"][1]["settings"]["width"], 32);
  EXPECT_EQ(json["points"][2]["settings"]["raysPerPixel"], 2);
  for (const std::size_t other : {1U, 2U, 3U})
    EXPECT_NE(json["points"][0]["picture"], json["points"][other]["picture"]);
  EXPECT_EQ(json["fastest"]["point"], 0) << "the others are other work";
}

TEST(Scale, APointThatTheDeviceCannotHaveIsRefusedAndTheOthersMeasured) {
  const Json json = jsonOf({"--work-group", "8,60000,16"});
  EXPECT_GE(json["points"][2]["frames"], 1);
  EXPECT_NE(json["points"][1]["refused"].get<std::string>().find("--work-group"), std::string::npos)
      << json["points"][1];
  const Outcome first = runWhittle(smallSweep({"--work-group", "60000,8"}));
  EXPECT_EQ(first.status, 2) << "nothing to compare with";
}

TEST(Scale, TheTableFitsATerminalAndSaysWhatItCannotTell) {
  const Outcome run = runWhittle(smallSweep({"--threads", "1,2"}));
  ASSERT_EQ(run.status, 0) << run.err;
  std::istringstream text(run.out);
  for (std::string line; std::getline(text, line);) EXPECT_LE(columnsOf(line), 80U) << line;
  for (const char* part : {"shadow.glb", "48×27", "speed-up", "of machine", "raygen", "fastest: threads",
                           "Amdahl's law: cannot tell: 2 numbers of threads; it takes 3"})
    EXPECT_NE(run.out.find(part), std::string::npos) << part << " in:\n" << run.out;
}

TEST(Scale, CsvHasALineForEachFrameAndEachOfItsStages) {
  const Outcome run = runWhittle(smallSweep({"--lanes", "1,16", "--csv"}));
  ASSERT_EQ(run.status, 0) << run.err;
  std::istringstream text(run.out);
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line, "lanes,round,quiet,stage,seconds");
  std::map<std::string, int> frames, raygens;
  while (std::getline(text, line)) {
    std::istringstream fields(line);
    std::vector<std::string> f;
    for (std::string field; std::getline(fields, field, ',');) f.push_back(field);
    ASSERT_EQ(f.size(), 5U) << line;
    EXPECT_GT(std::stod(f[4]), 0.0) << line;
    if (f[3] == "frame") ++frames[f[0]];
    if (f[3] == "raygen") ++raygens[f[0]];
  }
  EXPECT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames, raygens);
}

TEST(Scale, WrongListsAreOneLineThatNamesTheOption) {
  for (const auto& [option, value] :
       std::vector<std::pair<std::string, std::string>>{{"--threads", "1,,2"},
                                                        {"--threads", "4-1"},
                                                        {"--threads", "1,x"},
                                                        {"--threads", "-1"},
                                                        {"--wavefront", "1G"},
                                                        {"--wavefront", "512M"},
                                                        {"--wavefront", "k"},
                                                        {"--lanes", "1,2"},
                                                        {"--search", ""},
                                                        {"--size", "640"},
                                                        {"--size", "0x10"},
                                                        {"--within", "0"},
                                                        {"--time-limit", "-1"}}) {
    const Outcome run = runWhittle({"scale", scene("shadow.glb"), option + "=" + value});
    EXPECT_EQ(run.status, 2) << option << " " << value;
    EXPECT_NE(run.err.find(option), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  const Outcome many =
      runWhittle({"scale", scene("shadow.glb"), "--threads", "1-100", "--work-group", "1-100"});
  EXPECT_EQ(many.status, 2);
  EXPECT_NE(many.err.find("10000 combinations"), std::string::npos) << many.err;
}

TEST(Scale, ASignalKeepsWhatIsMeasured) {
  Process process(
      {"scale", scene("shadow.glb"), "--lanes", "1,16", "--within", "0.1%", "--time-limit", "600", "--json"});
  std::this_thread::sleep_for(std::chrono::seconds(8));  // more than compiling takes
  process.signal(SIGINT);
  const Outcome run = process.finish();
  EXPECT_NE(run.status, 0);
  const Json json = Json::parse(run.out);
  EXPECT_FALSE(json["isWhole"]);
  ASSERT_EQ(json["points"].size(), 2U);
  if (!json["points"][0].contains("frames")) GTEST_SKIP() << "this machine took 8 s to compile";
  EXPECT_GE(json["points"][0]["frames"], 1);
}

}  // namespace
}  // namespace whittle::test
