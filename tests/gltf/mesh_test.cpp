// Primitives: modes and windings, index types, formats of attributes, sparse accessors, strides, tangents.
#include <gtest/gtest.h>

#include "gltf/builder.h"

namespace whittle {
namespace {

using test::corner;
using test::expectNear;
using test::faceNormal;
using test::GltfBuilder;
using test::Json;
using test::mentions;

/// A zigzag in the XY plane: 0 (0,0), 1 (1,0), 2 (0,1), 3 (1,1), 4 (0,2).
std::vector<float> zigzag() { return {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}; }

Scene zigzagScene(int mode, const std::vector<std::uint16_t>& indices) {
  GltfBuilder b;
  Json primitive{{"mode", mode}, {"attributes", {{"POSITION", b.vec3(zigzag())}}}};
  if (!indices.empty()) primitive["indices"] = b.indices(indices);
  b.node({{"mesh", b.mesh(primitive)}});
  return b.load();
}

TEST(GltfMesh, StripAlternatesItsWinding) {
  const Scene scene = zigzagScene(5, {});
  ASSERT_EQ(scene.triangles.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FLOAT_EQ(faceNormal(scene, i).z, 1.0F) << i;
  // Specification: p_i = {v_i, v_(i + 1 + i % 2), v_(i + 2 - i % 2)}.
  expectNear(corner(scene, 1, 0), {1, 0, 0}, 0);
  expectNear(corner(scene, 1, 1), {1, 1, 0}, 0);
  expectNear(corner(scene, 1, 2), {0, 1, 0}, 0);
}

TEST(GltfMesh, FanKeepsItsWinding) {
  const Scene scene = zigzagScene(6, {0, 1, 3, 2});
  ASSERT_EQ(scene.triangles.size(), 2U);
  EXPECT_FLOAT_EQ(faceNormal(scene, 0).z, 1.0F);
  EXPECT_FLOAT_EQ(faceNormal(scene, 1).z, 1.0F);
  // p_i = {v_(i + 1), v_(i + 2), v_0}.
  expectNear(corner(scene, 0, 0), {1, 0, 0}, 0);
  expectNear(corner(scene, 0, 2), {0, 0, 0}, 0);
}

TEST(GltfMesh, DegenerateStripTrianglesAreCountedAndNoted) {
  GltfBuilder b;
  b.node({{"mesh", b.mesh({{"mode", 5},
                           {"indices", b.indices<std::uint8_t>({0, 1, 2, 2, 3, 4})},
                           {"attributes", {{"POSITION", b.vec3(zigzag())}}}})}});
  const Scene scene = b.load();
  EXPECT_EQ(scene.triangles.size(), 2U);  // (0,1,2) and (2,3,4); the two in between repeat vertex 2
  EXPECT_EQ(scene.droppedTriangles, 2U);
  EXPECT_TRUE(mentions(b.notices.notes, "2 triangles of no area"));
  EXPECT_TRUE(b.notices.warnings.empty());
}

template <class T>
void expectIndexed() {
  GltfBuilder b;
  b.node({{"mesh", b.mesh({{"indices", b.indices<T>({4, 2, 3})},
                           {"attributes", {{"POSITION", b.vec3(zigzag())}}}})}});
  const Scene scene = b.load();
  ASSERT_EQ(scene.triangles.size(), 1U);
  expectNear(corner(scene, 0, 0), {0, 2, 0}, 0);
  expectNear(corner(scene, 0, 1), {0, 1, 0}, 0);
  expectNear(corner(scene, 0, 2), {1, 1, 0}, 0);
  EXPECT_EQ(scene.positions.size(), 3U) << "unused vertices are left behind";
}

TEST(GltfMesh, IndicesOfEveryWidth) {
  expectIndexed<std::uint8_t>();
  expectIndexed<std::uint16_t>();
  expectIndexed<std::uint32_t>();
}

TEST(GltfMesh, IndicesMayBeSparseOverZeros) {
  GltfBuilder b;
  const int a = b.accessor(-1, "SCALAR", test::kUbyte, 3);
  b.json["accessors"][a]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", b.view<std::uint8_t>({1, 2})}, {"componentType", test::kUbyte}}},
      {"values", {{"bufferView", b.view<std::uint8_t>({1, 2})}}}};
  b.node({{"mesh", b.mesh({{"indices", a}, {"attributes", {{"POSITION", b.vec3(zigzag())}}}})}});
  const Scene scene = b.load();
  ASSERT_EQ(scene.triangles.size(), 1U);
  expectNear(corner(scene, 0, 1), {1, 0, 0}, 0);
}

TEST(GltfMesh, PointsAndLinesAreNoted) {
  GltfBuilder b;
  const int positions = b.vec3(zigzag());
  Json primitives = Json::array();
  for (int mode = 0; mode < 4; ++mode)
    primitives.push_back({{"mode", mode}, {"attributes", {{"POSITION", positions}}}});
  b.node({{"mesh", b.push("meshes", {{"primitives", primitives}})}});
  EXPECT_TRUE(b.load().triangles.empty());
  EXPECT_TRUE(mentions(b.notices.notes, "4 mesh primitives not drawn"));
}

TEST(GltfMesh, SparsePositionsReplaceElements) {
  GltfBuilder b;
  const int a = b.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
  b.json["accessors"][a]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", b.view<std::uint16_t>({2})}, {"componentType", test::kUshort}}},
      {"values", {{"bufferView", b.view<float>({0, 7, 3})}}}};
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", a}}}})}});
  const Scene scene = b.load();
  ASSERT_EQ(scene.triangles.size(), 1U);
  expectNear(corner(scene, 0, 1), {1, 0, 0}, 0);
  expectNear(corner(scene, 0, 2), {0, 7, 3}, 0);
}

TEST(GltfMesh, InterleavedAttributes) {
  GltfBuilder b;
  // Position, normal; 24 bytes apart.
  const int view = b.view<float>({0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0}, 24);
  const int p = b.accessor(view, "VEC3", test::kFloat, 3);
  const int n = b.accessor(view, "VEC3", test::kFloat, 3, 12);
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", p}, {"NORMAL", n}}}})}});
  const Scene scene = b.load();
  ASSERT_EQ(scene.positions.size(), 3U);
  expectNear(scene.positions[2], {0, 1, 0}, 0);
  expectNear(scene.normals[0], {0, 0, 1}, 0);
  expectNear(scene.normals[1], {0, 1, 0}, 0);
  expectNear(scene.normals[2], {1, 0, 0}, 0);
}

TEST(GltfMesh, QuantisedPositionsAndNormals) {
  GltfBuilder b;
  b.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  b.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  // Positions: unsigned shorts as they are, padded to 8 bytes; normals: normalised bytes padded to 4.
  const int p = b.accessor(b.view<std::uint16_t>({0, 0, 0, 0, 1000, 0, 0, 0, 0, 500, 65535, 0}, 8), "VEC3",
                           test::kUshort, 3);
  const int n = b.accessor(b.view<std::int8_t>({127, 0, 0, 0, -128, 0, 0, 0, 0, 0, -127, 0}, 4), "VEC3",
                           test::kByte, 3, 0, true);
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", p}, {"NORMAL", n}}}})}, {"scale", {0.5, 0.5, 0.5}}});
  const Scene scene = b.load();
  ASSERT_EQ(scene.triangles.size(), 1U);
  expectNear(scene.positions[1], {500, 0, 0}, 0);
  expectNear(scene.positions[2], {0, 250, 32767.5F}, 0);
  expectNear(scene.normals[0], {1, 0, 0}, 0);
  expectNear(scene.normals[1], {-1, 0, 0}, 0);  // -128 means -1 too
  expectNear(scene.normals[2], {0, 0, -1}, 0);
}

TEST(GltfMesh, NormalisedColoursOfEveryFormat) {
  GltfBuilder b;
  const int p = b.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const auto meshWith = [&](int colours) {
    b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", p}, {"COLOR_0", colours}}}})}});
  };
  meshWith(b.accessor(b.view<std::uint8_t>({255, 0, 51, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 4), "VEC3", test::kUbyte,
                      3, 0, true));
  meshWith(b.accessor(b.view<std::uint16_t>({65535, 0, 13107, 32768, 0, 0, 0, 0, 0, 0, 0, 0}), "VEC4",
                      test::kUshort, 3, 0, true));
  meshWith(b.floats("VEC3", 3, {0.25F, 0.5F, 0.75F, 0, 0, 0, 0, 0, 0}));
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", p}}}})}});
  const Scene scene = b.load();
  ASSERT_EQ(scene.colors.size(), 12U);
  const float ulp = 1e-7F;  // one rounding of the quotient
  EXPECT_EQ(scene.colors[0].r, 1.0F);
  EXPECT_NEAR(scene.colors[0].b, 0.2F, ulp);
  EXPECT_EQ(scene.colors[0].a, 1.0F) << "three components: opaque";
  EXPECT_NEAR(scene.colors[3].b, 0.2F, ulp);
  EXPECT_NEAR(scene.colors[3].a, 32768.0F / 65535.0F, ulp);
  EXPECT_EQ(scene.colors[6], glm::vec4(0.25F, 0.5F, 0.75F, 1.0F));
  EXPECT_EQ(scene.colors[9], glm::vec4(1.0F)) << "a mesh without colours";
}

/// The colours of one triangle; `deltas` of morph target 0 count in full.
std::vector<glm::vec4> colours(const char* type, const std::vector<float>& base,
                               const char* deltaType = nullptr, const std::vector<float>& deltas = {}) {
  GltfBuilder b;
  Json primitive{{"attributes",
                  {{"POSITION", b.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0})},
                   {"COLOR_0", b.floats(type, static_cast<int>(base.size() / 3), base)}}}};
  if (deltaType) {
    const int target = b.floats(deltaType, static_cast<int>(deltas.size() / 3), deltas);
    primitive["targets"] = Json::array({{{"COLOR_0", target}}});
  }
  b.node({{"mesh", b.push("meshes", {{"weights", {1}}, {"primitives", Json::array({primitive})}})}});
  Scene scene = b.load();
  EXPECT_TRUE(b.notices.warnings.empty());
  return scene.colors;
}

