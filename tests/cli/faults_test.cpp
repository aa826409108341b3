// What must not end a render or lose its picture: streams that take nothing, files that never end, memory
// that is short.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

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

/// Nothing that is read is written over, found out before the work or, for what the scene asks for, before it
/// is rendered.
TEST(Faults, NoInputIsOverwritten) {
  const Folder folder;
  const float points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::ofstream(folder / "b.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(points), sizeof(points));
  writeTriangle(folder / "a.gltf", "b.bin", "t.png");
  const std::string picture = "\"$WHITTLE\" render a.gltf --width 16 --height 12 --quiet ";
  ASSERT_EQ(runShell(picture + "-o t.png -o sky.exr", {folder.path(), {}}).status, 2)
      << "a texture, were it there";
  ASSERT_EQ(runShell(picture + "-o other.png -o sky.exr && mv other.png t.png && ln -s b.bin link.bin",
                     {folder.path(), {}})
                .status,
            0);
  const std::vector<std::string> before{readText(folder / "b.bin"), readText(folder / "t.png"),
                                        readText(folder / "sky.exr"), readText(folder / "a.gltf")};
  for (const char* outputs : {"-o t.png", "--stats b.bin", "--trace link.bin", "-o ./x/../t.png",
                              "--stats a.gltf", "--aov depth=sky.exr --background sky.exr",
                              "-o sky.exr --reference sky.exr", "--stats sky.exr --background sky.exr"}) {
    const Outcome run = runShell("mkdir -p x; " + picture + outputs, {folder.path(), {}});
    EXPECT_EQ(run.status, 2) << outputs;
    EXPECT_NE(run.err.find("is the input; it would be overwritten"), std::string::npos)
        << outputs << ": " << run.err;
  }
  EXPECT_EQ(before, (std::vector<std::string>{readText(folder / "b.bin"), readText(folder / "t.png"),
                                              readText(folder / "sky.exr"), readText(folder / "a.gltf")}));
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

/// The strings of a file, every one: names of all kinds, extensions, generator, URIs, key names.
TEST(Faults, NoStringOfAFileReachesTheTerminalRaw) {
  // Clears a screen, sets a title, turns the text, begins a line of its own.
  const std::string evil = R"(\u001b[2J\u001b]0;title\u0007\u202e\nFORGED: \u009b)";
  const std::string text =
      R"({"asset":{"version":"2.0","generator":"@","copyright":"@"},"scene":0,"scenes":[{"name":"@","nodes":[0,1,2]}],
    "extensionsUsed":["@","KHR_lights_punctual"],
    "extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","name":"@"},{"type":"@","name":"@"}]}},
    "nodes":[{"name":"@","mesh":0},{"name":"@","camera":0},{"name":"@","extensions":{"KHR_lights_punctual":{"light":0}}}],
    "cameras":[{"type":"perspective","name":"@","perspective":{"yfov":1,"znear":1,"zfar":2}}],
    "meshes":[{"name":"@","primitives":[{"attributes":{"POSITION":0,"@":0},"material":0}]}],
    "materials":[{"name":"@","alphaMode":"@","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
    "textures":[{"source":0,"name":"@"}],"images":[{"uri":"@.png","name":"@","mimeType":"@"}],
    "samplers":[{"name":"@"}],"animations":[{"name":"@","channels":[],"samplers":[]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0],"name":"@"}],
    "bufferViews":[{"buffer":0,"byteLength":36,"name":"@"}],"buffers":[{"byteLength":36,"uri":"b.bin","name":"@"}]})";
  const Folder folder;
  const float points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::ofstream(folder / "b.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(points), sizeof(points));
  const auto expectClean = [](const std::string& said, const std::string& what) {
    for (const char* raw : {"\x1b", "\x07", "\u202e", "\u009b", "\nFORGED"})
      EXPECT_EQ(said.find(raw), std::string::npos) << what << " says\n" << said;
  };
  // Each string alone among harmless ones, then all at once, so that every message is met, refusals too.
  const auto strings = static_cast<std::size_t>(std::count(text.begin(), text.end(), '@'));
  int refused = 0, read = 0;
  for (std::size_t one = 0; one <= strings; ++one) {
    std::ostringstream file;
    std::size_t index = 0;
    for (const char c : text) {
      if (c != '@') {
        file << c;
        continue;
      }
      if (one == strings || index == one)
        file << evil;
      else
        file << 'x' << index;
      ++index;
    }
    std::ofstream(folder / "a.gltf") << file.str();
    std::vector<std::vector<std::string>> commands{{"info", "a.gltf"}};
    if (one == strings)
      for (const char* more : {"--json", "--camera=none", "--confine"})
        commands.push_back({"info", "a.gltf", more});
    for (const auto& args : commands) {
      const Outcome run = runWhittle(args, {folder.path(), {}});
      EXPECT_TRUE(run.status == 0 || run.status == 2) << run.err;
      (run.status == 0 ? read : refused) += 1;
      expectClean(run.out, "string " + std::to_string(one));
      expectClean(run.err, "string " + std::to_string(one));
    }
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
}

/// The library that writes pictures lies beside the program, and here it does not.
TEST(Faults, AnImageLibraryThatIsMissingIsFoundOutFirst) {
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

/// However little there is: an answer in time, one line, and no picture unless it is whole. On this side of
/// the limits the program does not even start; beyond them it renders.
TEST(Faults, ShortMemoryEndsInOneLine) {
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

/// Each output on its own: one of three has a folder no more.
TEST(Faults, AFolderThatVanishesLosesNoPicture) {
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

TEST(Faults, AWorkingFolderThatVanishesLosesNoPicture) {
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
TEST(Faults, WhatCannotBeWrittenIsFoundOutFirst) {
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

/// PoCL has no device, or ends the process, where it cannot write: the folder is tried before.
TEST(Faults, ACacheFolderThatCannotBeUsedIsSaidAndDoneWithout) {
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
  EXPECT_NE(full.err.find("No space left on device"), std::string::npos) << full.err;
}

/// Kernels from there are run: a folder in which others may write is none for them.
TEST(Faults, TheKernelsRefugeIsOursAlone) {
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

/// PoCL keeps the private variables of a whole group on a thread's stack, whatever size that has.
TEST(Faults, TheLargestWorkGroupFindsRoomOnASmallStack) {
  const Folder folder;
  const Outcome run = runShell("ulimit -s 512; \"$WHITTLE\" render " + scene("textured.glb") +
                                   " --width 32 --height 24 --work-group 4096 -o a.exr --quiet",
                               {folder.path(), {}});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(folder.names(), Names{"a.exr"});
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
