// KHR_draco_mesh_compression: both methods against the plain file as sets of triangles, and streams that are
// wrong.
#include <gtest/gtest.h>

#include "gltf/grid.h"
#ifdef WHITTLE_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
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

/// A file whose one primitive is a stream; accessors have counts and no data.
GltfBuilder dracoFile(const std::string& stream, std::size_t points, std::size_t corners, Json ids) {
  GltfBuilder b;
  const int view = b.view(std::vector<char>(stream.begin(), stream.end()));
  Json attributes{{"POSITION", b.accessor(-1, "VEC3", test::kFloat, points)}};
  if (ids.contains("NORMAL")) attributes["NORMAL"] = b.accessor(-1, "VEC3", test::kFloat, points);
  if (ids.contains("COLOR_0")) attributes["COLOR_0"] = b.accessor(-1, "VEC4", test::kUbyte, points, 0, true);
  addGridNode(
      b, attributes, b.accessor(-1, "SCALAR", test::kUshort, corners),
      {{"extensions", {{"KHR_draco_mesh_compression", {{"bufferView", view}, {"attributes", ids}}}}}});
  b.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  b.json["buffers"] = {{{"byteLength", b.binary.size()}}};
  return b;
}

#ifndef WHITTLE_DRACO

TEST(GltfDraco, NotBuiltIsSaid) {
  GltfBuilder b = dracoFile("DRACO", 3, 3, {{"POSITION", 0}});
  expectMentions(errorAsIs(b), "built without libdraco-dev");
}

#else

constexpr int kEdgebreaker = draco::MESH_EDGEBREAKER_ENCODING, kSequential = draco::MESH_SEQUENTIAL_ENCODING;

template <class T>
int addAttribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, int components,
                 draco::DataType dataType, const std::vector<T>& values) {
  draco::GeometryAttribute attribute;
  const auto width = static_cast<std::size_t>(components);
  attribute.Init(type, nullptr, static_cast<std::uint8_t>(components), dataType, false,
                 static_cast<std::int64_t>(sizeof(T) * width), 0);
  const auto count = static_cast<draco::AttributeValueIndex::ValueType>(values.size() / width);
  const int id = mesh.AddAttribute(attribute, true, count);
  for (draco::AttributeValueIndex v(0); v < count; ++v)
    mesh.attribute(id)->SetAttributeValue(v, &values[v.value() * width]);
  return id;
}

struct Packed {
  std::string stream;
  std::size_t points = 0, corners = 0;
};

/// `bits`: of positions and normals; 0: as they are. One colour a vertex where `colours` has them.
Packed packed(const Grid& g, int method, int bits, const std::vector<std::uint8_t>& colours = {}) {
  draco::Mesh mesh;
  mesh.set_num_points(static_cast<std::uint32_t>(g.vertices()));
  addAttribute(mesh, draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32, g.positions);
  addAttribute(mesh, draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32, g.normals);
  if (!colours.empty()) addAttribute(mesh, draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8, colours);
  for (std::size_t i = 0; i + 2 < g.indices.size(); i += 3)
    mesh.AddFace({draco::PointIndex(g.indices[i]), draco::PointIndex(g.indices[i + 1]),
                  draco::PointIndex(g.indices[i + 2])});
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  encoder.SetTrackEncodedProperties(true);
  if (bits > 0) {
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, bits);
  }
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  return {std::string(buffer.data(), buffer.size()), encoder.num_encoded_points(),
          3 * encoder.num_encoded_faces()};
}

/// Each triangle has vertices of its own, so positions are fewer than points.
Grid withSeams(const Grid& g) {
  Grid split;
  for (std::size_t i = 0; i < g.indices.size(); ++i) {
    const std::size_t v = g.indices[i];
    for (std::size_t c = 0; c < 3; ++c) split.positions.push_back(g.positions[3 * v + c]);
    const float tilt = 0.01F * static_cast<float>(i / 3 % 7);
    const glm::vec3 n =
        glm::normalize(glm::vec3(g.normals[3 * v] + tilt, g.normals[3 * v + 1], g.normals[3 * v + 2]));
    split.normals.insert(split.normals.end(), {n.x, n.y, n.z});
    split.indices.push_back(static_cast<std::uint16_t>(i));
  }
  return split;
}

GltfBuilder fileOf(const Packed& p, Json ids = {{"POSITION", 0}, {"NORMAL", 1}}) {
  return dracoFile(p.stream, p.points, p.corners, std::move(ids));
}

TEST(GltfDraco, WithoutQuantisationTheTrianglesArePlain) {
  for (const bool hasSeams : {false, true})
    for (const int method : {kEdgebreaker, kSequential}) {
      const Grid g = hasSeams ? withSeams(test::makeGrid()) : test::makeGrid();
      GltfBuilder plain = plainGrid(g), b = fileOf(packed(g, method, 0));
      EXPECT_EQ(triangleSet(loadAsIs(b)), triangleSet(plain.load())) << hasSeams << method;
      ASSERT_EQ(b.notices.unpacked.size(), 1U);
      EXPECT_EQ(b.notices.unpacked[0].extension, "KHR_draco_mesh_compression");
    }
}

