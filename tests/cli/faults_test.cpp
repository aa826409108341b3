// Standard streams that take nothing must not end a render or lose its picture.
#include <gtest/gtest.h>

#include <algorithm>

#include "cli/run_whittle.h"

namespace whittle::test {
namespace {

using Names = std::vector<std::string>;

/// A render that says something on standard error: znear and zfar of this scene leave a note, and so do dark
/// lamps.
std::string talkative(const std::string& more) {
  return "\"$WHITTLE\" render " + scene("mirror_box.glb") + " --width 32 --height 24 --bounces 2 -o a.exr " +
         more;
}

void expectPicture(const Folder& folder, const Outcome& run) {
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(folder.names(), Names{"a.exr"});
  EXPECT_EQ(readText(folder / "a.exr").substr(0, 4), "\x76\x2f\x31\x01") << "the magic number of OpenEXR";
}

TEST(Faults, TheRenderSaysSomething) {
  const Folder folder;
  const Outcome run = runShell(talkative(""), {folder.path(), {}});
  expectPicture(folder, run);
  EXPECT_NE(run.err.find("note: "), std::string::npos) << "or the tests below show nothing";
}

TEST(Faults, AStandardErrorThatTakesNothingEndsNothing) {
  for (const char* fault : {"2>/dev/full", "2>&-", "2>/dev/null"}) {
    const Folder folder;
    const Outcome run = runShell(talkative(fault), {folder.path(), {}});
    SCOPED_TRACE(fault);
    expectPicture(folder, run);
  }
}

TEST(Faults, AllStreamsMayBeClosed) {
  const Folder folder;
  const Outcome run = runShell(talkative("<&- >&- 2>&-"), {folder.path(), {}});
  EXPECT_EQ(folder.names(), Names{"a.exr"});
  EXPECT_EQ(readText(folder / "a.exr").substr(0, 4), "\x76\x2f\x31\x01") << "messages went into the picture";
}

TEST(Faults, ALogFileThatIsFullEndsNothing) {
  const Folder folder, log;
  // A log of 4 MB where files may have 1 MB (in units of 512 bytes, as POSIX has them): nothing more fits
  // into it.
  const Outcome run = runShell("truncate -s 4M " + (log / "log").string() + "; ulimit -f 2048; " +
                                   talkative("2>>" + (log / "log").string()),
                               {folder.path(), {}});
  expectPicture(folder, run);
}

TEST(Faults, AReaderThatHasGoneEndsNothingButTheStreamItReads) {
  const Folder folder;
  const Outcome error = runShell("exec 3>&1; { " + talkative("2>&1 >&3 3>&-") +
                                     "; echo $? >status; } | true; sleep 0.1; cat status; "
                                     "rm status",
                                 {folder.path(), {}});
  EXPECT_EQ(error.out.substr(error.out.size() - 2), "0\n") << error.out << error.err;
  EXPECT_EQ(folder.names(), Names{"a.exr"});
  // Standard output: as other programs do, without a word. The shell says 128 and the signal.
  const Outcome output = runShell("{ \"$WHITTLE\" render --help; echo $? >&2; } | true", {folder.path(), {}});
  EXPECT_TRUE(output.err == "141\n" || output.err == "0\n") << output.err;
}

}  // namespace
}  // namespace whittle::test
