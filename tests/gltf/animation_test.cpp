// Animations: where nodes, skins and morph targets are at a time, and files whose animations are wrong.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gltf/builder.h"
#include "gltf/keyframes.h"

namespace whittle {
namespace {

using gltf::Blend;
using gltf::Interpolation;
using gltf::Keyframes;
using gltf::valueAt;
using test::at;
using test::corner;
using test::expectNear;
using test::GltfBuilder;
using test::Json;
using test::mentions;

constexpr double kPi = std::numbers::pi;

/// A turn about +Z.
std::vector<float> aboutZ(double radians) {
  return {0, 0, static_cast<float>(std::sin(radians / 2)), static_cast<float>(std::cos(radians / 2))};
}

void append(std::vector<float>& to, const std::vector<float>& values) {
  to.insert(to.end(), values.begin(), values.end());
}

TEST(Keyframes, StraightLinesStepsAndEnds) {
  Keyframes keys{Interpolation::Linear, Blend::Straight, {1, 3}, {10, 0, 20, 8}, 2};
  EXPECT_EQ(valueAt(keys, 1.5), (std::vector<double>{12.5, 2}));
  EXPECT_EQ(valueAt(keys, 0), (std::vector<double>{10, 0})) << "before the first";
  EXPECT_EQ(valueAt(keys, 3), (std::vector<double>{20, 8}));
  EXPECT_EQ(valueAt(keys, 99), (std::vector<double>{20, 8})) << "after the last";
  keys.interpolation = Interpolation::Step;
  EXPECT_EQ(valueAt(keys, 2.999), (std::vector<double>{10, 0}));
  EXPECT_EQ(valueAt(keys, 3), (std::vector<double>{20, 8}));
  const Keyframes twice{Interpolation::Linear, Blend::Straight, {0, 1, 1, 2}, {0, 1, 5, 6}, 1};
  EXPECT_EQ(valueAt(twice, 1), (std::vector<double>{5})) << "a jump: two keyframes at one time";
  EXPECT_EQ(valueAt(twice, 1.5), (std::vector<double>{5.5}));
}

/// A cubic is its own Hermite spline: f(t) = t³ − 2t from 1 to 3, with f' = 3t² − 2.
TEST(Keyframes, SplinesAreHermites) {
  const auto f = [](double t) { return t * t * t - 2 * t; };
  const auto slope = [](double t) { return static_cast<float>(3 * t * t - 2); };
  const Keyframes keys{Interpolation::CubicSpline,
                       Blend::Straight,
                       {1, 3},
                       {77, static_cast<float>(f(1)), slope(1), slope(3), static_cast<float>(f(3)), -77},
                       1};
  for (const double t : {1.0, 1.25, 2.0, 2.9, 3.0}) EXPECT_NEAR(valueAt(keys, t)[0], f(t), 1e-12) << t;
}

/// At a constant speed, the shorter way, also where the file has one end as its negative.
TEST(Keyframes, TurnsAreSpherical) {
  std::vector<float> values = aboutZ(0.2);
  append(values, aboutZ(1.4));
  Keyframes keys{Interpolation::Linear, Blend::Turn, {0, 1}, values, 4};
  for (const double sign : {1.0, -1.0}) {
    for (std::size_t i = 4; i < 8; ++i) keys.values[i] = static_cast<float>(sign) * values[i];
    for (const double t : {0.0, 0.1, 0.5, 0.8}) {
      const auto q = valueAt(keys, t);
      EXPECT_NEAR(2 * std::atan2(q[2], q[3]), 0.2 + 1.2 * t, 1e-7) << t;  // the file's floats
    }
  }
  // A spline of turns is a straight one, made 1 long again (appendix C).
  const Keyframes spline{Interpolation::CubicSpline,
                         Blend::Turn,
                         {0, 1},
                         {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0},
                         4};
  const auto half = valueAt(spline, 0.5);
  EXPECT_NEAR(half[2], std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(half[3], std::sqrt(0.5), 1e-12);
}

/// An animation that moves `path` of a node through these values at 0, 1, 2, … seconds.
void animate(GltfBuilder& b, int node, const std::string& path, const char* type, int components,
             const std::vector<float>& values, const char* interpolation = "LINEAR") {
  const std::size_t elements = values.size() / static_cast<std::size_t>(components);
  std::vector<float> times(interpolation == std::string("CUBICSPLINE") ? elements / 3 : elements);
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<float>(i);
  const int input = b.floats("SCALAR", 1, times), output = b.floats(type, components, values);
  b.json["accessors"][input]["min"] = {0}, b.json["accessors"][input]["max"] = {times.back()};
  if (!b.json.contains("animations"))
    b.push("animations", {{"name", "walk"}, {"channels", Json::array()}, {"samplers", Json::array()}});
  Json& animation = b.json["animations"].back();
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
  animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
}

/// What a channel does not move stays as the file has it; children go along.
TEST(GltfAnimation, NodesMoveTurnAndGrow) {
  GltfBuilder b;
  const int leaf = b.node({{"mesh", b.triangleMesh()}, {"translation", {1, 0, 0}}}, false);
  const int root = b.node({{"scale", {2, 2, 2}}, {"translation", {0, 5, 0}}, {"children", {leaf}}});
  std::vector<float> turns = aboutZ(0);
  append(turns, aboutZ(kPi));
  animate(b, root, "rotation", "VEC4", 4, turns);
  animate(b, leaf, "scale", "VEC3", 3, {1, 1, 1, 3, 3, 3});
  const Scene rest = b.load();
  expectNear(corner(rest, 0, 1), {4, 5, 0}, 0);
  EXPECT_FALSE(rest.meshesMove);
  EXPECT_TRUE(mentions(b.notices.notes, "\"walk\", 1 s long"));
  const Scene half = b.load(at(0.5));
  EXPECT_TRUE(half.meshesMove);
  // A quarter turn takes (1 + 2·1, 0) to +Y, twice as large, at (0, 5).
  expectNear(corner(half, 0, 1), {0, 5 + 2 * 3, 0}, 1e-6F);
  expectNear(corner(half, 0, 0), {0, 5 + 2 * 1, 0}, 1e-6F);
}

/// An open file is where one is that was loaded at that time: meshes (turned, skinned, blended), cameras,
/// lights. What others added stays.
TEST(GltfAnimation, AnOpenFileMovesAsOneThatIsLoadedAnew) {
  GltfBuilder b;
  b.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
  b.json["extensionsUsed"] = {"KHR_lights_punctual"};
  b.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "point"}}});
  Json morphed{{"targets", {{{"POSITION", b.vec3({0, 0, 1, 0, 0, 2, 0, 0, 3})}}}}};
  const int blended = b.node({{"mesh", b.triangleMesh(morphed)}});
  const int eye = b.node({{"camera", 0}, {"translation", {0, 0, 3}}});
  const int turned = b.node({{"mesh", b.triangleMesh()}, {"translation", {5, 0, 0}}});
  const int lamp = b.node(Json::parse(R"({"extensions": {"KHR_lights_punctual": {"light": 0}}})"));
  std::vector<float> turns = aboutZ(0);
  append(turns, aboutZ(2));
  animate(b, blended, "weights", "SCALAR", 1, {0, 4});
  animate(b, turned, "rotation", "VEC4", 4, turns);
  animate(b, eye, "translation", "VEC3", 3, {0, 0, 3, 1, 2, 3});
  animate(b, lamp, "translation", "VEC3", 3, {0, 1, 0, 0, 9, 0});
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.glb", b.glb());
  Notices notices;
  OpenFile open;
  Scene scene = open.load(file, at(0), notices);
  EXPECT_TRUE(open.moves());
  Light added;
  added.name = "added";
  scene.lights.push_back(added);
  for (const double seconds : {0.25, 1.0, 0.5}) {
    open.moveTo(seconds, scene);
    const Scene anew = b.load(at(seconds));
    EXPECT_EQ(scene.positions, anew.positions) << seconds;
    EXPECT_EQ(scene.triangles.size(), anew.triangles.size());
    EXPECT_EQ(scene.origin, anew.origin);
    ASSERT_EQ(scene.cameras.size(), 1U);
    EXPECT_EQ(scene.cameras[0].position, anew.cameras[0].position);
    ASSERT_EQ(scene.lights.size(), 2U);
    EXPECT_EQ(scene.lights[0].position, anew.lights[0].position);
    EXPECT_EQ(scene.lights[1].name, "added");
  }
}

