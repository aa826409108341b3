// What must not end a render or lose its picture: streams that take nothing, files that never end, memory
// that is short.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>

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

/// A pipe with no other end, and a device without end, wherever a picture is read.
TEST(Faults, WhatIsNoRegularFileIsRefusedAtOnce) {
  const Folder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe.exr").c_str(), 0600), 0);
  std::filesystem::create_symlink("pipe.exr", folder / "link.exr");
  std::filesystem::create_symlink("/dev/zero", folder / "zero.hdr");
  for (const char* file : {"pipe.exr", "link.exr", "zero.hdr", "/dev/zero"})
    for (const std::vector<std::string>& command : {smallRender({"--background", file, "-o", "a.exr"}),
                                                    smallRender({"--reference", file, "-o", "a.exr"}),
                                                    std::vector<std::string>{"compare", file, file}}) {
      const auto begin = std::chrono::steady_clock::now();
      const Outcome run = runWhittle(command, {folder.path(), {}});
      EXPECT_EQ(run.status, 2) << file;
      EXPECT_NE(run.err.find("is not a regular file"), std::string::npos) << run.err;
      EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
    }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));
}

/// A triangle whose buffer, and a texture that no file holds, are named by `buffer` and `image`.
void writeTriangle(const std::filesystem::path& file, const std::string& buffer, const std::string& image) {
  std::ofstream(file)
      << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
    "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
    "textures":[{"source":0}],"images":[{"uri":")"
      << image << R"("}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
    "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")"
      << buffer << R"("}]})";
}

TEST(Faults, FilesOutsideTheScenesFolderAreSaidAndRefusedOnDemand) {
  const Folder folder;
  std::filesystem::create_directory(folder / "in");
  const float points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::ofstream(folder / "b.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(points), sizeof(points));
  std::filesystem::copy_file(folder / "b.bin", folder / "in" / "b.bin");
  std::filesystem::create_symlink("../b.bin", folder / "in" / "link.bin");
  const auto info = [&](const std::string& buffer, const std::string& image, bool confined) {
    writeTriangle(folder / "in" / "a.gltf", buffer, image);
    std::vector<std::string> args{"info", "in/a.gltf"};
    if (confined) args.emplace_back("--confine");
    return runWhittle(args, {folder.path(), {}});
  };
  for (const char* outside : {"../b.bin", "link.bin", "../in/../b.bin"}) {
    const Outcome said = info(outside, "t.png", false);
    EXPECT_EQ(said.status, 0) << said.err;
    EXPECT_NE(said.err.find("outside its own folder"), std::string::npos) << outside << ": " << said.err;
    const Outcome refused = info(outside, "t.png", true);
    EXPECT_EQ(refused.status, 2) << outside;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
  }
  const Outcome image = info("b.bin", "../t.png", true);
  EXPECT_EQ(image.status, 2) << "an image that is left out otherwise";
  EXPECT_NE(image.err.find("--confine forbids"), std::string::npos) << image.err;
  for (const char* inside : {"b.bin", "./b.bin", "../in/b.bin"}) {
    const Outcome run = info(inside, "t.png", true);
    EXPECT_EQ(run.status, 0) << inside << ": " << run.err;
    EXPECT_EQ(run.err.find("outside"), std::string::npos) << run.err;
  }
}

TEST(Faults, NamesOfAFileReachTheTerminalAsEscapes) {
  const Folder folder;
  writeTriangle(folder / "a.gltf", "b\\u001b[2J.bin", "t.png");
  const Outcome run = runWhittle({"info", "a.gltf"}, {folder.path(), {}});
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err.find('\x1b'), std::string::npos) << "the escape itself";
  const Outcome name = runWhittle({"info", std::string("no\x1b[2Jsuch\nfile.glb")}, {folder.path(), {}});
  EXPECT_EQ(name.status, 2);
  EXPECT_EQ(name.err.find('\x1b'), std::string::npos);
  EXPECT_NE(name.err.find("[2Jsuch"), std::string::npos) << name.err;
  EXPECT_EQ(std::count(name.err.begin(), name.err.end(), '\n'), 1) << name.err;
}

/// However little there is: an answer in time, one line, and no picture unless it is whole. On this side of
/// the limits the program does not even start; beyond them it renders.
TEST(Faults, ShortMemoryEndsInOneLine) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "a sanitizer takes more addresses than there are";
#endif
  int refused = 0, rendered = 0;
  // The last is enough for a machine of many threads.
  for (const int megabytes : {150, 300, 450, 600, 750, 900, 1050, 1200, 1350, 65536}) {
    const Folder folder;
    const Outcome run =
        runShell("ulimit -v " + std::to_string(megabytes * 1024) + "; exec timeout 60 \"$WHITTLE\" render " +
                     scene("textured.glb") + " --width 32 --height 24 --quiet -o a.exr",
                 {folder.path(), {}});
    SCOPED_TRACE(megabytes);
    EXPECT_NE(run.status, 124) << "it hung";
    // PoCL 3.1 ends the process itself where it gets no threads, and says so.
    if (run.status != -SIGABRT || run.err.find("PTHREAD ERROR") == std::string::npos) {
      EXPECT_GE(run.status, 0) << "a signal ended it: " << run.err;
    }
    EXPECT_EQ(std::filesystem::exists(folder / "a.exr"), run.status == 0) << run.err;
    (run.status == 0 ? rendered : refused) += 1;
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(rendered, 0);
}

TEST(Faults, AKilledRenderLeavesNothing) {
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