TEST(GltfMesh, ColoursAreClamped) {
  const auto seen = colours("VEC4", {2, 0.5F, -0.5F, 1.5F, 0, 0, 0, -1, 1, 1, 1, 1});
  EXPECT_EQ(seen.at(0), glm::vec4(1, 0.5F, 0, 1));
  EXPECT_EQ(seen.at(1), glm::vec4(0, 0, 0, 0));
  EXPECT_EQ(colours("VEC3", {2, 0.5F, -0.5F, 0, 0, 0, 0, 0, 0}).at(0), glm::vec4(1, 0.5F, 0, 1));
}

TEST(GltfMesh, ColoursAreClampedAfterMorphing) {
  const auto seen = colours("VEC4", {1.5F, 0.5F, 0.5F, 1, 0, 0, 0, 0, 0, 0, 0, 0},  //
                            "VEC4", {-1, 1, -0.75F, -0.5F, 0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(seen.at(0), glm::vec4(0.5F, 1, 0, 0.5F));
}

TEST(GltfMesh, ColoursAndTheirDeltasMayDifferInComponents) {
  const auto three = colours("VEC3", {0.25F, 0.25F, 0.25F, 0, 0, 0, 0, 0, 0},  //
                             "VEC4", {0.5F, 0, 0.25F, -0.25F, 0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(three.at(0), glm::vec4(0.75F, 0.25F, 0.5F, 0.75F));
  EXPECT_EQ(three.at(1), glm::vec4(0, 0, 0, 1));
  const auto four = colours("VEC4", {0.25F, 0.25F, 0.25F, 0.5F, 0, 0, 0, 0, 0, 0, 0, 0},  //
                            "VEC3", {0.5F, 0, 0.25F, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(four.at(0), glm::vec4(0.75F, 0.25F, 0.5F, 0.5F));
}

TEST(GltfMesh, ArraysThatNothingNeedsStayEmpty) {
  GltfBuilder b;
  const int uv = b.vec2({0, 0, 1, 0, 0, 1});
  b.node({{"mesh", b.mesh({{"attributes",
                            {{"POSITION", b.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0})}, {"TEXCOORD_0", uv}}}})}});
  const Scene scene = b.load();
  EXPECT_TRUE(scene.uv0.empty() && scene.uv1.empty() && scene.tangents.empty() && scene.colors.empty() &&
              scene.normals.empty());
}

TEST(GltfMesh, MissingNormalsAreZeroBesideOthers) {
  GltfBuilder b;
  const int p = b.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", p}}}})}});
  b.node({{"mesh",
           b.mesh({{"attributes", {{"POSITION", p}, {"NORMAL", b.vec3({0, 0, 5, 0, 0, 0, 0, 0, 1})}}}})}});
  const Scene scene = b.load();
  ASSERT_EQ(scene.normals.size(), 6U);
  EXPECT_EQ(scene.normals[0], glm::vec3(0));
  expectNear(scene.normals[3], {0, 0, 1}, 0);  // normalised
  EXPECT_EQ(scene.normals[4], glm::vec3(0)) << "zero length means none";
}

TEST(GltfMesh, MorphTargetsWithDefaultWeights) {
  GltfBuilder b;
  const int base = b.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int up = b.vec3({0, 0, 2, 0, 0, 2, 0, 0, 2});
  const int out = b.vec3({0, 0, 0, 4, 0, 0, 0, 0, 0});
  const int mesh = b.push(
      "meshes",
      {{"weights", {0.5, 0.0}},
       {"primitives",
        {{{"attributes", {{"POSITION", base}}}, {"targets", {{{"POSITION", up}}, {{"POSITION", out}}}}}}}});
  b.node({{"mesh", mesh}});
  b.node({{"mesh", mesh}, {"weights", {0.0, 0.25}}});
  const Scene scene = b.load();
  ASSERT_EQ(scene.triangles.size(), 2U);
  expectNear(corner(scene, 0, 1), {1, 0, 1}, 0);  // the mesh's weights
  expectNear(corner(scene, 1, 1), {2, 0, 0}, 0);  // the node's weights
}

TEST(GltfMesh, UnusableTrianglesAreDroppedWithOneWarning) {
  GltfBuilder b;
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", b.vec3({nan, 0,   0,     1, 0, 0, 0, 1, 0,  //
                                                                0,   inf, 0,     1, 0, 0, 0, 1, 0,  //
                                                                0,   0,   2e18F, 1, 0, 0, 0, 1, 0,  //
                                                                0,   0,   0,     1, 0, 0, 0, 1, 0})}}}})}});
  const Scene scene = b.load();
  EXPECT_EQ(scene.triangles.size(), 1U);
  EXPECT_EQ(scene.droppedTriangles, 3U);
  ASSERT_EQ(b.notices.warnings.size(), 1U);
  EXPECT_TRUE(mentions(b.notices.warnings, "3 triangles dropped"));
  for (const glm::vec3& p : scene.positions) EXPECT_LT(glm::length(p), 2.0F);
}