TEST(GltfAnimation, QuantisedTurnsAreRead) {
  GltfBuilder b;
  const int node = b.node({{"mesh", b.triangleMesh()}});
  animate(b, node, "rotation", "VEC4", 4, {0, 0, 0, 1, 0, 0, 1, 0});
  const int output =
      b.accessor(b.view<std::int16_t>({0, 0, 0, 32767, 0, 0, 32767, 0}), "VEC4", test::kShort, 2, 0, true);
  b.json["animations"][0]["samplers"][0]["output"] = output;
  expectNear(corner(b.load(at(1)), 0, 1), {-1, 0, 0}, 1e-6F);
}

TEST(GltfAnimation, CamerasAndLightsMoveAlone) {
  GltfBuilder b;
  b.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
  b.json["extensionsUsed"] = {"KHR_lights_punctual"};
  b.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "point"}}});
  b.node({{"mesh", b.triangleMesh()}});
  const int eye = b.node({{"camera", 0}});
  const int lamp = b.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  animate(b, eye, "translation", "VEC3", 3, {0, 0, 4, 0, 0, 8});
  animate(b, lamp, "translation", "VEC3", 3, {0, 1, 0, 0, 2, 0}, "STEP");
  const Scene scene = b.load(at(0.75));
  expectNear(scene.cameras[0].position, {0, 0, 7}, 0);
  expectNear(scene.lights[0].position, {0, 1, 0}, 0);
  EXPECT_FALSE(scene.meshesMove);
  EXPECT_FALSE(mentions(b.notices.notes, "its last pose"));
  expectNear(b.load(at(9)).cameras[0].position, {0, 0, 8}, 0);
  EXPECT_TRUE(mentions(b.notices.notes, "ends at 1 s: its last pose is shown"));
}

