// EXT_meshopt_compression: each mode and filter against the plain file, and streams that are wrong.
#include <gtest/gtest.h>

#include "gltf/edited_copy.h"
#include "gltf/grid.h"
#ifdef WHITTLE_MESHOPT
#include <meshoptimizer.h>
#endif

namespace whittle {
namespace {

using test::errorAsIs;
using test::expectMentions;
using test::GltfBuilder;
using test::Grid;
using test::Json;
using test::loadAsIs;
using test::triangleSet;

/// A view that is compressed in buffer 0 and would lie in buffer 1, which no file backs.
int packedView(GltfBuilder& b, const std::vector<unsigned char>& packed, std::size_t count,
               std::size_t stride, const char* mode, const char* filter = "NONE") {
  const int inner = b.view(packed);
  Json where = b.json["bufferViews"][inner];
  where.update({{"count", count}, {"byteStride", stride}, {"mode", mode}, {"filter", filter}});
  b.json["bufferViews"][inner] = {
      {"buffer", 1}, {"byteLength", count * stride}, {"extensions", {{"EXT_meshopt_compression", where}}}};
  return inner;
}

void finish(GltfBuilder& b) {
  b.json["extensionsRequired"] = {"EXT_meshopt_compression"};
  b.json["buffers"] = {{{"byteLength", b.binary.size()}},
                       {{"byteLength", 1 << 20},
                        {"uri", "nobody_has_this.bin"},
                        {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
}

Json& streamOf(GltfBuilder& b, int view) {
  return b.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
}

#ifndef WHITTLE_MESHOPT

TEST(GltfMeshopt, NotBuiltIsSaid) {
  GltfBuilder b;
  const int positions = b.accessor(packedView(b, {0xa0, 0}, 3, 12, "ATTRIBUTES"), "VEC3", test::kFloat, 3);
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", positions}}}})}});
  finish(b);
  expectMentions(errorAsIs(b), "built without libmeshoptimizer-dev");
}

#else

template <class T>
std::vector<unsigned char> packAttributes(const std::vector<T>& values, std::size_t stride) {
  const std::size_t count = values.size() * sizeof(T) / stride;
  std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(count, stride));
  packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), values.data(), count, stride));
  return packed;
}

std::vector<unsigned char> packTriangles(const std::vector<std::uint16_t>& indices, std::size_t vertices) {
  std::vector<unsigned char> packed(meshopt_encodeIndexBufferBound(indices.size(), vertices));
  packed.resize(meshopt_encodeIndexBuffer(packed.data(), packed.size(), indices.data(), indices.size()));
  return packed;
}

std::vector<unsigned char> packSequence(const std::vector<std::uint16_t>& indices, std::size_t vertices) {
  std::vector<unsigned char> packed(meshopt_encodeIndexSequenceBound(indices.size(), vertices));
  packed.resize(meshopt_encodeIndexSequence(packed.data(), packed.size(), indices.data(), indices.size()));
  return packed;
}

enum View { kPositions = 0, kNormals = 1, kIndices = 2 };

/// The grid with every view packed, without a filter.
GltfBuilder packedGrid(const Grid& g, bool asSequence = false, std::size_t indexBytes = 2) {
  GltfBuilder b;
  const int p = packedView(b, packAttributes(g.positions, 12), g.vertices(), 12, "ATTRIBUTES");
  const int n = packedView(b, packAttributes(g.normals, 12), g.vertices(), 12, "ATTRIBUTES");
  const int i =
      asSequence
          ? packedView(b, packSequence(g.indices, g.vertices()), g.indices.size(), indexBytes, "INDICES")
          : packedView(b, packTriangles(g.indices, g.vertices()), g.indices.size(), indexBytes, "TRIANGLES");
  addGridNode(b,
              {{"POSITION", b.accessor(p, "VEC3", test::kFloat, g.vertices())},
               {"NORMAL", b.accessor(n, "VEC3", test::kFloat, g.vertices())}},
              b.accessor(i, "SCALAR", indexBytes == 2 ? test::kUshort : test::kUint, g.indices.size()));
  finish(b);
  return b;
}

TEST(GltfMeshopt, EachModeHasTheTrianglesOfThePlainFile) {
  const Grid g = test::makeGrid();
  GltfBuilder plain = plainGrid(g);
  const auto wanted = triangleSet(plain.load());
  for (const bool asSequence : {false, true})
    for (const std::size_t indexBytes : {2, 4}) {
      GltfBuilder b = packedGrid(g, asSequence, indexBytes);
      EXPECT_EQ(triangleSet(loadAsIs(b)), wanted) << asSequence << indexBytes;
      ASSERT_EQ(b.notices.unpacked.size(), 1U);
      EXPECT_EQ(b.notices.unpacked[0].extension, "EXT_meshopt_compression");
      EXPECT_EQ(b.notices.unpacked[0].parts, 3U);
      EXPECT_EQ(b.notices.unpacked[0].bytes, g.vertices() * 24 + g.indices.size() * indexBytes);
    }
}

/// An octahedral pair is off by half a step of 1/127 on each axis, the vector by up to three times as much
/// (√3 on the octahedron, √3 where it is nearest to the centre), and each of its components by another half.
TEST(GltfMeshopt, OctahedralNormals) {
  const Grid g = test::makeGrid();
  for (const std::size_t stride : {4, 8}) {
    const double steps = stride == 4 ? 127 : 32767;
    GltfBuilder b = packedGrid(g);
    std::vector<float> four;
    for (std::size_t v = 0; v < g.vertices(); ++v)
      four.insert(four.end(), {g.normals[3 * v], g.normals[3 * v + 1], g.normals[3 * v + 2], 0});
    std::vector<unsigned char> filtered(g.vertices() * stride);
    meshopt_encodeFilterOct(filtered.data(), g.vertices(), stride, stride == 4 ? 8 : 16, four.data());
    const int view =
        packedView(b, packAttributes(filtered, stride), g.vertices(), stride, "ATTRIBUTES", "OCTAHEDRAL");
    b.json["bufferViews"][view]["byteStride"] = stride;
    b.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        b.accessor(view, "VEC3", stride == 4 ? test::kByte : test::kShort, g.vertices(), 0, true);
    finish(b);
    const Scene scene = loadAsIs(b);
    ASSERT_EQ(scene.normals.size(), g.vertices());
    const double most = (3 * std::sqrt(2.0) + std::sqrt(3.0)) * 0.5 / steps;
    for (std::size_t v = 0; v < g.vertices(); ++v) {
      const glm::dvec3 wanted(g.normals[3 * v], g.normals[3 * v + 1], g.normals[3 * v + 2]);
      EXPECT_LT(glm::length(glm::dvec3(scene.normals[v]) - wanted), most) << v;
    }
  }
}

/// With 15 bits and one exponent for a vector: half a step is 2^-14 of its largest component.
TEST(GltfMeshopt, ExponentialPositions) {
  const Grid g = test::makeGrid();
  GltfBuilder b = packedGrid(g);
  std::vector<unsigned char> filtered(g.vertices() * 12);
  meshopt_encodeFilterExp(filtered.data(), g.vertices(), 12, 15, g.positions.data());
  const int view = packedView(b, packAttributes(filtered, 12), g.vertices(), 12, "ATTRIBUTES", "EXPONENTIAL");
  b.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
      b.accessor(view, "VEC3", test::kFloat, g.vertices());
  finish(b);
  const Scene scene = loadAsIs(b);
  ASSERT_EQ(scene.positions.size(), g.vertices());
  for (std::size_t v = 0; v < g.vertices(); ++v)
    test::expectNear(scene.positions[v], {g.positions[3 * v], g.positions[3 * v + 1], g.positions[3 * v + 2]},
                     std::ldexp(1.0F, -14));
}

/// Rotations in the quaternion filter, times and translations in the exponential one. Of 16 bits a component
/// is off by half a step of 1/(√2·32767), then by half of 1/32767, and a turned unit vector by twice what its
/// quaternion is off.
TEST(GltfMeshopt, AnimationsAreUnpacked) {
  GltfBuilder b;
  const float s = std::sqrt(0.5F);
  const std::vector<float> times{0, 1}, turns{0, 0, 0, 1, 0, 0, s, s};
  std::vector<unsigned char> filtered(16), seconds(8);
  meshopt_encodeFilterQuat(filtered.data(), 2, 8, 16, turns.data());
  meshopt_encodeFilterExp(seconds.data(), 2, 4, 23, times.data());
  const int input = b.accessor(packedView(b, packAttributes(seconds, 4), 2, 4, "ATTRIBUTES", "EXPONENTIAL"),
                               "SCALAR", test::kFloat, 2);
  const int output = b.accessor(packedView(b, packAttributes(filtered, 8), 2, 8, "ATTRIBUTES", "QUATERNION"),
                                "VEC4", test::kShort, 2, 0, true);
  const int node = b.node({{"mesh", b.triangleMesh()}, {"rotation", {0, 0, 0, 1}}});
  b.push("animations",
         {{"samplers", {{{"input", input}, {"output", output}}}},
          {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "rotation"}}}}}}});
  finish(b);
  LoadOptions options;
  options.time = 0.5;
  const Scene scene = loadAsIs(b, options);
  ASSERT_EQ(scene.triangles.size(), 1U);
  constexpr float kMost = static_cast<float>(2 * 2 * (0.5 / 1.4142 + 0.5) / 32767);
  test::expectNear(test::corner(scene, 0, 1), {s, s, 0}, kMost);
}

