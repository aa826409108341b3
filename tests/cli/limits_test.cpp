// Limits of memory, stacks and the kernels' folder: an answer in time, one line, and the picture or none.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "cli/run_whittle.h"

namespace whittle::test {
namespace {

using Names = std::vector<std::string>;

/// However little there is: an answer in time, one line, and no picture unless it is whole. On this side of
/// the limits the program does not even start; beyond them it renders.
TEST(Limits, ShortMemoryEndsInOneLine) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "a sanitizer takes more addresses than there are";
#endif
  int refused = 0, rendered = 0;
  // The last is enough for a machine of many threads.
  for (const int megabytes : {150, 450, 750, 900, 1000, 1100, 65536}) {
    const Folder folder;
    const Outcome run = runShell("ulimit -v " + std::to_string(megabytes * 1024) +
                                     "; exec timeout -s KILL 80 \"$WHITTLE\" render " +
                                     scene("textured.glb") + " --width 32 --height 24 --quiet -o a.exr",
                                 {folder.path(), {}});
    SCOPED_TRACE(megabytes);
    // 2: the budget knows that it is too little.
    ASSERT_TRUE(run.status >= 0 && run.status <= 2)
        << run.status << ": it hung, or a signal ended it " << run.err;
    // Lines that a library writes before it ends the process may stand above ours.
    std::istringstream lines(run.err);
    int ours = 0;
    for (std::string line; std::getline(lines, line);)
      ours += line.rfind("whittle: ", 0) == 0 && line.find("Assertion") == std::string::npos ? 1 : 0;
    EXPECT_EQ(ours, run.status == 0 ? 0 : 1) << run.err;
    EXPECT_EQ(std::filesystem::exists(folder / "a.exr"), run.status == 0) << run.err;
    (run.status == 0 ? rendered : refused) += 1;
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(rendered, 0);
}

/// PoCL keeps the private variables of a whole group on a thread's stack, whatever size that has.
TEST(Limits, TheLargestWorkGroupFindsRoomOnASmallStack) {
  const Folder folder;
  const Outcome run = runShell("ulimit -s 512; \"$WHITTLE\" render " + scene("textured.glb") +
                                   " --width 32 --height 24 --work-group 4096 -o a.exr --quiet",
                               {folder.path(), {}});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(folder.names(), Names{"a.exr"});
}

/// PoCL has no device, or ends the process, where it cannot write: the folder is tried before.
TEST(Limits, ACacheFolderThatCannotBeUsedIsSaidAndDoneWithout) {
  const Folder folder;
  std::ofstream(folder / "file") << "no folder";
  const std::string tooLong =
      (folder / std::string(250, 'a') / std::string(250, 'b') / std::string(250, 'c')).string();
  for (const std::string& cache :
       {(folder / "file").string(), (folder / "file/below").string(), std::string("/proc/none"), tooLong}) {
    SCOPED_TRACE(cache);
    const Outcome run =
        runWhittle({"devices"}, {folder.path(), {{"POCL_CACHE_DIR", cache}, {"TMPDIR", folder.path()}}});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("cpu"), std::string::npos) << run.out;
    EXPECT_EQ(run.err.rfind("warning: compiled kernels cannot be kept in /", 0), 0U) << run.err;
    EXPECT_NE(run.err.find("they go to " + folder.path().string()), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  const Outcome homeless =
      runShell("unset HOME XDG_CACHE_HOME POCL_CACHE_DIR; export TMPDIR=$PWD; \"$WHITTLE\" devices",
               {folder.path(), {}});
  EXPECT_EQ(homeless.status, 0);
  EXPECT_EQ(homeless.err.rfind("warning: no folder for compiled kernels: HOME is not set", 0), 0U)
      << homeless.err;
  const Outcome full = runShell(
      "unshare -Urm sh -c 'mkdir full && mount -t tmpfs -o size=1m none full && TMPDIR=$PWD "
      "POCL_CACHE_DIR=full \"$WHITTLE\" devices'",
      {folder.path(), {}});
  if (full.err.rfind("warning: ", 0) != 0) GTEST_SKIP() << "no namespaces for users here: " << full.err;
  EXPECT_NE(full.err.find("full: its disk has less than 16.8 MB free"), std::string::npos) << full.err;
}

/// Kernels from there are run: a folder in which others may write is none for them.
TEST(Limits, TheKernelsRefugeIsOursAlone) {
  const Folder folder;
  const std::filesystem::path refuge = folder / ("whittle-kernels-" + std::to_string(::geteuid()));
  const auto goesTo = [&] {
    const Outcome run = runWhittle(
        {"devices"}, {folder.path(), {{"POCL_CACHE_DIR", "/proc/none"}, {"TMPDIR", folder.path()}}});
    const std::size_t begin = run.err.find("they go to ") + 11;
    return run.err.substr(begin, run.err.find(';', begin) - begin);
  };
  EXPECT_EQ(goesTo(), refuge.string());
  EXPECT_EQ(std::filesystem::status(refuge).permissions(), std::filesystem::perms::owner_all);
  EXPECT_EQ(goesTo(), refuge.string()) << "the next run finds it";
  std::filesystem::permissions(refuge, std::filesystem::perms::others_all,
                               std::filesystem::perm_options::add);
  EXPECT_NE(goesTo(), refuge.string());
}

}  // namespace
}  // namespace whittle::test
