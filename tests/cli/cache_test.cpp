// `whittle cache` and `--tier`: what users see of the general programs. The first case compiles them, which
// PoCL's own cache keeps from one run of the suite to the next.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

#include "cli/run_whittle.h"

namespace whittle::test {
namespace {

namespace fs = std::filesystem;

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Warmed once for all cases.
class Cache : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new Folder;
    warmed_ = runWhittle({"cache", "--warm"}, warm());
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  static fs::path folder() { return *folder_ / "programs"; }
  static RunOptions warm() { return {folder_->path(), {{"WHITTLE_CACHE_DIR", folder()}}}; }
  /// With an empty folder for PoCL's kernels.
  static RunOptions cold(const Folder& kernels) {
    RunOptions options = warm();
    options.env.emplace_back("POCL_CACHE_DIR", kernels.path());
    return options;
  }
  static nlohmann::json statsOf(const std::vector<std::string>& more, const RunOptions& options) {
    std::vector<std::string> args = smallRender({"--quiet", "-o", "a.exr", "--stats", "stats.json"});
    args.insert(args.end(), more.begin(), more.end());
    const Outcome run = runWhittle(args, options);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    return readJson(*folder_ / "stats.json");
  }

  static Folder* folder_;
  static Outcome warmed_;
};
Folder* Cache::folder_ = nullptr;
Outcome Cache::warmed_;

TEST_F(Cache, WarmingIsDoneOnceAndShown) {
  EXPECT_EQ(warmed_.status, 0) << warmed_.err;
  EXPECT_TRUE(says(warmed_.out, "compiled the general programs into ")) << warmed_.out;
  const Outcome again = runWhittle({"cache", "--warm"}, warm());
  EXPECT_TRUE(says(again.out, "are in ") && says(again.out, " already")) << again.out;
  const Outcome shown = runWhittle({"cache"}, warm());
  EXPECT_EQ(shown.status, 0);
  for (const char* what : {"searches, plain", "shading, plain", "queues, plain", "shading, rich"})
    EXPECT_TRUE(says(shown.out, what)) << what << " in\n" << shown.out;
}

TEST_F(Cache, ASceneStartsOnGeneralProgramsWithoutACompiler) {
  const Folder kernels;
  const auto stats = statsOf({}, cold(kernels));
  ASSERT_EQ(stats["programs"].size(), 1U);
  EXPECT_EQ(stats["programs"][0]["tier"], "general");
  EXPECT_EQ(stats["settings"]["tier"], "auto");
  // Nothing but what was loaded: no work-group function was compiled.
  EXPECT_FALSE(fs::exists(kernels.path() / "whittle-compiled"));
  EXPECT_EQ(statsOf({"--tier", "specialised"}, warm())["programs"][0]["tier"], "specialised");
}

TEST_F(Cache, SummaryAndInfoSayWhoDraws) {
  const Folder kernels;
  const Outcome run = runWhittle(smallRender({"-o", "b.exr"}), cold(kernels));
  EXPECT_TRUE(says(run.out, "on the general programs")) << run.out;
  const Outcome info = runWhittle({"info", scene()}, cold(kernels));
  EXPECT_TRUE(says(info.out, "general ones (plain), until its own are compiled")) << info.out;
  const auto json = nlohmann::json::parse(runWhittle({"info", scene(), "--json"}, cold(kernels)).out);
  EXPECT_EQ(json["programs"]["start"], "general");
}

TEST_F(Cache, ADamagedEntryIsCompiledAgain) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder()))
    if (entry.path().extension() == ".program") files.push_back(entry.path());
  ASSERT_GE(files.size(), 4U);
  for (const fs::path& file : files) fs::resize_file(file, fs::file_size(file) / 2);
  const Outcome run = runWhittle(smallRender({"--quiet", "-o", "c.exr"}), warm());
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(runWhittle({"cache", "--warm", "--quiet"}, warm()).status, 0);
  EXPECT_EQ(statsOf({"--tier", "general"}, warm())["programs"][0]["tier"], "general");
}

/// Several at once compile each program once; one that is killed leaves nothing half done.
TEST_F(Cache, ManyMayWarmAtOnceAndBeKilled) {
  RunOptions options = warm();
  options.env[0].second = *folder_ / "many";
  std::vector<Process> processes;
  for (int i = 0; i < 4; ++i) processes.emplace_back(std::vector<std::string>{"cache", "--warm"}, options);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  processes[1].signal(SIGKILL);
  for (std::size_t i = 0; i < processes.size(); ++i) {
    const int status = processes[i].finish().status;
    if (i != 1) {
      EXPECT_EQ(status, 0);
    }
  }
  const Outcome again = runWhittle({"cache", "--warm"}, options);
  EXPECT_TRUE(says(again.out, " already")) << again.out;
}

TEST_F(Cache, AFolderThatCannotBeUsedHurtsNoRender) {
  RunOptions options = warm();
  options.env[0].second = "/proc/none";
  const Outcome run = runWhittle(smallRender({"--quiet", "-o", "d.exr"}), options);
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
  const Outcome refused = runWhittle({"cache", "--warm"}, options);
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
  EXPECT_TRUE(says(refused.err, "/proc/none")) << refused.err;
}

TEST_F(Cache, ClearingEmptiesIt) {
  RunOptions options = warm();
  options.env[0].second = *folder_ / "many";
  EXPECT_TRUE(says(runWhittle({"cache", "--clear"}, options).out, "removed ")) << options.env[0].second;
  EXPECT_TRUE(says(runWhittle({"cache"}, options).out, "no programs"));
}

TEST(CacheUsage, WrongOnesAreSaid) {
  for (const std::vector<std::string>& args :
       {std::vector<std::string>{"cache", "--warm", "--clear"},
        {"cache", "--device", "cpu"},
        {"cache", "--warm", "--device", "no such"},
        smallRender({"--tier", "slow"}),
        smallRender({"--tier", "general", "--no-shadows", "--quiet", "-o", "/tmp/never.exr"})}) {
    const Outcome run = runWhittle(args);
    EXPECT_EQ(run.status, 2) << args.back();
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
}

}  // namespace
}  // namespace whittle::test