TEST(GltfMeshopt, WithoutTheExtensionRequiredItIsStillUnpacked) {
  const Grid g = test::makeGrid();
  GltfBuilder b = packedGrid(g);
  b.json.erase("extensionsRequired");
  EXPECT_EQ(loadAsIs(b).triangles.size(), g.indices.size() / 3);
}

TEST(GltfMeshopt, AnEditedCopyStaysCompressed) {
  GltfBuilder b = packedGrid(test::makeGrid());
  b.material({{"pbrMetallicRoughness", {{"roughnessFactor", 0.5}}}});
  b.json["meshes"][0]["primitives"][0]["material"] = 0;
  const test::TemporaryFolder folder;
  const auto file = folder.write("a.glb", b.glbAsIs());
  Notices notices;
  const Scene scene = loadGltf(file, {}, notices);
  const Appearance before = appearanceOf(scene);
  Appearance after = before;
  after.materials[0].roughness = 0.25F;
  const auto copy = writeEditedCopy({file, {}, scene.origin, before, after}, {});
  const Scene again = loadGltf(copy, {}, notices);
  EXPECT_EQ(again.materials[0].roughness, 0.25F);
  EXPECT_EQ(triangleSet(again), triangleSet(scene));
  ASSERT_EQ(notices.unpacked.size(), 1U);
  EXPECT_EQ(notices.unpacked[0].parts, 6U) << "three of each file";
}

