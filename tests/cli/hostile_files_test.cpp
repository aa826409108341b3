// Scenes and pictures that are no files, reach elsewhere, or hold text that a terminal would obey.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>

#include "cli/run_whittle.h"

namespace whittle::test {
namespace {

using Names = std::vector<std::string>;

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

/// A pipe with no other end, and a device without end, wherever a picture is read.
TEST(HostileFiles, WhatIsNoRegularFileIsRefusedAtOnce) {
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

TEST(HostileFiles, FilesOutsideTheScenesFolderAreSaidAndRefusedOnDemand) {
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
TEST(HostileFiles, NoInputIsOverwritten) {
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

TEST(HostileFiles, NamesOfAFileReachTheTerminalAsEscapes) {
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
TEST(HostileFiles, NoStringOfAFileReachesTheTerminalRaw) {
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

}  // namespace
}  // namespace whittle::test
