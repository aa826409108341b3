// Scripts: what they understand, refuse, wait for and find wrong.
#include "view/script.h"

#include <gtest/gtest.h>

#include "scene/input_error.h"

namespace whittle::test {
namespace {

/// Writes down what is done to it.
class Recorder : public view::Stage {
 public:
  void redraw() override {}
  void key(const std::string& name) override { log += "key " + name + "; "; }
  void pointer(const Place& p) override {
    if (log.empty() || log.find("at ") == std::string::npos || isDown) places.emplace_back(p.x, p.y);
  }
  void button(const std::string& name, bool down) override {
    isDown = down;
    log += (down ? "down " : "up ") + name + "; ";
  }
  void wheel(double steps) override { log += "wheel " + std::to_string(static_cast<int>(steps)) + "; "; }
  void resize(int w, int h) override { log += "size " + std::to_string(w) + "x" + std::to_string(h) + "; "; }
  void minimise() override { log += "minimise; "; }
  void restore() override { log += "restore; "; }
  void drop(const std::string& file) override { log += "drop " + file + "; "; }
  void screenshot(const std::filesystem::path& file) override { log += "shot " + file.string() + "; "; }
  void saveScene(const std::filesystem::path& file) override { log += "copy " + file.string() + "; "; }
  std::string set(const std::string& id, const std::string& text) override {
    log += "set " + id + " " + text + "; ";
    return id == "bad" ? "--bad: no" : "";
  }
  bool hasPicture() const override { return time > 2; }
  bool isFinished() const override { return time > 5; }
  std::string impasse() const override { return problem; }
  bool isSaving() const override { return time < savedAt; }
  bool showsNewest() const override { return time >= codesAt; }
  std::string stateJson() const override {
    return R"({"stats":{"rays":{"shadow":12},"name":"tree","list":[1,2]},"view":{"coarse":false}})";
  }
  void print(const std::string& text) override { log += text + "; "; }
  double now() const override { return time; }
  void quit() override { log += "quit; "; }

  std::string log;
  std::vector<std::pair<double, double>> places;
  bool isDown = false;
  double time = 0, codesAt = 0, savedAt = 0;
  std::string problem;
};

/// Runs to the end, a frame a tenth of a second.
Recorder played(const std::string& text) {
  Recorder stage;
  view::Script script(text);
  for (int i = 0; i < 10000 && script.step(stage); ++i) stage.time += 0.1;
  return stage;
}

std::string failure(const std::string& text) {
  try {
    played(text);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST(Script, DoesLineByLine) {
  const Recorder stage = played(
      "# a comment\n\nkey r\nset bounces 3\nwheel 10 20 -2\nresize 640 480\nminimise\nrestore\ndrop a.glb # "
      "behind\ncompare right.exr\n"
      "screenshot a.png\nprint stats.rays.shadow\nquit\n");
  EXPECT_EQ(stage.log,
            "key r; set bounces 3; wheel -2; size 640x480; minimise; restore; drop a.glb; set reference "
            "right.exr; shot a.png; "
            "stats.rays.shadow = 12; quit; ");
}

TEST(Script, ADragGoesThereStepByStep) {
  const Recorder stage = played("drag 100 100 180 60 right");
  EXPECT_EQ(stage.log, "down right; up right; ");
  ASSERT_GT(stage.places.size(), 5U);
  EXPECT_EQ(stage.places.front(), std::pair(100.0, 100.0));
  EXPECT_EQ(stage.places.back(), std::pair(180.0, 60.0));
}

TEST(Script, Waits) {
  EXPECT_GT(played("wait picture").time, 2);
  EXPECT_GT(played("wait refined").time, 5);
  EXPECT_NEAR(played("wait 3").time, 3, 0.2);
  EXPECT_EQ(failure("key r\nwait refined 1").rfind("script, line 2: waited", 0), 0U);
}

/// As where an option was refused: whoever waits is told at once, as the command line would tell him.
TEST(Script, WaitsForNothingThatWillNeverCome) {
  Recorder stage;
  stage.problem = "--ortho-height: needs --eye or --orbit";
  view::Script script("key r\nwait refined");
  std::string said;
  try {
    while (script.step(stage)) stage.time += 0.1;
  } catch (const InputError& e) {
    said = e.what();
  }
  EXPECT_EQ(said, "script, line 2: nothing to wait for: --ortho-height: needs --eye or --orbit");
  EXPECT_LT(stage.time, 1);
}

TEST(Script, WhatIsSavedIsThereBeforeTheNextCommand) {
  Recorder stage;
  view::Script script("save-scene a.glb\ndrop a.glb\n");
  script.step(stage);
  stage.savedAt = 3;
  double droppedAt = -1;
  for (int i = 0; i < 1000 && script.step(stage); ++i) {
    if (droppedAt < 0 && stage.log.find("drop") != std::string::npos) droppedAt = stage.time;
    stage.time += 0.1;
  }
  EXPECT_GE(droppedAt, 3);
}

TEST(Script, AClickIsInTheMiddleOfItsPixel) {
  Recorder stage;
  view::Script script("click 8 5");
  while (script.step(stage)) stage.time += 0.1;
  ASSERT_FALSE(stage.places.empty());
  EXPECT_EQ(stage.places.front(), std::pair(8.5, 5.5));
}

TEST(Script, ExpectsOfNumbersAndWords) {
  EXPECT_EQ(failure("expect stats.rays.shadow > 0\nexpect stats.rays.shadow <= 12\nexpect stats.list.1 == 2\n"
                    "expect stats.name == tree\nexpect view.coarse == false\nexpect stats.name != array"),
            "");
  EXPECT_EQ(failure("\nexpect stats.rays.shadow < 12"), "script, line 2: stats.rays.shadow is 12, not < 12");
  EXPECT_EQ(failure("expect stats.name > 3"), "script, line 1: stats.name is 'tree', no number");
  EXPECT_EQ(failure("expect stats.nothing > 3"), "script, line 1: there is no 'stats.nothing' in the state");
  EXPECT_EQ(failure("set bad 1"), "script, line 1: --bad: no");
}

TEST(Script, RefusesWhatIsNoCommandBeforeItBegins) {
  EXPECT_EQ(failure("key r\nkeys r"), "--script: line 2: 'keys' is no command");
  EXPECT_EQ(failure("set bounces"), "--script: line 1: 'set' takes 2 words");
  EXPECT_THROW(view::Script("expect a b"), InputError);
}

/// Codes come from another thread: what is shot is what was set.
TEST(Script, AScreenshotWaitsForTheNewestCodes) {
  Recorder stage;
  stage.codesAt = 3;
  view::Script script("set exposure 2\nscreenshot a.png\nprint view.coarse\n");
  double shotAt = -1;
  for (int i = 0; i < 1000 && script.step(stage); ++i) {
    if (shotAt < 0 && stage.log.find("shot") != std::string::npos) shotAt = stage.time;
    stage.time += 0.1;
  }
  EXPECT_GE(shotAt, 3);
  EXPECT_LT(shotAt, 3.5);
}

}  // namespace
}  // namespace whittle::test
