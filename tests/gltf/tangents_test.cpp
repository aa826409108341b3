// Tangents along a normal map: the file's, and ones of our own where those do not count.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gltf/builder.h"

namespace whittle {
namespace {

using test::expectNear;
using test::GltfBuilder;
using test::Json;

/// A square about the origin that faces +Z, the image upright on it, with a normal texture.
struct Square {
  Json slot = {{"index", 0}};  ///< the normal texture's description
  std::vector<float> positions{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
  std::vector<float> uv{0, 1, 1, 1, 1, 0, 0, 0};
  std::vector<float> uv1;
  std::vector<float> normals{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
  std::vector<float> tangents{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1};
  std::vector<std::uint8_t> indices{0, 1, 2, 0, 2, 3};
};

Scene load(const Square& square) {
  GltfBuilder b;
  const std::string png = test::pngBytes();
  b.push("images",
         {{"bufferView", b.view(std::vector<char>(png.begin(), png.end()))}, {"mimeType", "image/png"}});
  b.push("textures", {{"source", 0}});
  b.material({{"normalTexture", square.slot}});
  Json attributes{{"POSITION", b.vec3(square.positions)}, {"TEXCOORD_0", b.vec2(square.uv)}};
  if (!square.uv1.empty()) attributes["TEXCOORD_1"] = b.vec2(square.uv1);
  if (!square.normals.empty()) attributes["NORMAL"] = b.vec3(square.normals);
  if (!square.tangents.empty()) attributes["TANGENT"] = b.floats("VEC4", 4, square.tangents);
  b.node({{"mesh",
           b.mesh({{"attributes", attributes}, {"indices", b.indices(square.indices)}, {"material", 0}})}});
  const Scene scene = b.load();
  EXPECT_TRUE(b.notices.warnings.empty());
  return scene;
}

Json transformed(const Json& transform) {
  return {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
}

void expectTangents(const Scene& scene, const glm::vec4& expected) {
  ASSERT_FALSE(scene.tangents.empty());
  for (const glm::vec4& t : scene.tangents) {
    expectNear(glm::vec3(t), glm::vec3(expected), 1e-6F);
    EXPECT_EQ(t.w, expected.w);
  }
}

TEST(GltfTangents, AreGeneratedForAnUprightImage) {
  Square square;
  square.slot["scale"] = 0.5;
  square.tangents.clear();
  const Scene scene = load(square);
  EXPECT_EQ(scene.materials.at(0).normalScale, 0.5F);
  // u grows along +X, v along -Y: the image stands upright, so that n × T = +Y is its up.
  expectTangents(scene, {1, 0, 0, 1});
}

TEST(GltfTangents, OfTheMeshAreKeptAndMirrored) {
  GltfBuilder b;
  const std::string png = test::pngBytes();
  b.push("images",
         {{"bufferView", b.view(std::vector<char>(png.begin(), png.end()))}, {"mimeType", "image/png"}});
  b.push("textures", {{"source", 0}});
  b.material({{"normalTexture", {{"index", 0}}}});
  b.node({{"mesh",
           b.triangleMesh({{"material", 0},
                           {"attributes",
                            {{"TEXCOORD_0", b.vec2({0, 1, 1, 1, 0, 0})},
                             {"NORMAL", b.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1})},
                             {"TANGENT", b.floats("VEC4", 4, {0, 2, 0, 1, 0, 2, 0, 1, 0, 2, 0, -1})}}}})}});
  Scene scene = b.load();
  ASSERT_EQ(scene.tangents.size(), 3U);
  EXPECT_EQ(scene.tangents[0], glm::vec4(0, 1, 0, 1));
  EXPECT_EQ(scene.tangents[2], glm::vec4(0, 1, 0, -1));
  b.json["nodes"][0]["scale"] = {1, -1, 1};
  scene = b.load();
  // n stays +Z, T becomes -Y; the bitangent n × T · w was -X and must still be, the mirror leaves X alone.
  EXPECT_EQ(scene.tangents[0], glm::vec4(0, -1, 0, -1));
}

TEST(GltfTangents, MirroredHalvesDoNotCancel) {
  Square halves;
  // Two triangles that share an edge on the Y axis; u grows away from it on both sides.
  halves.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0};
  halves.uv = {0, 1, 1, 1, 0, 0, 1, 1};
  halves.tangents.clear();
  const Scene scene = load(halves);
  ASSERT_EQ(scene.triangles.size(), 2U);
  const Triangle& right = scene.triangles[0];
  const Triangle& left = scene.triangles[1];
  for (const std::uint32_t v : {right.v0, right.v1, right.v2})
    EXPECT_EQ(scene.tangents[v], glm::vec4(1, 0, 0, 1));
  for (const std::uint32_t v : {left.v0, left.v1, left.v2})
    EXPECT_EQ(scene.tangents[v], glm::vec4(-1, 0, 0, -1));
  EXPECT_EQ(scene.positions.size(), 6U);
}

TEST(GltfTangents, OfTheFileDoNotCountWithoutNormals) {
  Square square;
  square.normals.clear();
  square.tangents = {0, 0, 1, 1, 0, 1, 0, -1, 0, 0, 1, 1, 0, 1, 0, -1};
  const Scene scene = load(square);
  EXPECT_TRUE(scene.normals.empty()) << "flat";
  expectTangents(scene, {1, 0, 0, 1});
}

/// Two slopes that meet in a ridge along Z, u along the slopes from left to right.
Square roof() {
  Square roof;
  roof.positions = {0, 0, 0, 1, -1, 0, 0, 0, -1, -1, -1, 0};
  roof.uv = {0.5F, 1, 1, 1, 0.5F, 0, 0, 1};
  roof.normals = {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
  roof.indices = {0, 1, 2, 0, 2, 3};
  roof.tangents.clear();
  return roof;
}

TEST(GltfTangents, OfFlatTrianglesLieInTheirPlanes) {
  Square flat = roof();
  flat.normals.clear();
  const Scene scene = load(flat);
  ASSERT_EQ(scene.triangles.size(), 2U);
  EXPECT_EQ(scene.positions.size(), 6U) << "vertices of their own";
  const float half = std::sqrt(0.5F);
  for (const int i : {0, 1}) {
    const Triangle& t = scene.triangles[i];
    for (const std::uint32_t v : {t.v0, t.v1, t.v2}) {
      expectNear(glm::vec3(scene.tangents[v]), {half, i == 0 ? -half : half, 0}, 1e-6F);
      EXPECT_EQ(scene.tangents[v].w, 1.0F);
    }
  }
  const Scene smooth = load(roof());
  EXPECT_EQ(smooth.positions.size(), 4U) << "with normals the ridge is shared";
  expectNear(glm::vec3(smooth.tangents[0]), {1, 0, 0}, 1e-6F);
}

TEST(GltfTangents, TurnWithTheImage) {
  const auto expectTurned = [](const Json& transform, const glm::vec4& expected) {
    SCOPED_TRACE(transform.dump());
    Square square;
    square.slot = transformed(transform);
    expectTangents(load(square), expected);
    square.tangents.clear();
    expectTangents(load(square), expected);
  };
  const float pi = std::numbers::pi_v<float>;
  expectTurned({{"rotation", pi / 2}}, {0, -1, 0, 1});  // counter-clockwise turns of the coordinates turn the
  expectTurned({{"rotation", -pi / 2}}, {0, 1, 0, 1});  // image clockwise
  expectTurned({{"rotation", pi}}, {-1, 0, 0, 1});
  expectTurned({{"rotation", pi / 6}, {"scale", {2, 2}}}, {std::cos(pi / 6), -0.5F, 0, 1});
  expectTurned({{"scale", {-1, 1}}}, {-1, 0, 0, -1});
  expectTurned({{"scale", {1, -1}}}, {1, 0, 0, -1});
  expectTurned({{"scale", {-1, -1}}}, {-1, 0, 0, 1});
  expectTurned({{"scale", {-1, 1}}, {"rotation", pi / 2}}, {0, -1, 0, -1});
  expectTurned({{"scale", {3, 0.5}}, {"offset", {0.25, 0.5}}}, {1, 0, 0, 1});
}

TEST(GltfTangents, TurnAsThoseOfOurOwnOnAStretchedImage) {
  for (const Json& transform :
       {Json{{"rotation", 0.7}}, Json{{"rotation", 0.7}, {"scale", {-3, 0.5}}}, Json{{"rotation", -2}}}) {
    SCOPED_TRACE(transform.dump());
    Square square;
    for (std::size_t i = 0; i < 12; i += 3) square.positions[i] *= 4;
    square.slot = transformed(transform);
    const Scene turned = load(square);
    square.tangents.clear();
    const Scene generated = load(square);
    ASSERT_EQ(turned.tangents.size(), generated.tangents.size());
    expectTangents(turned, generated.tangents[0]);
  }
}

TEST(GltfTangents, TurnFromWhereTheFileHasThem) {
  Square square;
  square.slot = transformed({{"rotation", std::numbers::pi / 2}});
  square.tangents = {0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1};
  expectTangents(load(square), {-1, 0, 0, -1});  // against the bitangent, w · n × T = +X
}

TEST(GltfTangents, StayWhereATransformLeavesNoImage) {
  Square square;
  square.slot = transformed({{"scale", {0, 1}}});
  expectTangents(load(square), {1, 0, 0, 1});
}

TEST(GltfTangents, BelongToTheSetThatTheNormalTextureNames) {
  Square square;
  square.uv1 = {0, 0, 0, 1, 1, 1, 1, 0};  // u along +Y, v along +X
  square.slot = {{"index", 0}, {"texCoord", 1}};
  expectTangents(load(square), {1, 0, 0, 1});
  square.slot = transformed({{"texCoord", 1}});
  expectTangents(load(square), {0, 1, 0, 1});  // the transform's set is another: they are made anew
}

}  // namespace
}  // namespace whittle
