// Node transforms, scenes, instances, skins, cameras and lights.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gltf/builder.h"

namespace whittle {
namespace {

using test::corner;
using test::expectNear;
using test::faceNormal;
using test::GltfBuilder;
using test::Json;
using test::mentions;

constexpr float kRounding = 2e-7F;  // a few roundings of numbers near 1
const double kHalf = std::numbers::sqrt2 / 2;

TEST(GltfNodes, TransformsComposeDownTheTree) {
  GltfBuilder b;
  const int leaf = b.node({{"mesh", b.triangleMesh()}, {"scale", {2, 3, 4}}}, false);
  // A quarter turn about Z: x to y, y to -x.
  const int turned = b.node({{"rotation", {0, 0, kHalf, kHalf}}, {"children", {leaf}}}, false);
  b.node({{"translation", {10, 20, 30}}, {"children", {turned}}});
  const Scene scene = b.load();
  ASSERT_EQ(scene.triangles.size(), 1U);
  expectNear(corner(scene, 0, 0), {10, 20, 30}, 0);
  expectNear(corner(scene, 0, 1), {10, 22, 30}, 4e-6F);  // an ulp at 20 is 2e-6
  expectNear(corner(scene, 0, 2), {7, 20, 30}, 4e-6F);
}

TEST(GltfNodes, MatrixAndTrsAgree) {
  GltfBuilder b;
  const int mesh = b.triangleMesh();
  b.node(
      {{"mesh", mesh}, {"translation", {1, 2, 3}}, {"rotation", {kHalf, 0, 0, kHalf}}, {"scale", {2, 3, 4}}});
  // Column by column: x is scaled by 2; y by 3 and turned to z; z by 4 and turned to -y.
  b.node({{"mesh", mesh}, {"matrix", {2, 0, 0, 0, 0, 0, 3, 0, 0, -4, 0, 0, 1, 2, 3, 1}}});
  const Scene scene = b.load();
  ASSERT_EQ(scene.triangles.size(), 2U);
  for (int c = 0; c < 3; ++c) expectNear(corner(scene, 0, c), corner(scene, 1, c), 1e-6F);
  expectNear(corner(scene, 1, 2), {1, 2, 6}, 0);
}

TEST(GltfNodes, TransformsAreRoundedOnce) {
  GltfBuilder b;
  const int leaf = b.node({{"mesh", b.triangleMesh()}, {"translation", {-100000000.125, 0, 0}}}, false);
  b.node({{"translation", {100000000.25, 0, 0}}, {"children", {leaf}}});
  expectNear(corner(b.load(), 0, 0), {0.125F, 0, 0}, 0);  // in float both would have been 1e8
}

TEST(GltfNodes, MirrorsFlipTheWindingAndNotTheNormal) {
  GltfBuilder b;
  const int n = b.vec3({0, 0, 1, 0, 0, 1, 1, 0, 0});
  const int p = b.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", p}, {"NORMAL", n}}}})}, {"scale", {-1, 1, 1}}});
  const Scene scene = b.load();
  ASSERT_EQ(scene.triangles.size(), 1U);
  EXPECT_EQ(faceNormal(scene, 0).z, 1.0F) << "the front stays the front";
  expectNear(scene.normals[0], {0, 0, 1}, 0);
  expectNear(scene.normals[2], {-1, 0, 0}, 0);
}

TEST(GltfNodes, NormalsGoByTheInverseTranspose) {
  GltfBuilder b;
  const auto h = static_cast<float>(kHalf);
  const int n = b.vec3({h, h, 0, h, h, 0, h, h, 0});
  const int p = b.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", p}, {"NORMAL", n}}}})}, {"scale", {2, 1, 1}}});
  const Scene scene = b.load();
  // (1/2, 1, 0) normalised.
  expectNear(scene.normals[0], {1 / std::sqrt(5.0F), 2 / std::sqrt(5.0F), 0}, kRounding);
}

TEST(GltfNodes, ExtremeAndSingularScales) {
  GltfBuilder b;
  const int n = b.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
  const int p = b.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int mesh = b.mesh({{"attributes", {{"POSITION", p}, {"NORMAL", n}}}});
  b.node({{"mesh", mesh}, {"scale", {1, 1, 1e-6}}});
  b.node({{"mesh", mesh}, {"scale", {1e-130, 1e-130, 1e-130}}});  // the determinant would underflow
  b.node({{"mesh", mesh}, {"scale", {1, 1, 0}}});                 // flat already: keeps its area
  b.node({{"mesh", mesh}, {"scale", {0, 1, 1}}, {"name", "thin"}});
  b.node({{"mesh", mesh}, {"scale", {0, 0, 0}}});
  const Scene scene = b.load();
  EXPECT_EQ(scene.triangles.size(), 2U);
  EXPECT_EQ(scene.droppedTriangles, 3U);
  EXPECT_TRUE(mentions(b.notices.warnings, "2 triangles dropped: a scale of 0"));
  EXPECT_TRUE(mentions(b.notices.warnings, "thin"));
  ASSERT_EQ(scene.normals.size(), 15U);
  for (const glm::vec3& v : scene.normals)
    EXPECT_TRUE(v == glm::vec3(0) || v == glm::vec3(0, 0, 1) || v.x != 0);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(scene.normals[i], glm::vec3(0, 0, 1)) << i;
}

TEST(GltfNodes, DeepHierarchiesAreWalkedWithoutRecursion) {
  GltfBuilder b;
  constexpr int kDepth = 200000;
  Json nodes = Json::array();
  for (int i = 0; i + 1 < kDepth; ++i) nodes.push_back({{"children", {i + 1}}});
  nodes.push_back({{"mesh", b.triangleMesh()}, {"translation", {1, 0, 0}}});
  b.json["nodes"] = std::move(nodes);
  b.json["scenes"][0]["nodes"] = {0};
  expectNear(corner(b.load(), 0, 0), {1, 0, 0}, 0);
}

TEST(GltfNodes, CyclesAndSharedChildrenAreRefused) {
  GltfBuilder cycle;
  cycle.node({{"children", {1}}});
  cycle.node({{"children", {0}}}, false);
  EXPECT_NE(cycle.error().find("node 0 is its own ancestor"), std::string::npos) << cycle.error();

  GltfBuilder self;
  self.node({{"children", {0}}});
  EXPECT_NE(self.error().find("node 0 is its own ancestor"), std::string::npos) << self.error();

  GltfBuilder below;  // node 0 hangs on the cycle of 1 and 2
  below.node({{"name", "leaf"}});
  below.node({{"name", "ring"}, {"children", {0, 2}}}, false);
  below.node({{"children", {1}}}, false);
  EXPECT_NE(below.error().find("node 1 \"ring\" is its own ancestor"), std::string::npos) << below.error();

  GltfBuilder shared;
  shared.node({{"children", {2}}});
  shared.node({{"children", {2}}});
  shared.node(Json::object(), false);
  EXPECT_NE(shared.error().find("node 2 has two parents"), std::string::npos);
}

TEST(GltfNodes, ScenesByDefaultNameAndIndex) {
  GltfBuilder b;
  const int mesh = b.triangleMesh();
  const int first = b.node({{"mesh", mesh}}, false);
  const int second = b.node({{"mesh", mesh}, {"translation", {5, 0, 0}}}, false);
  b.json["scenes"] = {{{"name", "one"}, {"nodes", {first}}}, {{"name", "two"}, {"nodes", {second}}}};
  b.json["scene"] = 1;
  EXPECT_EQ(corner(b.load(), 0, 0).x, 5.0F);
  EXPECT_EQ(corner(b.load({.sceneName = "one"}), 0, 0).x, 0.0F);
  EXPECT_EQ(corner(b.load({.sceneName = "0"}), 0, 0).x, 0.0F);
  const std::string text = b.error({.sceneName = "three"});
  EXPECT_NE(text.find("no scene \"three\""), std::string::npos) << text;
  EXPECT_NE(text.find("\"two\""), std::string::npos) << text;
  b.json.erase("scene");
  EXPECT_EQ(corner(b.load(), 0, 0).x, 0.0F) << "the first without a default";
  b.json.erase("scenes");
  EXPECT_EQ(b.load().triangles.size(), 2U) << "all nodes without a scene";
}

TEST(GltfNodes, Instancing) {
  GltfBuilder b;
  b.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const int t = b.vec3({1, 0, 0, 2, 0, 0});
  // Normalised bytes: half a turn about Z, then none.
  const int r =
      b.accessor(b.view<std::int8_t>({0, 0, 127, 0, 0, 0, 0, 127}), "VEC4", test::kByte, 2, 0, true);
  const int s = b.vec3({1, 1, 1, 3, 3, 3});
  b.node({{"mesh", b.triangleMesh()},
          {"translation", {0, 0, 10}},
          {"extensions",
           {{"EXT_mesh_gpu_instancing",
             {{"attributes", {{"TRANSLATION", t}, {"ROTATION", r}, {"SCALE", s}}}}}}}});
  const Scene scene = b.load();
  ASSERT_EQ(scene.triangles.size(), 2U);
  expectNear(corner(scene, 0, 0), {1, 0, 10}, 0);
  expectNear(corner(scene, 0, 1), {0, 0, 10}, kRounding);
  expectNear(corner(scene, 1, 1), {5, 0, 10}, 0);
  expectNear(corner(scene, 1, 2), {2, 3, 10}, 0);
  b.json["accessors"][s]["count"] = 1;
  EXPECT_NE(b.error().find("instances have 2 and 1 elements"), std::string::npos);
}

/// A triangle whose third corner follows joint 1 by half; the mesh's own node is moved, which
/// must not matter.
GltfBuilder skinned() {
  GltfBuilder b;
  const int j =
      b.accessor(b.view<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0}), "VEC4", test::kUbyte, 3);
  const int w = b.floats("VEC4", 4, {1, 0, 0, 0, 1, 0, 0, 0, 0.5F, 0.5F, 0, 0});
  const int mesh = b.triangleMesh({{"attributes", {{"JOINTS_0", j}, {"WEIGHTS_0", w}}}});
  const int joint1 = b.node({{"translation", {0, 1, 0}}, {"rotation", {0, 0, kHalf, kHalf}}}, false);
  const int joint0 = b.node({{"translation", {0, 0, 5}}, {"children", {joint1}}});
  // Bound at the origin and at (0, 1, 0), both unturned; column-major.
  const int bind = b.floats("MAT4", 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,  //
                                         1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1});
  b.push("skins", {{"joints", {joint0, joint1}}, {"inverseBindMatrices", bind}});
  b.node({{"mesh", mesh}, {"skin", 0}, {"translation", {100, 100, 100}}});
  return b;
}