/// Half a step of the longest side, 1 m; snapped back to the grid's own points the triangles are those of the
/// plain file.
TEST(GltfDraco, QuantisedPositionsAreWithinHalfAStep) {
  constexpr int kBits = 11;
  constexpr float kHalfStep = 0.5F / ((1 << kBits) - 1);
  const Grid g = test::makeGrid();
  for (const int method : {kEdgebreaker, kSequential}) {
    GltfBuilder plain = plainGrid(g), b = fileOf(packed(g, method, kBits));
    Scene scene = loadAsIs(b);
    const Scene wanted = plain.load();
    for (std::size_t v = 0; v < scene.positions.size(); ++v) {
      glm::vec3& p = scene.positions[v];
      const auto x = static_cast<std::size_t>(std::lround(p.x / Grid::kSpacing)),
                 y = static_cast<std::size_t>(std::lround(p.y / Grid::kSpacing));
      ASSERT_LT(std::max(x, y), Grid::kSide);
      const glm::vec3 exact = wanted.positions[y * Grid::kSide + x];
      test::expectNear(p, exact, kHalfStep + 1e-6F);
      p = exact;
      scene.normals[v] = wanted.normals[y * Grid::kSide + x];
    }
    EXPECT_EQ(triangleSet(scene), triangleSet(wanted)) << method;
  }
}

/// Whether bytes are fractions of 255 is said by the accessor: Draco's own flag is off here.
TEST(GltfDraco, TypesAreThoseOfTheAccessors) {
  const Grid g = test::makeGrid();
  std::vector<std::uint8_t> colours;
  for (std::size_t v = 0; v < g.vertices(); ++v) {
    const auto c = static_cast<std::uint8_t>(v % 251);
    colours.insert(colours.end(), {c, 51, 255, 255});
  }
  GltfBuilder b =
      fileOf(packed(g, kSequential, 0, colours), {{"POSITION", 0}, {"NORMAL", 1}, {"COLOR_0", 2}});
  const Scene scene = loadAsIs(b);
  ASSERT_EQ(scene.colors.size(), g.vertices());
  for (std::size_t v = 0; v < scene.colors.size(); ++v) {
    EXPECT_FLOAT_EQ(scene.colors[v].g, 0.2F);
    EXPECT_FLOAT_EQ(scene.colors[v].a, 1.0F);
  }
}

/// A sequential stream keeps the order of points, so plain deltas belong to it.
TEST(GltfDraco, MorphTargetsBesideAStream) {
  const Grid g = test::makeGrid();
  GltfBuilder b = fileOf(packed(g, kSequential, 0));
  std::vector<float> deltas;
  for (std::size_t v = 0; v < g.vertices(); ++v) deltas.insert(deltas.end(), {0, 0, static_cast<float>(v)});
  b.json["meshes"][0]["primitives"][0]["targets"] = Json::array({{{"POSITION", b.vec3(deltas)}}});
  b.json["meshes"][0]["weights"] = {0.5};
  b.json["buffers"][0]["byteLength"] = b.binary.size();
  const Scene scene = loadAsIs(b);
  ASSERT_EQ(scene.positions.size(), g.vertices());
  for (std::size_t v = 0; v < g.vertices(); ++v)
    EXPECT_FLOAT_EQ(scene.positions[v].z, g.positions[3 * v + 2] + 0.5F * static_cast<float>(v));
}

TEST(GltfDraco, AStreamOfTwoPrimitivesIsUnpackedOnce) {
  GltfBuilder b = fileOf(packed(test::makeGrid(), kEdgebreaker, 0));
  Json& primitives = b.json["meshes"][0]["primitives"];
  const Json one = primitives[0];
  primitives.push_back(one);
  EXPECT_EQ(loadAsIs(b).triangles.size(), 2 * test::makeGrid().indices.size() / 3);
  ASSERT_EQ(b.notices.unpacked.size(), 1U);
  EXPECT_EQ(b.notices.unpacked[0].parts, 1U);
}

TEST(GltfDraco, StreamsThatDoNotFitAreOneLine) {
  const Packed p = packed(test::makeGrid(), kEdgebreaker, 11);
  const auto error = [](Packed changed, Json ids = {{"POSITION", 0}, {"NORMAL", 1}}) {
    GltfBuilder b = fileOf(changed, std::move(ids));
    return errorAsIs(b);
  };
  const std::string more = "meshes[0] primitive 0: it has more triangles, points or attributes than";
  expectMentions(error({p.stream, p.points, p.corners - 3}), more);
  expectMentions(error({p.stream, p.points - 1, p.corners}), more);
  expectMentions(error({p.stream, std::size_t{1} << 32, p.corners}), "more vertices or triangles than");
  expectMentions(error(p, {{"POSITION", 0}, {"NORMAL", 5}}), "lacks an attribute");
  expectMentions(error(p, {{"NORMAL", 1}}), "to hold no POSITION");
  expectMentions(error(p, {{"POSITION", 0}, {"COLOR_0", 1}}), "another shape than its accessor");
  Packed old = p;
  old.stream[6] = 1;
  expectMentions(error(old), "of version 2.1, and glTF has 2.2");
  expectMentions(error({"no stream at all", 3, 3}), "no Draco stream");
  for (std::size_t length = 0; length < p.stream.size(); length += 7)
    expectMentions(error({p.stream.substr(0, length), p.points, p.corners}), "meshes[0] primitive 0: it");
}

TEST(GltfDraco, MutatedStreams) {
  for (const int method : {kEdgebreaker, kSequential})
    for (const int bits : {0, 11})
      loadMutated(fileOf(packed(bits == 0 ? withSeams(test::makeGrid()) : test::makeGrid(), method, bits)),
                  5);
}

/// What the accessors announce is held against the limit before the decoder is called.
TEST(GltfDraco, AnnouncedSizesAreBounded) {
  const Packed p = packed(test::makeGrid(), kEdgebreaker, 11);
  GltfBuilder b = fileOf({p.stream, p.points, std::size_t{3} << 28});
  expectMentions(errorAsIs(b), "its 268435456 triangles in Draco's streams would take");
}

#endif

}  // namespace
}  // namespace whittle
