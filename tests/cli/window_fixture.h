// A window on a display without a screen: scripts drive it as hands would.
#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <OpenImageIO/imageio.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <string>
#include <vector>

#include "run_whittle.h"

namespace whittle::test {

/// An X server of its own; `name` is empty where there is none to be had.
class VirtualDisplay {
 public:
  explicit VirtualDisplay(const std::string& screen = "1280x720x24") {
    int ends[2];
    if (pipe(ends) != 0) return;
    server_ = fork();
    if (server_ == 0) {
      close(ends[0]);
      const int nowhere = open("/dev/null", O_WRONLY);
      dup2(nowhere, STDERR_FILENO);
      const std::string out = std::to_string(ends[1]);
      execlp("Xvfb", "Xvfb", "-displayfd", out.c_str(), "-screen", "0", screen.c_str(), "-nolisten", "tcp",
             nullptr);
      _exit(127);
    }
    close(ends[1]);
    std::string digits;  // up to the end of the line
    for (char c = 0; ::read(ends[0], &c, 1) == 1 && c != '\n';) digits.push_back(c);
    close(ends[0]);
    if (!digits.empty()) name = fmt::format(":{}", digits);
  }
  ~VirtualDisplay() {
    if (server_ <= 0) return;
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
  }
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  std::string name;

 private:
  pid_t server_ = -1;
};

/// Small, so that a frame is quick.
inline const std::vector<std::string> kSmall{"--width",          "160", "--height",  "90",
                                             "--rays-per-pixel", "4",   "--bounces", "3"};

class WindowTest : public testing::Test {
 protected:
  void SetUp() override {
    if (access(WHITTLE_WINDOW, F_OK) != 0) GTEST_SKIP() << "built without a window";
    if (display_.name.empty()) GTEST_SKIP() << "no Xvfb";
  }

  Outcome play(const std::string& script, std::vector<std::string> more = kSmall,
               const std::string& file = scene("cornell_box.glb")) {
    std::ofstream(folder_ / "script") << script;
    std::vector<std::string> args{"view", "--script", "script"};
    if (!file.empty()) args.insert(args.begin() + 1, file);
    args.insert(args.end(), more.begin(), more.end());
    return runWhittle(args, {folder_.path(), {{"DISPLAY", display_.name}, {"LIBGL_ALWAYS_SOFTWARE", "1"}}});
  }
  void expectPlayed(const std::string& script, std::vector<std::string> more = kSmall,
                    const std::string& file = scene("cornell_box.glb")) {
    const Outcome run = play(script, std::move(more), file);
    EXPECT_EQ(run.status, 0) << run.err << run.out;
  }
  struct Codes {
    int width = 0, height = 0, channels = 0;
    std::vector<std::uint8_t> bytes;
    std::array<std::uint8_t, 3> at(int x, int y) const {
      const std::size_t i = (static_cast<std::size_t>(y) * width + x) * channels;
      return {bytes[i], bytes[i + 1], bytes[i + 2]};
    }
  };
  Codes read(const std::string& name) {
    auto in = OIIO::ImageInput::open((folder_ / name).string());
    if (!in) {
      ADD_FAILURE() << name << " is not there";
      return {};
    }
    Codes codes{in->spec().width, in->spec().height, in->spec().nchannels, {}};
    codes.bytes.resize(static_cast<std::size_t>(codes.width) * codes.height * codes.channels);
    in->read_image(0, 0, 0, codes.channels, OIIO::TypeDesc::UINT8, codes.bytes.data());
    return codes;
  }
  /// Numbers of a line `PATH = VALUE` that a script printed.
  static double printed(const Outcome& run, const std::string& path) {
    const auto at = run.out.find(path + " = ");
    return at == std::string::npos ? -1 : std::strtod(run.out.c_str() + at + path.size() + 3, nullptr);
  }

  VirtualDisplay display_;
  Folder folder_;
};

}  // namespace whittle::test