TEST(GltfAnimation, SkinsFollowTheirJoints) {
  GltfBuilder b;
  const int j =
      b.accessor(b.view<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), "VEC4", test::kUbyte, 3);
  const int w = b.floats("VEC4", 4, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  const int mesh = b.triangleMesh({{"attributes", {{"JOINTS_0", j}, {"WEIGHTS_0", w}}}});
  const int joint = b.node(Json::object(), false);  // of no scene: joints may be
  const int above = b.node({{"children", Json::array({joint})}}, false);
  b.push("skins", {{"joints", Json::array({joint})}});
  b.node({{"mesh", mesh}, {"skin", 0}});
  animate(b, above, "translation", "VEC3", 3, {0, 0, 0, 6, 0, 0});
  const Scene scene = b.load(at(0.5));
  expectNear(corner(scene, 0, 1) + glm::vec3(scene.origin), {4, 0, 0}, 0);
  EXPECT_TRUE(scene.meshesMove);
}

TEST(GltfAnimation, MorphTargetsAreWeighted) {
  GltfBuilder b;
  const int lift = b.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1}), push = b.vec3({1, 0, 0, 1, 0, 0, 1, 0, 0});
  const int mesh = b.triangleMesh({{"targets", Json::array({{{"POSITION", lift}}, {{"POSITION", push}}})}});
  const int node = b.node({{"mesh", mesh}});
  animate(b, node, "weights", "SCALAR", 1, {0, 0, 1, 4});
  // Two keyframes of two weights each.
  b.json["animations"][0]["samplers"][0]["input"] = b.floats("SCALAR", 1, {0, 2});
  expectNear(corner(b.load(at(1)), 0, 0), {2, 0, 0.5F}, 0);
}

