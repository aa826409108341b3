// --memory-limit: what it takes, what it refuses, and that a refusal is quick and small.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "cli/run_whittle.h"

namespace whittle::test {
namespace {

using Json = nlohmann::json;

Outcome limited(const std::string& command, const std::string& limit, std::vector<std::string> more = {}) {
  const Folder folder;
  std::vector<std::string> args{command, scene(), "--memory-limit", limit, "--width", "32", "--height", "24"};
  if (command != "info") args.insert(args.end(), {"-o", "a.exr", "--quiet"});
  args.insert(args.end(), more.begin(), more.end());
  return runWhittle(args, {folder.path(), {}});
}

TEST(MemoryLimit, IsASize) {
  for (const char* word : {"", "much", "-4G", "0", "4X"}) {
    const Outcome run = limited("info", word);
    EXPECT_EQ(run.status, 2) << word;
    EXPECT_EQ(run.err,
              "whittle: --memory-limit: '" + std::string(word) + "' is not a size such as 500M or 4G\n");
  }
}

TEST(MemoryLimit, WithoutAUnitIsTakenForAForgottenOne) {
  const Outcome run = limited("info", "4");
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err,
            "whittle: --memory-limit: '4' is 4 B, less than anything takes; sizes have units: 500M, 4G\n");
}

TEST(MemoryLimit, BindsEveryCommandThatReadsAScene) {
  for (const char* command : {"render", "reference", "info"}) {
    const Outcome small = limited(command, "50M");
    EXPECT_EQ(small.status, 2) << command;
    EXPECT_NE(small.err.find("the limit is 50 MB: a larger --memory-limit allows more"), std::string::npos)
        << small.err;
    EXPECT_EQ(std::count(small.err.begin(), small.err.end(), '\n'), 1) << small.err;
    const Outcome large = limited(command, "2GiB");
    EXPECT_EQ(large.status, 0) << large.err;
  }
}

TEST(MemoryLimit, CountsThePicture) {
  const Outcome run = limited("render", "1G", {"--width", "10000", "--height", "10000"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("a picture of 10000×10000 would take "), std::string::npos) << run.err;
}

TEST(MemoryLimit, CountsTheMapOfTheBackground) {
  const Folder folder;
  std::ofstream(folder / "sky.hdr") << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 20000 +X 40000\n";
  const Outcome run = limited("info", "1G", {"--background", (folder / "sky.hdr").string()});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("40000×20000 texels"), std::string::npos) << run.err;
}

struct Usage {
  int status = -1;
  double seconds = 0.0;
  long kilobytes = 0;  ///< resident at most
};

Usage usageOf(const std::vector<std::string>& args) {
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) {
    std::vector<char*> argv{const_cast<char*>(WHITTLE_BINARY)};
    for (const auto& arg : args) argv.push_back(const_cast<char*>(arg.c_str()));
    argv.push_back(nullptr);
    execv(WHITTLE_BINARY, argv.data());
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), usage.ru_maxrss};
}

