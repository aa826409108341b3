// What comes over a window and must not end it: it is put away, and more is asked of it than there is memory
// for.
#include "window_fixture.h"
#include "window_manager.h"

namespace whittle::test {
namespace {

class LastingWindow : public WindowTest {};

/// Renders while nobody looks, and shows what it has when somebody does again.
TEST_F(LastingWindow, GoesOnWhileItIsMinimised) {
  const WindowManager manager(display_.name);
  if (!manager.works()) GTEST_SKIP() << "built without Xlib: nothing minimises";
  expectPlayed(
      "wait refined\nexpect window.minimised == false\nminimise\nwait 0.3\nexpect window.minimised == true\n"
      "set bounces 2\nwait refined\nexpect stats.settings.bounces == 2\n"
      "restore\nwait 0.3\nexpect window.minimised == false\nscreenshot restored.png\n"
      "minimise\nrestore\nminimise\nwait 0.3\nset bounces 3\nrestore\nwait refined\n"
      "expect window.minimised == false\nscreenshot again.png\n");
  EXPECT_EQ(read("restored.png").width, read("again.png").width);
  EXPECT_NE(read("restored.png").bytes, read("again.png").bytes) << "a bounce more";
}

TEST_F(LastingWindow, DrawsNothingWhileItIsMinimised) {
  const WindowManager manager(display_.name);
  if (!manager.works()) GTEST_SKIP() << "built without Xlib: nothing minimises";
  const Outcome run = play(
      "wait refined\nminimise\nwait 0.3\nprint window.frames\nset bounces 2\nwait refined\n"
      "print window.frames\nrestore\nwait 0.3\n");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto first = run.out.find("frames = "), second = run.out.rfind("frames = ");
  ASSERT_NE(first, second);
  EXPECT_EQ(std::atoi(run.out.c_str() + first + 9), std::atoi(run.out.c_str() + second + 9)) << run.out;
}

/// The line that `render` says of the same scene and options, without its own name in front.
std::string saidByRender(const std::vector<std::string>& options, const RunOptions& where) {
  std::vector<std::string> args{"render", scene("cornell_box.glb"), "-o", "too_large.png", "--quiet"};
  args.insert(args.end(), options.begin(), options.end());
  const Outcome run = runWhittle(args, where);
  EXPECT_NE(run.status, 0);
  const std::string prefix = "whittle: ";
  EXPECT_EQ(run.err.rfind(prefix, 0), 0U) << run.err;
  return run.err.substr(prefix.size(), run.err.find('\n') - prefix.size());
}

/// The picture before stays, the window says why, and goes on with what there is room for.
constexpr const char* kTooLarge =
    "wait refined\nscreenshot before.png\nset width {0}\nset height {0}\nwait 2\nprint view.message\n"
    "expect view.height != {0}\nscreenshot after.png\nset height 90\nset width 160\nwait refined\n"
    "expect view.width == 160\nexpect stats.settings.height == 90\nset bounces 2\nwait refined\n"
    "expect stats.settings.bounces == 2\n";

TEST_F(LastingWindow, RefusesAPictureBeyondTheMemoryLimitInTheWordsOfRender) {
  std::vector<std::string> options = kSmall;
  options.insert(options.end(), {"--memory-limit", "1G"});
  const Outcome run = play(fmt::format(fmt::runtime(kTooLarge), 16000), options);
  ASSERT_EQ(run.status, 0) << run.err << run.out;
  const std::string said =
      saidByRender({"--width", "16000", "--height", "16000", "--rays-per-pixel", "4", "--memory-limit", "1G"},
                   {folder_.path(), {}});
  EXPECT_NE(said.find("a picture of 16000×16000 would take"), std::string::npos) << said;
  EXPECT_NE(run.out.find("view.message = " + said), std::string::npos) << run.out << said;
}

/// The limit allows it, and the device has less.
TEST_F(LastingWindow, SurvivesADeviceWithoutRoomAndSaysSoAsRenderDoes) {
  const std::vector<std::pair<std::string, std::string>> small{{"POCL_MEMORY_LIMIT", "1"}};
  environment_ = small;
  const Outcome run = play(fmt::format(fmt::runtime(kTooLarge), 9000));
  ASSERT_EQ(run.status, 0) << run.err << run.out;
  const std::string said =
      saidByRender({"--width", "9000", "--height", "9000", "--rays-per-pixel", "4"}, {folder_.path(), small});
  EXPECT_NE(said.find("9000×9000"), std::string::npos) << said;
  EXPECT_NE(run.out.find("view.message = " + said), std::string::npos) << run.out << said;
}

}  // namespace
}  // namespace whittle::test