TEST(GltfMesh, BoundsAreChecked) {
  const auto broken = [](auto&& breakIt) {
    GltfBuilder b;
    b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", b.vec3(zigzag())}}},
                             {"indices", b.indices<std::uint16_t>({0, 1, 2})}})}});
    breakIt(b.json);
    return b.error();
  };
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_NE(text.find("scene.glb: "), std::string::npos) << text;
  };
  has(broken([](Json& j) { j["accessors"][0]["count"] = 6; }), "accessors[0] reaches beyond bufferViews[0]");
  has(broken([](Json& j) { j["accessors"][0]["count"] = 9007199254740992; }), "accessors[0] reaches beyond");
  has(broken([](Json& j) { j["accessors"][0]["byteOffset"] = 9007199254740992; }),
      "accessors[0] reaches beyond");
  has(broken([](Json& j) { j["accessors"][0]["byteOffset"] = -4; }),
      "accessors[0].byteOffset must not be negative");
  has(broken([](Json& j) { j["accessors"][0]["count"] = 1e30; }), "accessors[0].count is too large");
  has(broken([](Json& j) {
        j["accessors"][0].erase("bufferView");
        j["accessors"][0]["count"] = 1ULL << 40;
      }),
      "and no data");
  has(broken([](Json& j) { j["bufferViews"][0]["byteLength"] = 4096; }),
      "bufferViews[0] reaches beyond buffer 0");
  has(broken([](Json& j) { j["bufferViews"][0]["byteOffset"] = 9007199254740992; }),
      "reaches beyond buffer 0");
  has(broken([](Json& j) { j["accessors"][0]["componentType"] = 5130; }), "unknown value 5130");
  has(broken([](Json& j) { j["accessors"][0]["componentType"] = test::kUint; }), "POSITION");
  has(broken([](Json& j) { j["accessors"][0]["type"] = "VEC2"; }), "POSITION");
  has(broken([](Json& j) { j["accessors"][1]["componentType"] = test::kShort; }), "not unsigned integers");
  has(broken([](Json& j) { j["accessors"][0]["count"] = 2; }), "index 2 is beyond its 2 vertices");
  has(broken([](Json& j) { j["meshes"][0]["primitives"][0]["indices"] = 7; }),
      "is 7, but there are 2 accessors");
  has(broken([](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = -1; }),
      "must not be negative");
  has(broken([](Json& j) { j["meshes"][0]["primitives"][0]["material"] = 0; }), "but there are no materials");
  has(broken([](Json& j) { j["bufferViews"][0]["buffer"] = 1; }), "but there is 1 buffer");
  has(broken([](Json& j) {
        j["accessors"][0]["sparse"] = {{"count", 3000000000U},
                                       {"indices", {{"bufferView", 1}, {"componentType", test::kUshort}}},
                                       {"values", {{"bufferView", 0}}}};
      }),
      "accessors[0].sparse.count is too large");
  has(broken([](Json& j) {
        j["accessors"][0]["sparse"] = {
            {"count", 1},
            {"indices", {{"bufferView", 0}, {"componentType", test::kUint}, {"byteOffset", 12}}},
            {"values", {{"bufferView", 0}}}};
      }),
      "sparse replaces element");
}

TEST(GltfMesh, AttributesOfAnotherLengthAreRefused) {
  GltfBuilder b;
  b.node(
      {{"mesh", b.mesh({{"attributes", {{"POSITION", b.vec3(zigzag())}, {"NORMAL", b.vec3({0, 0, 1})}}}})}});
  EXPECT_NE(b.error().find("NORMAL has 1 elements for 5 vertices"), std::string::npos);
}

}  // namespace
}  // namespace whittle