/// A triangle, drawn as often as accessors without data say.
Json manyTriangles(std::uint64_t instances, std::uint64_t corners) {
  const auto zeros = [](const char* type, int componentType, std::uint64_t count) {
    return Json{{"type", type}, {"componentType", componentType}, {"count", count}};
  };
  return {
      {"asset", {{"version", "2.0"}}},
      {"accessors", {zeros("VEC3", 5126, 3), zeros("SCALAR", 5125, corners), zeros("VEC3", 5126, instances)}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
      {"nodes",
       {{{"mesh", 0},
         {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", 2}}}}}}}}}}};
}

/// Images that say they are large. Nothing follows their headers: they are counted before they are decoded.
Json manyPixels(int images) {
  Json json = manyTriangles(1, 3);
  for (int i = 0; i < images; ++i) {
    // The start of a PNG of 16384×16384; the fragment tells one from another.
    json["images"].push_back({{"uri", "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAQAAAAEAACAIAAAA" +
                                          std::string(static_cast<std::size_t>(i) * 4, 'A')}});
    json["textures"].push_back({{"source", i}});
    json["materials"].push_back({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
    json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"material", i}});
  }
  return json;
}

TEST(MemoryLimit, SmallFilesThatAskForMuchEndAtOnce) {
  const Folder folder;
  const auto file = [&](const char* name, const Json& json) {
    std::ofstream(folder / name) << json.dump();
    return (folder / name).string();
  };
  const std::vector<std::string> bombs{
      file("instances.gltf", manyTriangles(1 << 24, 6)), file("corners.gltf", manyTriangles(1000, 3 << 20)),
      file("both.gltf", manyTriangles(1 << 24, 1 << 24)), file("pixels.gltf", manyPixels(40))};
  for (const std::string& bomb : bombs) {
    const Usage usage = usageOf({"render", bomb, "-o", (folder / "a.png").string(), "--quiet"});
    EXPECT_EQ(usage.status, 2) << bomb;
    EXPECT_LT(usage.seconds, 2.0) << bomb;
    EXPECT_LT(usage.kilobytes, 300'000) << bomb;
  }
}

/// `info`'s peak against a process of its own, whose kernels are compiled already.
void expectPeak(std::vector<std::string> args) {
  const Outcome info = [&] {
    std::vector<std::string> all{"info", "--json"};
    all.insert(all.end(), args.begin(), args.end());
    return runWhittle(all);
  }();
  ASSERT_EQ(info.status, 0) << info.err;
  const auto said = Json::parse(info.out)["peakBytes"].get<double>();
  const Folder folder;
  args.insert(args.begin(), "render");
  args.insert(args.end(), {"--quiet", "-o", (folder / "a.png").string()});
  ASSERT_EQ(usageOf(args).status, 0);
  const Usage usage = usageOf(args);
#ifndef __SANITIZE_ADDRESS__
  EXPECT_NEAR(said / 1024.0 / static_cast<double>(usage.kilobytes), 1.0, 0.2)
      << "said " << said / 1e6 << " MB, took " << static_cast<double>(usage.kilobytes) * 1.024e-3;
#endif
}

TEST(PeakMemory, IsThatOfASmallRender) { expectPeak({scene(), "--width", "64", "--height", "48"}); }

TEST(PeakMemory, GrowsWithThePicture) {
  expectPeak({scene("shadow.glb"), "--width", "3000", "--height", "2000"});
}

TEST(PeakMemory, GrowsWithTheTriangles) {
  // A million of them, on a grid of instances.
  const Folder folder;
  constexpr int kInstances = 1000, kTriangles = 1000;
  std::string binary;
  const auto add = [&](const std::vector<float>& values) {
    binary.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  };
  for (int i = 0; i < kTriangles; ++i) {
    const auto x = static_cast<float>(i % 32) / 32.0F, y = static_cast<float>(i / 32) / 32.0F;
    add({x, y, 0.1F * x, x + 0.03F, y, 0.1F * y, x, y + 0.03F, 0.1F * x * y});
  }
  for (int i = 0; i < kInstances; ++i)
    add({static_cast<float>(i % 32), static_cast<float>(i / 32), static_cast<float>(i % 7)});
  std::ofstream(folder / "a.bin", std::ios::binary) << binary;
  const std::size_t split = std::size_t{kTriangles} * 36;
  const Json json{
      {"asset", {{"version", "2.0"}}},
      {"buffers", {{{"byteLength", binary.size()}, {"uri", "a.bin"}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteLength", split}},
        {{"buffer", 0}, {"byteOffset", split}, {"byteLength", binary.size() - split}}}},
      {"accessors",
       {{{"bufferView", 0}, {"type", "VEC3"}, {"componentType", 5126}, {"count", 3 * kTriangles}},
        {{"bufferView", 1}, {"type", "VEC3"}, {"componentType", 5126}, {"count", kInstances}}}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
      {"nodes",
       {{{"mesh", 0},
         {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", 1}}}}}}}}}}};
  std::ofstream(folder / "a.gltf") << json.dump();
  expectPeak({(folder / "a.gltf").string(), "--width", "64", "--height", "48"});
}

}  // namespace
}  // namespace whittle::test
