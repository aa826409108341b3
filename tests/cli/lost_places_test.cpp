// Nothing is lost where an output cannot go any more, and what cannot be written is found out first.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>

#include "cli/run_whittle.h"

namespace whittle::test {
namespace {

using Names = std::vector<std::string>;

/// Each output on its own: one of three has a folder no more.
TEST(LostPlaces, AFolderThatVanishesLosesNoPicture) {
  const Folder folder;
  const Outcome run = runShell(
      "mkdir out kept; (sleep 1.5; rmdir out) & \"$WHITTLE\" "
      "render " +
          scene() +
          " --width 64 --height 48 --time-limit 3 -o a.exr -o out/b.exr --aov depth=out/d.exr -o "
          "kept/c.exr --quiet",
      {folder.path(), {}});
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(folder.names(), (Names{"a.exr", "b.exr", "d.exr", "kept"}));
  EXPECT_TRUE(std::filesystem::exists(folder / "kept/c.exr"));
  for (const char* lost : {"b.exr", "d.exr"})
    EXPECT_NE(run.err.find((folder / lost).string() + " instead\n"), std::string::npos) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 2) << run.err;
}

TEST(LostPlaces, AWorkingFolderThatVanishesLosesNoPicture) {
  const Folder folder, temporary;
  std::filesystem::create_directory(folder / "here");
  const Outcome run = runShell("export TMPDIR=" + temporary.path().string() +
                                   "; (sleep 1.5; rmdir ../here) & \"$WHITTLE\" render " + scene() +
                                   " --width 64 --height 48 --time-limit 3 -o a.exr --quiet",
                               {folder / "here", {}});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_EQ(temporary.names(), Names{"a.exr"});
  EXPECT_NE(run.err.find("it is in " + (temporary / "a.exr").string() + " instead"), std::string::npos)
      << run.err;
}

/// What shows before the work is no reason to work: a file system without room, an image codec that is not
/// there.
TEST(LostPlaces, WhatCannotBeWrittenIsFoundOutFirst) {
  const Folder folder;
  const Outcome full = runShell(
      "unshare -Urm sh -c 'mkdir full && mount -t tmpfs -o size=4k none full && head -c 4096 /dev/zero "
      ">full/x && "
      "\"$WHITTLE\" render " +
          scene() + " --rays-per-pixel 1000000 -o a.exr -o full/b.exr --quiet'",
      {folder.path(), {}});
  if (full.err.rfind("whittle: ", 0) != 0) GTEST_SKIP() << "no namespaces for users here: " << full.err;
  EXPECT_EQ(full.status, 1);
  EXPECT_NE(full.err.find("full/b.exr: cannot be written: No space left on device"), std::string::npos)
      << full.err;
  EXPECT_EQ(std::count(full.err.begin(), full.err.end(), '\n'), 1) << full.err;
  EXPECT_EQ(folder.names(), Names{"full"});
}

/// The library that writes pictures lies beside the program, and here it does not.
TEST(LostPlaces, AnImageLibraryThatIsMissingIsFoundOutFirst) {
  const Folder folder;
  // One folder deeper: it looks above itself as well.
  std::filesystem::create_directory(folder / "bin");
  std::filesystem::copy_file(WHITTLE_BINARY, folder / "bin" / "whittle");
  for (const char* command : {"render", "reference"}) {
    const auto begin = std::chrono::steady_clock::now();
    const Outcome run = runShell(std::string("bin/whittle ") + command + " " + scene() +
                                     " --width 64 --height 48 --rays-per-pixel 1000000 -o a.exr --quiet",
                                 {folder.path(), {}});
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.err.rfind("whittle: libwhittle_codec.so", 0), 0U) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(300))
        << "kernels perhaps, no samples";
  }
  EXPECT_EQ(folder.names(), Names{"bin"});
}

TEST(LostPlaces, AKilledRenderLeavesNothing) {
  // At any moment, writing included: the file has no name before it is whole.
  for (int milliseconds = 20; milliseconds <= 500; milliseconds += 40) {
    const Folder folder;
    const Outcome run =
        runShell("\"$WHITTLE\" render " + scene() + " --width 640 --height 400 --quiet -o a.png & sleep " +
                     std::to_string(milliseconds / 1000.0) + "; kill -9 $!; wait $!; true",
                 {folder.path(), {}});
    const Names names = folder.names();
    EXPECT_TRUE(names.empty() || names == Names{"a.png"}) << names.front();
  }
}

}  // namespace
}  // namespace whittle::test
