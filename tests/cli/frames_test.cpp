// --time, --animation and --frames, as a user meets them.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cli/frames.h"
#include "gltf/builder.h"
#include "image/image_io.h"
#include "run_whittle.h"

namespace whittle::test {
namespace {

using Names = std::vector<std::string>;

/// A glowing triangle before a camera; for a second one of them moves sideways.
std::string movingScene(bool camera, bool lamp = false) {
  GltfBuilder b;
  b.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  const int material = b.material({{"emissiveFactor", {1, 0.5, 0.25}}});
  const int mesh = b.node({{"mesh", b.triangleMesh({{"material", material}})}});
  const int eye = b.node({{"camera", 0}, {"translation", {0, 0, 3}}});
  if (lamp) {
    b.json["extensionsUsed"] = {"KHR_lights_punctual"};
    b.json["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::array({{{"type", "point"}, {"intensity", 1e6}}});
    b.node({{"translation", {2, 0, 2}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  }
  const int times = b.floats("SCALAR", 1, {0, 1});
  b.json["accessors"][times]["min"] = {0}, b.json["accessors"][times]["max"] = {1};
  const int places =
      b.vec3(camera ? std::vector<float>{0, 0, 3, 1, 0, 3} : std::vector<float>{0, 0, 0, -1, 0, 0});
  b.push("animations",
         {{"name", "slide"},
          {"samplers", {{{"input", times}, {"output", places}}}},
          {"channels",
           {{{"sampler", 0}, {"target", {{"node", camera ? eye : mesh}, {"path", "translation"}}}}}}});
  return b.glb();
}

void write(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

Names small(Names more) {
  Names args{"render", "moving.glb", "--width", "24", "--height", "16", "--quiet"};
  args.insert(args.end(), more.begin(), more.end());
  return args;
}

TEST(Frames, EachIsThePictureOfItsTime) {
  for (const bool camera : {true, false}) {
    const Folder folder;
    write(folder / "moving.glb", movingScene(camera));
    const Outcome all = runWhittle(
        small({"--frames", "1:3", "--fps", "4", "-o", "f_##.exr", "--stats", "s.json"}), {folder.path(), {}});
    ASSERT_EQ(all.status, 0) << all.err;
    EXPECT_EQ(folder.names(), (Names{"f_01.exr", "f_02.exr", "f_03.exr", "moving.glb", "s_0001.json",
                                     "s_0002.json", "s_0003.json"}));
    std::vector<std::vector<float>> seen;
    for (const char* k : {"1", "2", "3"}) {
      const std::string time = std::to_string(std::stoi(k) / 4.0);
      ASSERT_EQ(runWhittle(small({"--time", time, "-o", "one.exr"}), {folder.path(), {}}).status, 0);
      seen.push_back(readFloatImage(folder / "one.exr").pixels);
      EXPECT_EQ(readFloatImage(folder / (std::string("f_0") + k + ".exr")).pixels, seen.back())
          << k << camera;
      EXPECT_EQ(readJson(folder / (std::string("s_000") + k + ".json"))["settings"]["time"], std::stod(time));
    }
    EXPECT_NE(seen[0], seen[2]) << "something moved";
  }
}

TEST(Frames, WhatDoesNotMoveIsSaid) {
  const Folder folder;
  write(folder / "moving.glb", movingScene(false));
  GltfBuilder still;
  still.node({{"mesh", still.triangleMesh()}});
  write(folder / "still.glb", still.glb());
  const auto warned = [&](const char* file, const char* frames) {
    return runWhittle({"render", file, "--width", "8", "--height", "8", "--quiet", "--frames", frames, "-o",
                       "f.exr"},
                      {folder.path(), {}})
        .err;
  };
  EXPECT_NE(warned("still.glb", "0:1").find("the 2 pictures are alike"), std::string::npos);
  EXPECT_EQ(warned("still.glb", "0:0").find("alike"), std::string::npos) << "one picture";
  EXPECT_EQ(warned("moving.glb", "0:1").find("alike"), std::string::npos);
}

/// A pane that is opaque at 0 s and clear at 1 s, before a glowing wall that is there from 0.5 s on.
std::string changingScene() {
  GltfBuilder b;
  b.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  const int pane = b.material({{"emissiveFactor", {0, 0.25, 0}},
                               {"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                               {"extensions", {{"KHR_materials_transmission", Json::object()}}}});
  const int glow = b.material({{"emissiveFactor", {1, 0.5, 0.25}}});
  b.node({{"mesh", b.triangleMesh({{"material", pane}})}});
  const int wall = b.node({{"mesh", b.triangleMesh({{"material", glow}})},
                           {"translation", {-1, -1, -1}},
                           {"scale", {4, 4, 1}},
                           {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
  b.node({{"camera", 0}, {"translation", {0.3, 0.3, 2}}});
  const int times = b.floats("SCALAR", 1, {0, 1}), clear = b.floats("SCALAR", 1, {0, 1});
  const int moments = b.floats("SCALAR", 1, {0, 0.5F});
  b.json["accessors"][times]["max"] = {1};
  const int shown = b.accessor(b.view<std::uint8_t>({0, 1}), "SCALAR", kUbyte, 2);
  const auto channel = [](int sampler, const std::string& pointer) {
    return Json{{"sampler", sampler},
                {"target",
                 {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}};
  };
  b.push("animations",
         {{"samplers",
           {{{"input", times}, {"output", clear}},
            {{"input", moments}, {"output", shown}, {"interpolation", "STEP"}}}},
          {"channels",
           {channel(0, "/materials/0/extensions/KHR_materials_transmission/transmissionFactor"),
            channel(1, "/nodes/" + std::to_string(wall) + "/extensions/KHR_node_visibility/visible")}}});
  return b.glb();
}

/// What a scene needs is asked of each frame: the first lets no light through, and has one mesh.
TEST(Frames, WhatChangesByPointerIsThePictureOfItsTime) {
  const Folder folder;
  write(folder / "moving.glb", changingScene());
  const Outcome all =
      runWhittle(small({"--frames", "0:2", "--fps", "2", "-o", "f_#.exr"}), {folder.path(), {}});
  ASSERT_EQ(all.status, 0) << all.err;
  EXPECT_EQ(all.err.find("alike"), std::string::npos) << all.err;
  std::set<std::vector<float>> seen;
  for (const char* k : {"0", "1", "2"}) {
    const std::string time = std::to_string(std::stoi(k) / 2.0);
    ASSERT_EQ(runWhittle(small({"--time", time, "-o", "one.exr"}), {folder.path(), {}}).status, 0);
    const auto pixels = readFloatImage(folder / "one.exr").pixels;
    EXPECT_EQ(readFloatImage(folder / (std::string("f_") + k + ".exr")).pixels, pixels) << k;
    seen.insert(pixels);
  }
  EXPECT_EQ(seen.size(), 3U);
  const Outcome info = runWhittle({"info", "moving.glb"}, {folder.path(), {}});
  EXPECT_NE(info.out.find("1 s; 2 properties by KHR_animation_pointer"), std::string::npos) << info.out;
}

/// Texels stay on the device while meshes move below a sky that stays.
TEST(Frames, TexturedOnesAreThePicturesOfTheirTimes) {
  const std::filesystem::path cube =
      std::filesystem::path(WHITTLE_SHARED) / "gltf/AnimatedCube/glTF/AnimatedCube.gltf";
  if (!std::filesystem::exists(cube)) GTEST_SKIP() << "needs " << cube;
  const Folder folder;
  const Names options{"--width", "32",    "--height", "24",        "--sky", "30,20",  "--ambient",
                      "1",       "--eye", "3,3,4",    "--look-at", "0,0,0", "--quiet"};
  const auto draw = [&](const Names& more) {
    Names args{"render", cube.string()};
    args.insert(args.end(), options.begin(), options.end());
    args.insert(args.end(), more.begin(), more.end());
    const Outcome run = runWhittle(args, {folder.path(), {}});
    EXPECT_EQ(run.status, 0) << run.err;
  };
  draw({"--frames", "0:2", "--fps", "2", "-o", "f_#.exr"});
  for (const char* k : {"0", "1", "2"}) {
    draw({"--time", std::to_string(std::stoi(k) / 2.0), "-o", "one.exr"});
    EXPECT_EQ(readFloatImage(folder / (std::string("f_") + k + ".exr")).pixels,
              readFloatImage(folder / "one.exr").pixels)
        << k;
  }
}

/// Of a camera that moves nothing but the camera is sent: no second tree.
TEST(Frames, WhatDoesNotMoveIsKept) {
  for (const bool camera : {true, false}) {
    const Folder folder;
    write(folder / "moving.glb", movingScene(camera));
    ASSERT_EQ(runWhittle(small({"--frames", "0:1", "--fps", "2", "--stats", "s.json", "--search", "tree"}),
                         {folder.path(), {}})
                  .status,
              0);
    const auto second = readJson(folder / "s_0001.json")["time"];
    EXPECT_GT(readJson(folder / "s_0000.json")["time"]["build"], 0.0);
    EXPECT_EQ(second["build"] == 0.0, camera) << second;
  }
}

/// A camera that is ours does not follow what moves: far to the left it is out of the picture.
TEST(Frames, AnAddedCameraStays) {
  GltfBuilder b;
  const int node =
      b.node({{"mesh", b.triangleMesh({{"material", b.material({{"emissiveFactor", {1, 1, 1}}})}})}});
  const int times = b.floats("SCALAR", 1, {0, 1}), places = b.vec3({0, 0, 0, -50, 0, 0});
  b.push("animations",
         {{"samplers", {{{"input", times}, {"output", places}}}},
          {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}}}}});
  const Folder folder;
  write(folder / "moving.glb", b.glb());
  ASSERT_EQ(runWhittle(small({"--no-default-background", "--no-default-lights", "--frames", "0:1", "--fps",
                              "1", "-o", "f.exr"}),
                       {folder.path(), {}})
                .status,
            0);
  const auto lit = [&](const char* file) {
    const auto pixels = readFloatImage(folder / file).pixels;
    return std::any_of(pixels.begin(), pixels.end(), [](float v) { return v > 0; });
  };
  EXPECT_TRUE(lit("f_0000.exr"));
  EXPECT_FALSE(lit("f_0001.exr"));
}

/// The ambient light that goes with a sky depends on how far a lamp is from what moves; a film keeps the
/// first.
TEST(Frames, AmbientLightIsThatOfTheFirst) {
  const Folder folder;
  write(folder / "moving.glb", movingScene(false, true));
  const auto ambient = [&](const Names& options, const char* file) {
    Names more{"--sky", "30,0", "--stats", "s.json"};
    more.insert(more.end(), options.begin(), options.end());
    EXPECT_EQ(runWhittle(small(more), {folder.path(), {}}).status, 0);
    return readJson(folder / file)["settings"]["ambient"].get<double>();
  };
  const double first = ambient({"--frames", "0:1", "--fps", "1"}, "s_0000.json");
  EXPECT_EQ(readJson(folder / "s_0001.json")["settings"]["ambient"].get<double>(), first);
  EXPECT_NE(ambient({"--time", "1"}, "s.json"), first) << "or the test shows nothing";
}

TEST(Frames, NamesHaveTheirNumber) {
  EXPECT_EQ(cli::frameFile("a.png", 7), "a_0007.png");
  EXPECT_EQ(cli::frameFile("out/a#.png", 123), "out/a123.png");
  EXPECT_EQ(cli::frameFile("b#/a.###.exr", 7), "b#/a.007.exr");
  EXPECT_EQ(cli::frameFile("##_#.png", 4), "##_4.png");
}

TEST(Frames, NonsenseIsRefused) {
  const Folder folder;
  write(folder / "moving.glb", movingScene(true));
  const auto refused = [&](const Names& options, const std::string& words) {
    const Outcome run = runWhittle(small(options), {folder.path(), {}});
    EXPECT_EQ(run.status, 2) << words;
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
  };
  refused({"--frames", "3"}, "--frames: '3' is not the first and the last frame");
  refused({"--frames", "3:1"}, "comes before the first");
  refused({"--frames", "-1:2"}, "--frames");
  refused({"--frames", "0:1", "--time", "1"}, "--time and --frames");
  refused({"--frames", "0:1", "--explain", "1,1"}, "--explain: is for one picture");
  refused({"--frames", "0:1", "--stats", "-"}, "--stats");
  refused({"--fps", "3"}, "--fps");
  refused({"--time", "soon"}, "--time");
  refused({"--time", "1", "--animation", "fly"}, "has no animation \"fly\"");
  EXPECT_EQ(folder.names(), Names{"moving.glb"});
}

TEST(Frames, InfoListsAnimations) {
  const Folder folder;
  write(folder / "moving.glb", movingScene(true));
  const Outcome text = runWhittle({"info", "moving.glb"}, {folder.path(), {}});
  EXPECT_NE(text.out.find("1 animation, --time SECONDS shows one"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("slide"), std::string::npos);
  const auto json =
      nlohmann::json::parse(runWhittle({"info", "moving.glb", "--json"}, {folder.path(), {}}).out);
  EXPECT_EQ(json["animations"], (nlohmann::json{{{"name", "slide"}, {"seconds", 1.0}, {"pointers", 0}}}));
}

}  // namespace
}  // namespace whittle::test