TEST(GltfNodes, SkinInItsRestPose) {
  GltfBuilder b = skinned();
  const Scene scene = b.load();
  ASSERT_EQ(scene.triangles.size(), 1U);
  expectNear(corner(scene, 0, 0), {0, 0, 5}, 0);
  expectNear(corner(scene, 0, 1), {1, 0, 5}, 0);
  // Joint 0 takes (0,1,0) to (0,1,5); so does joint 1, whose turn is about that very point.
  expectNear(corner(scene, 0, 2), {0, 1, 5}, kRounding);
}

TEST(GltfNodes, SkinBendsAwayFromTheBindPose) {
  GltfBuilder b = skinned();
  b.json["nodes"][0]["translation"] = {0, 3, 0};         // joint 1 moves up by two
  expectNear(corner(b.load(), 0, 2), {0, 2, 5}, 1e-6F);  // half way between 1 and 3
}

TEST(GltfNodes, SkinsThatDoNotFitAreRefused) {
  GltfBuilder fewer = skinned();
  fewer.json["skins"][0]["joints"].erase(1);
  EXPECT_NE(fewer.error().find("follows joint 1 of 1"), std::string::npos);
  GltfBuilder matrices = skinned();
  const std::size_t bind = matrices.json["skins"][0]["inverseBindMatrices"];
  matrices.json["accessors"][bind]["count"] = 1;
  EXPECT_NE(matrices.error().find("inverseBindMatrices"), std::string::npos);
}