TEST(GltfAnimation, IsChosenByNameOrIndex) {
  GltfBuilder b;
  const int node = b.node({{"mesh", b.triangleMesh()}});
  animate(b, node, "translation", "VEC3", 3, {0, 0, 0, 1, 0, 0});
  b.json["animations"].push_back(b.json["animations"][0]);
  b.json["animations"][1]["name"] = "run";
  b.json["animations"][1]["channels"][0]["target"]["path"] = "scale";
  b.json["animations"][1]["samplers"][0]["output"] = b.vec3({1, 1, 1, 5, 6, 1});
  LoadOptions options = at(1);
  for (const char* second : {"run", "1"}) {
    options.animation = second;
    expectNear(corner(b.load(options), 0, 1), {5, 0, 0}, 0);
    expectNear(corner(b.load(options), 0, 2), {0, 6, 0}, 0);
  }
  options.animation = "fly";
  EXPECT_NE(b.error(options).find("has no animation \"fly\" (it has: 0 \"walk\", 1 \"run\")"),
            std::string::npos);
  options.animation.reset();
  const Scene scene = b.load(options);
  expectNear(corner(scene, 0, 0), {1, 0, 0}, 0);
  ASSERT_EQ(scene.animations.size(), 2U);
  EXPECT_EQ(scene.animations[1].name, "run");
  EXPECT_EQ(scene.animations[1].seconds, 1.0);
}

TEST(GltfAnimation, WithoutOneNothingMoves) {
  GltfBuilder b;
  b.node({{"mesh", b.triangleMesh()}});
  expectNear(corner(b.load(at(3)), 0, 0), {0, 0, 0}, 0);
  EXPECT_TRUE(mentions(b.notices.notes, "no animation"));
}

TEST(GltfAnimation, WhatCannotBePlayedIsSaid) {
  GltfBuilder b;
  const int node =
      b.node({{"mesh", b.triangleMesh()}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 0, 0, 1}}});
  animate(b, node, "translation", "VEC3", 3, {0, 0, 0, 1, 0, 0});
  animate(b, node, "pointer", "SCALAR", 1, {0, 1});
  animate(b, node, "colour", "SCALAR", 1, {0, 1});
  expectNear(corner(b.load(at(1)), 0, 0), {7, 0, 0}, 0);
  EXPECT_EQ(b.notices.warnings, (std::vector<std::string>{
                                    "animations[0] \"walk\" does not move /nodes/0/translation (its node has "
                                    "a matrix), a pointer to nothing (unknown), /nodes/0/colour (unknown)"}));
}

/// At rest nobody reads an animation, right or wrong.
TEST(GltfAnimation, WrongOnesAreRefusedWhenTheyArePlayed) {
  GltfBuilder good;
  const int node = good.node({{"mesh", good.triangleMesh()}});
  animate(good, node, "translation", "VEC3", 3, {0, 0, 0, 1, 0, 0});
  const auto refused = [&](const char* pointer, const Json& value, const char* words) {
    GltfBuilder b = good;
    b.json[Json::json_pointer(pointer)] = value;
    b.load();
    EXPECT_NE(b.error(at(0.5)).find(words), std::string::npos) << b.error(at(0.5));
  };
  refused("/animations/0/channels/0/sampler", 1, "has the sampler 1, but there are 1");
  refused("/animations/0/channels/0/target/node", 9, "there is 1 node");
  refused("/animations/0/samplers/0/input", 99, "animations[0].samplers[0].input is 99");
  refused("/animations/0/samplers/0/interpolation", "SMOOTH", "none of STEP");
  refused("/animations/0/samplers/0/output", good.vec3({0, 0, 0, 1, 1, 1, 2, 2, 2}),
          "do not go with its 2 times");
  refused("/animations/0/samplers/0/input", good.floats("SCALAR", 1, {1, 0}), "do not grow");
  refused("/animations/0/samplers/0/output", good.vec3({0, 0, 0, 0, 0, INFINITY}), "not finite");
  refused("/animations/0/channels", 3, "must be an array");
}

}  // namespace
}  // namespace whittle