TEST(GltfMeshopt, WhatDoesNotFitIsRefused) {
  const Grid g = test::makeGrid();
  const auto error = [&](View view, const Json& change) {
    GltfBuilder b = packedGrid(g);
    streamOf(b, view).update(change);
    return errorAsIs(b);
  };
  expectMentions(error(kPositions, {{"mode", "OTHER"}}), "unknown mode \"OTHER\"");
  expectMentions(error(kPositions, {{"filter", "COLOR"}}), "filter \"COLOR\"");
  expectMentions(error(kPositions, {{"filter", "OCTAHEDRAL"}}), "not legal for ATTRIBUTES, OCTAHEDRAL");
  expectMentions(error(kPositions, {{"filter", "QUATERNION"}}), "not legal");
  expectMentions(error(kPositions, {{"byteStride", 6}}), "not legal");
  expectMentions(error(kPositions, {{"byteStride", 0}}), "not legal");
  expectMentions(error(kPositions, {{"byteStride", 9007199254740992}}), "not legal");
  expectMentions(error(kPositions, {{"count", 9007199254740992}}), "not legal");
  expectMentions(error(kPositions, {{"count", g.vertices() - 1}}), "not legal");
  expectMentions(error(kIndices, {{"byteStride", 8}}), "not legal");
  expectMentions(error(kIndices, {{"filter", "EXPONENTIAL"}}), "not legal");
  expectMentions(error(kIndices, {{"byteOffset", 1000000}}), "bufferViews[2] reaches beyond buffer 0");
  expectMentions(error(kIndices, {{"byteLength", 20}}), "cannot come of 20 compressed bytes");
  expectMentions(error(kPositions, {{"buffer", 7}}), "buffer is 7");
}

TEST(GltfMeshopt, DamagedStreamsAreOneLine) {
  const Grid g = test::makeGrid();
  GltfBuilder b = packedGrid(g);
  for (const View view : {kPositions, kNormals, kIndices}) {
    const auto start = streamOf(b, view)["byteOffset"].get<std::size_t>();
    GltfBuilder newer = b;
    newer.binary[start] = static_cast<char>(newer.binary[start] | 0x02);
    expectMentions(errorAsIs(newer), "EXT_meshopt_compression: a stream of version ");
    GltfBuilder other = b;
    other.binary[start] = 0;
    expectMentions(errorAsIs(other),
                   "bufferViews[" + std::to_string(view) + "]: its meshopt stream is damaged");
    GltfBuilder cut = b;
    streamOf(cut, view)["byteLength"] = streamOf(cut, view)["byteLength"].get<std::size_t>() - 1;
    expectMentions(errorAsIs(cut), "its meshopt stream is damaged");
  }
}

TEST(GltfMeshopt, MutatedStreams) {
  const Grid g = test::makeGrid();
  loadMutated(packedGrid(g), 3);
  loadMutated(packedGrid(g, true, 4), 4);
}

/// Sizes are held against the limit before they are taken: a version whose streams may be of no length at
/// all.
TEST(GltfMeshopt, AnnouncedSizesAreBounded) {
  const Grid g = test::makeGrid();
  GltfBuilder b = packedGrid(g);
  const std::uint64_t many = std::uint64_t{1} << 33;
  b.binary[streamOf(b, kPositions)["byteOffset"].get<std::size_t>()] = static_cast<char>(0xa1);
  streamOf(b, kPositions)["count"] = many;
  b.json["bufferViews"][kPositions]["byteLength"] = 12 * many;
  expectMentions(errorAsIs(b), "the unpacked bufferViews[0] would take 103 GB");
}

#endif

}  // namespace
}  // namespace whittle