TEST(GltfNodes, PerspectiveAndOrthographicCameras) {
  GltfBuilder b;
  b.push("cameras", {{"type", "orthographic"},
                     {"name", "flat"},
                     {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 10}}}});
  b.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
  // The second first in the tree; a quarter turn about Y looks along -X. The scale must not matter.
  b.node({{"camera", 1}, {"name", "eye"}, {"rotation", {0, kHalf, 0, kHalf}}, {"scale", {3, 4, 5}}});
  b.node({{"camera", 0}, {"translation", {1, 2, 3}}});
  const Scene scene = b.load();
  ASSERT_EQ(scene.cameras.size(), 2U);
  EXPECT_EQ(scene.cameras[0].name, "flat");
  EXPECT_TRUE(scene.cameras[0].orthographic);
  EXPECT_EQ(scene.cameras[0].ymag, 2.0F);
  expectNear(scene.cameras[0].position, {1, 2, 3}, 0);
  const Camera& eye = scene.cameras[1];
  EXPECT_EQ(eye.name, "eye");
  EXPECT_EQ(eye.yfov, 0.5F);
  expectNear(eye.forward, {-1, 0, 0}, kRounding);
  expectNear(eye.right, {0, 0, -1}, kRounding);
  expectNear(eye.up, {0, 1, 0}, kRounding);
}

