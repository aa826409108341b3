// --checkpoint and --resume as a user has them: signals, kills, another scene, another folder.
#include "cli/checkpoint.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <random>
#include <thread>

#include "run_whittle.h"

namespace whittle::test {
namespace {

using namespace std::chrono_literals;

/// A second or more of work, saved all the time.
std::vector<std::string> longRender(const std::vector<std::string>& more = {}) {
  std::vector<std::string> args{"render",           scene(), "--width",      "64",     "--height", "48",
                                "--rays-per-pixel", "200",   "-o",           "a.exr",  "--every",  "0.02",
                                "--wavefront",      "16384", "--checkpoint", "a.state"};
  args.insert(args.end(), more.begin(), more.end());
  return args;
}

Outcome resume(const Folder& folder, const std::vector<std::string>& more = {}) {
  std::vector<std::string> args{"render", "--resume", "a.state"};
  args.insert(args.end(), more.begin(), more.end());
  return runWhittle(args, {folder.path(), {}});
}

/// Of a render that nobody interrupts.
void renderStraight(const Folder& folder, const std::string& rays = "200") {
  const Outcome run = runWhittle({"render", scene(), "--width", "64", "--height", "48", "--rays-per-pixel",
                                  rays, "-o", "straight.exr", "--quiet"},
                                 {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
}

/// "straight.exr" and "a.exr".
void expectSamePicture(const Folder& folder, const std::string& where) {
  const Outcome run = runWhittle({"compare", "straight.exr", "a.exr", "--json"}, {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << where << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out).at("differingPixels"), 0) << where;
}

void waitForFile(const std::filesystem::path& file) {
  for (int i = 0; i < 6000 && !std::filesystem::exists(file); ++i) std::this_thread::sleep_for(10ms);
  ASSERT_TRUE(std::filesystem::exists(file)) << file;
}

TEST(Checkpoint, ASignalLeavesThePictureSoFarAndTheWayOn) {
  const Folder folder;
  renderStraight(folder);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Process process(longRender(), {folder.path(), {}});
    waitForFile(folder / "a.state");
    process.signal(signal);
    const Outcome run = process.finish();
    EXPECT_EQ(run.status, -signal) << run.err;
    EXPECT_NE(run.err.find("whittle: interrupted"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("whittle render --resume a.state"), std::string::npos) << run.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "a.exr")) << run.err;
    const Outcome on = resume(folder);
    EXPECT_EQ(on.status, 0) << on.err;
    expectSamePicture(folder, std::to_string(signal));
    std::filesystem::remove(folder / "a.state");
    std::filesystem::remove(folder / "a.exr");
  }
}

TEST(Checkpoint, ThePictureSoFarMayBeLeftOut) {
  const Folder folder;
  Process process(longRender({"--no-partial"}), {folder.path(), {}});
  waitForFile(folder / "a.state");
  process.signal(SIGTERM);
  const Outcome run = process.finish();
  EXPECT_EQ(run.status, -SIGTERM);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.state"}) << run.err;
}

/// WHITTLE_KILLS=200 kills as often; the suite a few times, always at the same moments.
TEST(Checkpoint, KilledAtAnyMomentNothingIsLostButTheLastInterval) {
  const Folder folder;
  renderStraight(folder);
  const char* const asked = std::getenv("WHITTLE_KILLS");
  const int kills = asked ? std::atoi(asked) : 6;
  std::mt19937 random(7);
  std::uniform_int_distribution<int> milliseconds(1, 900);
  int before = 0, meanwhile = 0;
  for (int k = 0; k < kills; ++k) {
    Process process(longRender(), {folder.path(), {}});
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds(random)));
    process.signal(SIGKILL);
    process.finish();
    // A worker outlives its guard by a moment.
    std::this_thread::sleep_for(20ms);
    std::filesystem::remove(folder / "a.exr");
    const bool hasBegun = std::filesystem::exists(folder / "a.state");
    ++(hasBegun ? meanwhile : before);
    const Outcome on = hasBegun ? resume(folder) : runWhittle(longRender(), {folder.path(), {}});
    ASSERT_EQ(on.status, 0) << on.err;
    expectSamePicture(folder, "kill " + std::to_string(k));
    std::filesystem::remove(folder / "a.state");
    std::filesystem::remove(folder / "a.exr");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"straight.exr"});
  }
  RecordProperty("before the first checkpoint", before);
  EXPECT_GT(meanwhile, 0) << "no kill came after the first checkpoint";
}

