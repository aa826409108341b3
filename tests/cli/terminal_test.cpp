// On a terminal: progress on standard error, never wider than the window, gone at the end.
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

#include "report/text.h"
#include "run_whittle.h"

namespace whittle::test {
namespace {

/// What the program writes to a terminal of this width, both streams together; the exit status in `status`.
std::string onTerminal(std::vector<std::string> args, std::size_t columns,
                       const std::filesystem::path& folder, int& status) {
  winsize size{24, static_cast<unsigned short>(columns), 0, 0};
  int terminal = -1;
  const pid_t pid = ::forkpty(&terminal, nullptr, nullptr, &size);
  if (pid == 0) {
    args.insert(args.begin(), WHITTLE_BINARY);
    std::vector<char*> words;
    for (auto& a : args) words.push_back(a.data());
    words.push_back(nullptr);
    if (::chdir(folder.c_str()) != 0) ::_exit(126);
    ::execv(words[0], words.data());
    ::_exit(127);
  }
  std::string text;
  std::array<char, 4096> buffer;
  // A terminal whose last program has gone gives an error, not an end of file.
  for (ssize_t got; (got = ::read(terminal, buffer.data(), buffer.size())) > 0;)
    text.append(buffer.data(), static_cast<std::size_t>(got));
  ::close(terminal);
  ::waitpid(pid, &status, 0);
  return text;
}

/// Needs pseudo-terminals, which a bare chroot without /dev/pts does not have.
class Terminal : public testing::Test {
 protected:
  void SetUp() override {
    int master = -1, slave = -1;
    if (::openpty(&master, &slave, nullptr, nullptr, nullptr) != 0)
      GTEST_SKIP() << "no pseudo-terminal can be opened here";
    ::close(master);
    ::close(slave);
  }
};

TEST_F(Terminal, ProgressFitsTheWindowAndIsWipedAtTheEnd) {
  for (const std::size_t columns : {80U, 40U, 12U}) {
    const Folder folder;
    int status = -1;
    const std::string text =
        onTerminal(smallRender({"-o", "a.png", "--rays-per-pixel", "64", "--wavefront", "1024"}), columns,
                   folder.path(), status);
    EXPECT_EQ(status, 0) << text;
    const std::string wipe = "\r\033[K";
    std::vector<std::string> shown;
    std::size_t begin = 0;
    for (std::size_t at; (at = text.find(wipe, begin)) != std::string::npos; begin = at + wipe.size())
      shown.push_back(text.substr(begin, at - begin));
    ASSERT_GE(shown.size(), 2U) << "no progress";
    EXPECT_EQ(text.find("compiling kernels") != std::string::npos, columns > 12);
    EXPECT_NE(text.find(" %"), std::string::npos);
    for (const auto& line : shown) EXPECT_LE(columnsOf(line), columns) << line;
    // After the last wipe comes the summary alone.
    EXPECT_EQ(text.substr(begin, 6), "32×24") << text.substr(begin);
  }
}

TEST_F(Terminal, QuietStaysQuiet) {
  const Folder folder;
  int status = -1;
  EXPECT_EQ(onTerminal(smallRender({"-o", "a.png", "--quiet"}), 80, folder.path(), status), "");
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace whittle::test