TEST(GltfNodes, UnusableCamerasAreLeftOut) {
  GltfBuilder b;
  b.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 3.2}, {"znear", 0.1}}}});
  b.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  b.node({{"camera", 0}});
  b.node({{"camera", 1}, {"scale", {1, 1, 0}}});
  const Scene scene = b.load();
  EXPECT_EQ(b.notices.warnings.size(), 2U);
  ASSERT_EQ(scene.cameras.size(), 1U) << "the default one";
  EXPECT_TRUE(mentions(b.notices.notes, "no camera"));
}

TEST(GltfLights, EveryKind) {
  GltfBuilder b;
  b.json["extensionsUsed"] = {"KHR_lights_punctual"};
  b.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"color", {1, 0.5, 0}}, {"intensity", 8}, {"range", 20}},
      {{"type", "directional"}, {"extras", {{"castsShadows", false}}}},
      {{"type", "spot"}, {"intensity", 3}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
      {{"type", "spot"}, {"spot", Json::object()}}};
  const auto light = [](int i) { return Json{{"KHR_lights_punctual", {{"light", i}}}}; };
  b.node({{"extensions", light(0)}, {"translation", {1, 2, 3}}, {"scale", {7, 7, 7}}});
  // Down: a quarter turn about X takes -Z to +Y; the other way round to -Y.
  b.node({{"extensions", light(1)}, {"rotation", {-kHalf, 0, 0, kHalf}}, {"scale", {2, 2, 9}}});
  b.node({{"extensions", light(2)}, {"extras", {{"castsShadows", false}}}});
  b.node({{"extensions", light(3)}});
  const Scene scene = b.load();
  ASSERT_EQ(scene.lights.size(), 4U);
  EXPECT_EQ(scene.lights[0].kind, LightKind::Point);
  expectNear(scene.lights[0].intensity, {8, 4, 0}, 0);
  expectNear(scene.lights[0].position, {1, 2, 3}, 0);
  EXPECT_EQ(scene.lights[0].range, 20.0F);
  EXPECT_TRUE(scene.lights[0].castsShadows);
  EXPECT_EQ(scene.lights[1].kind, LightKind::Directional);
  expectNear(scene.lights[1].direction, {0, -1, 0}, kRounding);
  EXPECT_FALSE(scene.lights[1].castsShadows) << "said at the light";
  EXPECT_TRUE(std::isinf(scene.lights[1].range));
  EXPECT_EQ(scene.lights[2].kind, LightKind::Spot);
  EXPECT_EQ(scene.lights[2].innerConeAngle, 0.25F);
  EXPECT_EQ(scene.lights[2].outerConeAngle, 0.5F);
  EXPECT_FALSE(scene.lights[2].castsShadows) << "said at the node";
  EXPECT_EQ(scene.lights[3].innerConeAngle, 0.0F);
  EXPECT_FLOAT_EQ(scene.lights[3].outerConeAngle, 0.785398163F);
  EXPECT_TRUE(b.notices.warnings.empty());
}