TEST(Checkpoint, ATimeLimitEndsAtACheckpointToo) {
  const Folder folder;
  renderStraight(folder);
  const Outcome run = runWhittle(longRender({"--time-limit", "0.05"}), {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
  const Outcome on = resume(folder, {"--time-limit", "0"});
  ASSERT_EQ(on.status, 0) << on.err;
  expectSamePicture(folder, "time limit");
}

TEST(Checkpoint, MoreRaysAreAddedToAFinishedPicture) {
  const Folder folder;
  renderStraight(folder, "24");
  const Outcome run = runWhittle(longRender({"--rays-per-pixel", "10"}), {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
  const Outcome on = resume(folder, {"--rays-per-pixel", "24"});
  ASSERT_EQ(on.status, 0) << on.err;
  expectSamePicture(folder, "added");
}

TEST(Checkpoint, AnotherPictureIsRefusedByName) {
  const Folder folder;
  std::filesystem::copy_file(scene(), folder / "box.glb");
  const std::vector<std::string> begin{"render",   "box.glb", "--width",          "32",
                                       "--height", "24",      "--rays-per-pixel", "2",
                                       "-o",       "a.exr",   "--checkpoint",     "a.state"};
  ASSERT_EQ(runWhittle(begin, {folder.path(), {}}).status, 0);
  const auto refusal = [&](const std::vector<std::string>& more) {
    const Outcome run = resume(folder, more);
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    return run.err;
  };
  EXPECT_NE(refusal({"--bounces", "3"}).find("--bounces was 8 and is 3"), std::string::npos);
  EXPECT_NE(refusal({"--width", "33"}).find("--width was 32 and is 33"), std::string::npos);
  EXPECT_NE(refusal({"--orbit", "20,10"}).find("camera"), std::string::npos);
  EXPECT_NE(refusal({"--rays-per-pixel", "1"}).find("one ray"), std::string::npos);
  EXPECT_NE(refusal({"--aov", "depth=d.exr"}).find("auxiliary outputs"), std::string::npos);
  std::filesystem::copy_file(scene("emission.glb"), folder / "box.glb",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_NE(refusal({}).find("box.glb has changed since"), std::string::npos);
  const Outcome other =
      runWhittle({"render", "--resume", "a.state", scene(), "--rays-per-pixel", "2"}, {folder.path(), {}});
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("is of another picture"), std::string::npos) << other.err;
}

TEST(Checkpoint, WhatCannotBeResumedIsSaidBeforeAnythingIsDone) {
  const Folder folder, elsewhere;
  const std::vector<std::string> begin = longRender({"--rays-per-pixel", "2"});
  ASSERT_EQ(runWhittle(begin, {folder.path(), {}}).status, 0);
  const auto refused = [](const std::vector<std::string>& args, const std::filesystem::path& where) {
    const Outcome run = runWhittle(args, {where, {}});
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    return run.err;
  };
  const std::string state = (folder / "a.state").string();
  EXPECT_NE(refused({"render", "--resume", state}, elsewhere.path()).find("began in"), std::string::npos);
  EXPECT_NE(refused({"render", "--resume", "none"}, folder.path()).find("is no file"), std::string::npos);
  EXPECT_NE(refused({"render"}, folder.path()).find("SCENE"), std::string::npos);
  EXPECT_NE(refused({"render", scene(), "--every", "3"}, folder.path()).find("--checkpoint"),
            std::string::npos);
  EXPECT_NE(refused({"render", scene(), "--checkpoint", "-"}, folder.path()).find("--checkpoint"),
            std::string::npos);
  EXPECT_NE(refused({"render", scene(), "--checkpoint", "none/a"}, folder.path()).find("none"),
            std::string::npos);
  EXPECT_NE(refused({"render", scene(), "--checkpoint", "b", "--aov", "cost=c.exr"}, folder.path())
                .find("--checkpoint"),
            std::string::npos);
  EXPECT_NE(
      refused({"render", scene(), "--checkpoint", "b", "--frames", "0:3"}, folder.path()).find("--frames"),
      std::string::npos);
}

}  // namespace
}  // namespace whittle::test