TEST(GltfLights, ImpossibleOnesWarn) {
  GltfBuilder b;
  b.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"range", -1}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 1.0}, {"outerConeAngle", 0.5}}}},
      {{"type", "area"}},
      {{"type", "point"}, {"intensity", -1}},
      {{"type", "directional"}},
      {{"type", "point"}, {"intensity", 1e39}}};
  for (int i = 0; i < 6; ++i) {
    b.node({{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}, {"scale", {1, 1, i == 4 ? 0 : 1}}});
  }
  const Scene scene = b.load();
  ASSERT_EQ(scene.lights.size(), 2U);
  EXPECT_TRUE(std::isinf(scene.lights[0].range));
  EXPECT_EQ(scene.lights[1].innerConeAngle, 0.5F);
  EXPECT_EQ(b.notices.warnings.size(), 6U);
  const auto warned = [&](const std::string& text) {
    return std::count(b.notices.warnings.begin(), b.notices.warnings.end(), text);
  };
  EXPECT_EQ(warned("light 3: its intensity is negative; the light is left out"), 1);
  EXPECT_EQ(
      warned("light 5: its intensity is beyond 3.4e38, the most that a float holds; the light is left out"),
      1);
}

TEST(GltfLights, ReferencesAreChecked) {
  GltfBuilder b;
  b.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array();
  b.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  EXPECT_NE(b.error().find("but there are no lights"), std::string::npos);
}

/// A room at UTM coordinates comes out as at the origin, to the bit; what is shown has
/// the file's coordinates.
TEST(GltfNodes, APlaceFarAwayIsTakenOff) {
  const auto loaded = [](const std::vector<double>& place) {
    GltfBuilder b;
    const int positions = b.vec3({0.1F, 0.2F, 0.3F, 1, 0, 0, 0, 1, 0.7F});
    b.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    b.node(
        {{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}})}, {"translation", {0.3, -0.1, 0.7}}});
    b.node({{"camera", 0}, {"translation", {0.4, 0.6, 5}}});
    b.json["nodes"].push_back({{"children", {0, 1}}, {"translation", place}});
    b.json["scenes"][0]["nodes"] = {2};
    return b.load();
  };
  const Scene home = loaded({0, 0, 0});
  EXPECT_EQ(home.origin, glm::dvec3(0));
  for (const std::vector<double>& place :
       {std::vector<double>{500123.37, 12.5, -4649777.02}, std::vector<double>{4.6e6, 1.2e6, 4.1e6}}) {
    const Scene far = loaded(place);
    EXPECT_EQ(far.origin, glm::dvec3(place[0], place[1], place[2]));
    EXPECT_EQ(far.positions, home.positions);
    EXPECT_EQ(far.cameras.at(0).position, home.cameras.at(0).position);
  }
  EXPECT_EQ(loaded({20, 0, 0}).origin, glm::dvec3(0)) << "not far: rounding does not show";
}

}  // namespace
}  // namespace whittle
