// Files as files: containers, URIs, versions, extensions, damaged input; and the defaults for what
// a file lacks.
#include <gtest/gtest.h>

#include <cmath>

#include "gltf/builder.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;
using test::errorOf;
using test::expectNear;
using test::GltfBuilder;
using test::Json;
using test::mentions;
using test::TemporaryFolder;

/// One triangle; the buffer is described by `buffer`.
std::string triangleGltf(const Json& buffer) {
  GltfBuilder b;
  b.node({{"mesh", b.triangleMesh()}});
  b.json["buffers"] = Json::array({buffer});
  return b.json.dump();
}

std::string triangleBytes() {
  GltfBuilder b;
  b.triangleMesh();
  return b.binary;
}

void expectLine(const std::string& text, const fs::path& path, const std::string& part);

TEST(GltfFile, WhatTheReaderRefusesIsOneLineInOurWords) {
  const TemporaryFolder folder;
  const auto refused = [&](const char* key, const Json& value, const std::string& part) {
    Json json = Json::parse(triangleGltf({{"byteLength", 36}, {"uri", "data:;base64,AAAA"}}));
    json[key] = Json::array({value});
    const auto path = folder.write("a.gltf", json.dump());
    const std::string text = test::errorOf(path);
    expectLine(text, path, "its description is not valid glTF 2.0: " + part);
    EXPECT_EQ(text.find("\\n"), std::string::npos) << text;
    EXPECT_NE(text.back(), '.') << text;
  };
  refused("cameras", {{"type", "fish"}}, "Invalid camera type");
  refused("cameras", {{"type", "perspective"}}, "Perspective camera");
}

void expectLine(const std::string& text, const fs::path& path, const std::string& part) {
  EXPECT_TRUE(text.starts_with(path.string() + ": ")) << text;
  EXPECT_NE(text.find(part), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  EXPECT_LT(text.size(), 400U) << text;
}

TEST(GltfFile, BufferInAFileWithEscapedName) {
  const TemporaryFolder folder;
  folder.write("a b#ä.bin", triangleBytes());
  const auto path = folder.write("a.gltf", triangleGltf({{"byteLength", 36}, {"uri", "a%20b%23%C3%A4.bin"}}));
  Notices notices;
  const Scene scene = loadGltf(path, {}, notices);
  EXPECT_EQ(scene.triangles.size(), 1U);
  EXPECT_EQ(scene.file, path.string());
}

TEST(GltfFile, BufferInADataUri) {
  const TemporaryFolder folder;
  // Nine floats: 0 0 0, 1 0 0, 0 1 0. 1.0F is 00 00 80 3F; its bytes 14–15 and 30–31 are the only ones that
  // are not zero.
  std::string base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  const auto load = [&](const std::string& uri) {
    Notices notices;
    return loadGltf(folder.write("a.gltf", triangleGltf({{"byteLength", 36}, {"uri", uri}})), {}, notices);
  };
  const Scene scene = load("data:application/octet-stream;base64," + base64);
  ASSERT_EQ(scene.triangles.size(), 1U);
  expectNear(scene.positions[1], {1, 0, 0}, 0);
  expectNear(scene.positions[2], {0, 1, 0}, 0);
}

TEST(GltfFile, BuffersThatAreNotThere) {
  const TemporaryFolder folder;
  const auto expectError = [&](const Json& buffer, const std::string& part) {
    const auto path = folder.write("a.gltf", triangleGltf(buffer));
    expectLine(errorOf(path), path, part);
  };
  expectError({{"byteLength", 36}, {"uri", "none.bin"}}, "does not exist");
  expectError({{"byteLength", 36}, {"uri", "."}}, "is a folder");
  expectError({{"byteLength", 36}, {"uri", "../../../../../../../../dev/zero"}}, "");
  expectError({{"byteLength", 36}, {"uri", "http://example.org/a.bin"}}, "local files only");
  expectError({{"byteLength", 36}, {"uri", "data:;base64,!!!!"}}, "cannot be decoded");
  expectError({{"byteLength", 36}, {"uri", "data:;base64,AAAA"}}, "too short: 3 bytes of 36");
  expectError({{"byteLength", 36}}, "buffer 0 has no data");
  expectError({{"byteLength", 1ULL << 50}, {"uri", "data:;base64,AAAA"}}, "too short");
  folder.write("short.bin", "1234");
  expectError({{"byteLength", 36}, {"uri", "short.bin"}}, "too short: 4 bytes of 36");
  folder.write("lfs.bin", "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 36\n");
  expectError({{"byteLength", 36}, {"uri", "lfs.bin"}}, "git-lfs");
}

TEST(GltfFile, NotAUsableFile) {
  const TemporaryFolder folder;
  const auto expectError = [&](const std::string& content, const std::string& part) {
    const auto path = folder.write("odd.gltf", content);
    expectLine(errorOf(path), path, part);
  };
  expectError("", "is empty");
  expectError("  \n", "is empty");
  expectError("[]", "not an object");
  expectError("17", "not an object");
  expectError("{", "JSON cannot be read");
  expectError("\x89PNG\r\n", "JSON cannot be read");
  expectError("{}", "asset is missing");
  expectError(R"({"asset": 3})", "asset must be an object");
  expectError(R"({"asset": {"version": "1.0"}})", "asset.version is \"1.0\"");
  expectError(R"({"asset": {"version": "1.0"}, "scene": "s", "scenes": {"s": {}}})", "glTF 1.0");
  expectError(R"({"asset": {"version": "2.0", "minVersion": "2.1"}})", "minVersion");
  expectError(R"({"asset": {"version": "2.0"}, "nodes": 3})", "nodes must be an array");
  expectError(R"({"asset": {"version": "2.0"}, "scene": 1e999})", "JSON cannot be read");
  expectError("{\"asset\": {\"version\": \"2.0\"}, \"x\": " + std::string(1000000, '['), "nested deeper");
  expectError("version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "git-lfs");
  expectError(R"({"asset": {"version": "2.0"}, "extensionsRequired": ["EXT_structural_metadata"]})",
              "needs EXT_structural_metadata");
  expectError(
      R"({"asset": {"version": "2.0"}, "extensionsRequired": ["X\n)" + std::string(5000, 'y') + "\"]}",
      "needs X ");
  expectLine(errorOf(folder.path()), folder.path(), "is a folder");
  expectLine(errorOf(folder.path() / "none.glb"), folder.path() / "none.glb", "does not exist");
}

TEST(GltfFile, DamagedBinary) {
  const TemporaryFolder folder;
  GltfBuilder b;
  b.node({{"mesh", b.triangleMesh()}});
  const std::string whole = b.glb();
  // Every length: truncation must be noticed, wherever it falls.
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto path = folder.write("cut.glb", whole.substr(0, length));
    expectLine(errorOf(path), path, "");
  }
  const auto changed = [&](std::size_t at, char value, const std::string& part) {
    std::string copy = whole;
    copy[at] = value;
    const auto path = folder.write("changed.glb", copy);
    expectLine(errorOf(path), path, part);
  };
  changed(4, 1, "version 1");
  changed(15, 0x7f, "chunk reaches beyond its end");
  changed(16, 'X', "first chunk is not JSON");
  Notices notices;
  EXPECT_EQ(loadGltf(folder.write("long.glb", whole + "more"), {}, notices).triangles.size(), 1U);
}

TEST(GltfFile, ExtensionsThatAreOnlyUsedAreOneNote) {
  GltfBuilder b;
  b.json["extensionsUsed"] = {"KHR_materials_volume_scatter", "KHR_xmp_json_ld", "KHR_materials_ior"};
  b.node({{"mesh", b.triangleMesh()}});
  b.load();
  EXPECT_TRUE(b.notices.warnings.empty());
  EXPECT_TRUE(
      mentions(b.notices.notes, "extensions not read: KHR_materials_volume_scatter, KHR_xmp_json_ld"));
  EXPECT_FALSE(mentions(b.notices.notes, "KHR_materials_ior"));
}

TEST(GltfFile, ManyInstancesOfAMeshAreBounded) {
  GltfBuilder b;
  // 2^24 vertices without a byte of data, drawn by many nodes: 2^22 triangles and more for each.
  const int p = b.accessor(-1, "VEC3", test::kFloat, 3);
  const int big = b.accessor(-1, "SCALAR", test::kUbyte, 3 << 22);
  const int mesh = b.mesh({{"attributes", {{"POSITION", p}}}, {"indices", big}});
  for (int i = 0; i < 64; ++i) b.node({{"mesh", mesh}});
  MemoryBudget plenty({std::uint64_t{1} << 50, true});
  LoadOptions options;
  options.memory = &plenty;
  EXPECT_NE(b.error(options).find("has more than"), std::string::npos);
}

TEST(GltfDefaults, ATriangleIsSeenFromItsFront) {
  GltfBuilder b;
  b.node({{"mesh", b.triangleMesh()}});
  const Scene scene = b.load();
  ASSERT_EQ(scene.cameras.size(), 1U);
  const Camera& c = scene.cameras[0];
  expectNear(c.forward, {0, 0, -1}, 0);
  expectNear(c.up, {0, 1, 0}, 0);
  expectNear(c.right, {1, 0, 0}, 0);
  EXPECT_NEAR(c.position.x, 0.5F, 1e-6);
  EXPECT_NEAR(c.position.y, 0.5F, 1e-6);
  // The height 1 with a margin of a tenth: 0.5 · 1.1 / tan(0.35).
  EXPECT_NEAR(c.position.z, 0.55 / std::tan(0.35), 1e-5);
  ASSERT_EQ(scene.lights.size(), 3U);
  EXPECT_TRUE(scene.lights[0].castsShadows);
  EXPECT_FALSE(scene.lights[1].castsShadows);
  for (const Light& l : scene.lights) {
    EXPECT_EQ(l.kind, LightKind::Directional);
    EXPECT_NEAR(glm::length(l.direction), 1.0F, 1e-6F);
    EXPECT_EQ(l.direction.z < 0, &l != &scene.lights[2]) << "from behind the camera, but for the rim";
    EXPECT_LT(l.direction.y, 0) << "from above";
  }
  EXPECT_GT(scene.lights[0].direction.x, 0) << "from the left";
  EXPECT_LT(scene.lights[1].direction.x, 0) << "from the right";
  // A soft box stands where the key light comes from.
  const Background& b0 = scene.background;
  ASSERT_EQ(b0.map.size(), std::size_t{3} * b0.width * b0.height);
  const glm::dvec3 key(-scene.lights[0].direction);
  const double u = 0.5 + std::atan2(key.x, -key.z) / (2 * std::numbers::pi),
               v = std::acos(key.y) / std::numbers::pi;
  const auto texel =
      3 * (static_cast<std::size_t>(v * b0.height) * b0.width + static_cast<std::size_t>(u * b0.width));
  EXPECT_GT(b0.map[texel], 4) << "the key's";
  EXPECT_LT(b0.map[0] + b0.map[b0.map.size() - 1], 2);
  EXPECT_EQ(b.notices.notes.size(), 2U);
}

TEST(GltfDefaults, EveryBoxIsFramed) {
  for (const glm::vec3 size :
       {glm::vec3(1, 1, 1), glm::vec3(10, 1, 2), glm::vec3(2, 1, 10), glm::vec3(1, 9, 1),
        glm::vec3(5, 0.01F, 5), glm::vec3(0, 3, 4), glm::vec3(1e-6F), glm::vec3(1e15F)}) {
    GltfBuilder b;
    const float x = size.x, y = size.y, z = size.z;
    b.node(
        {{"mesh", b.mesh({{"attributes",
                           {{"POSITION", b.vec3({0, 0, 0, x, y, 0, 0, y, z, 0, 0, z, x, 0, 0, x, y, z})}}}})},
         {"translation", {3 * x, 2 * y, z}}});
    const Scene scene = b.load();
    const Camera& c = scene.cameras.at(0);
    const double t = std::tan(0.5 * c.yfov);
    double nearest = 1e30, widest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p =
          glm::dvec3(size) * glm::dvec3(3 + (corner & 1), 2 + (corner >> 1 & 1), 1 + (corner >> 2));
      const glm::dvec3 d = p - glm::dvec3(c.position);
      const double depth = glm::dot(d, glm::dvec3(c.forward));
      nearest = std::min(nearest, depth);
      widest = std::max({widest, std::abs(glm::dot(d, glm::dvec3(c.right))) / (depth * t * 16 / 9),
                         std::abs(glm::dot(d, glm::dvec3(c.up))) / (depth * t)});
    }
    EXPECT_GT(nearest, 0.0) << x << ' ' << y << ' ' << z;
    EXPECT_LT(widest, 0.95) << "a margin remains";
    EXPECT_GT(widest, 0.85) << "and no more than one";
    EXPECT_LT(c.forward.y, 1e-6F) << "not from below";
    EXPECT_EQ(std::abs(c.forward.x) > std::abs(c.forward.z), z > 1.5F * x) << "a long thing from its side";
    EXPECT_LE(c.forward.x, 0) << "from the front right";
    EXPECT_LE(c.forward.z, 0);
  }
}

TEST(GltfDefaults, LightsAreAddedOnlyWhereNothingShines) {
  const auto lightsWith = [](const Json& material, const Json& extras, std::optional<bool> asked = {}) {
    GltfBuilder b;
    b.material(material);
    b.node({{"mesh", b.triangleMesh({{"material", 0}})}});
    b.json["scenes"][0]["extras"] = extras;
    return b.load({.sceneName = {}, .defaultLights = asked});
  };
  EXPECT_EQ(lightsWith({{"emissiveFactor", {0, 1, 0}}}, Json::object(), true).lights.size(), 3U)
      << "asked for";
  EXPECT_EQ(lightsWith(Json::object(), Json::object()).lights.size(), 3U);
  EXPECT_EQ(lightsWith(Json::object(), Json::object(), false).lights.size(), 0U) << "not wanted";
  EXPECT_FALSE(lightsWith(Json::object(), Json::object(), false).background.map.empty())
      << "but a part of its own";
  EXPECT_EQ(lightsWith({{"emissiveFactor", {0, 1, 0}}}, Json::object()).lights.size(), 0U);
  EXPECT_EQ(
      lightsWith({{"extensions", {{"KHR_materials_unlit", Json::object()}}}}, Json::object()).lights.size(),
      0U);
  const Scene lit = lightsWith(Json::object(), {{"whittle", {{"background", {0.5, 1, 2}}}}});
  EXPECT_EQ(lit.lights.size(), 0U);
  expectNear(lit.background.radiance, {0.5F, 1, 2}, 0);
  EXPECT_EQ(lightsWith(Json::object(), {{"whittle", {{"background", "blue"}}}}).lights.size(), 3U);
  EXPECT_EQ(lightsWith(Json::object(), "anything").lights.size(), 3U);
}

TEST(GltfDefaults, AFilesSkyIsMadeUnlessAnotherIsAskedFor) {
  const auto sceneWith = [](const Json& value, std::size_t warnings, std::optional<SkyChoice> asked = {}) {
    GltfBuilder b;
    b.material(Json::object());
    b.node({{"mesh", b.triangleMesh({{"material", 0}})}});
    b.json["scenes"][0]["extras"]["whittle"]["sky"] = value;
    LoadOptions options;
    options.sky = asked;
    Scene scene = b.load(options);
    EXPECT_EQ(b.notices.warnings.size(), warnings) << value;
    return scene;
  };
  const Scene outside = sceneWith({30, 90, 2.5}, 0);
  EXPECT_EQ(outside.sky, (Sky{30, 90, 2.5}));
  ASSERT_EQ(outside.lights.size(), 1U) << "no studio beside the sun";
  EXPECT_FALSE(outside.hasStudioLights);
  // The sun stands half way up in +X, and shines the other way.
  expectNear(outside.lights[0].direction, {-std::sqrt(0.75F), -0.5F, 0}, 1e-6F);
  EXPECT_EQ(sceneWith({30, 90}, 0).sky, (Sky{30, 90, 3}));
  EXPECT_EQ(sceneWith({30, 90}, 0, SkyChoice{false, {10, 0, 4}}).sky, (Sky{10, 0, 4}));
  EXPECT_EQ(sceneWith({30, 90}, 0, SkyChoice{true, {}}).lights.size(), 3U)
      << "then it is a file without lights";
  for (const Json& wrong : {Json("noon"), Json({30}), Json({91, 0}), Json({30, "x"}), Json({30, 0, 1}),
                            Json({30, 0, 3, 3}), Json(nullptr)})
    EXPECT_FALSE(sceneWith(wrong, 1).sky) << wrong;
}

TEST(GltfDefaults, LampsThatAreAllDarkAreSaid) {
  for (const double intensity : {0.0, 1.0}) {
    GltfBuilder b;
    b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", intensity}}};
    b.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    EXPECT_EQ(b.load().lights.size(), 1U);
    EXPECT_EQ(b.notices.warnings.size(), intensity == 0 ? 1U : 0U);
  }
}

TEST(GltfDefaults, NothingAtAllStillLoads) {
  GltfBuilder b;
  const Scene scene = b.load();
  EXPECT_TRUE(scene.triangles.empty());
  ASSERT_EQ(scene.cameras.size(), 1U);
  EXPECT_TRUE(std::isfinite(scene.cameras[0].position.z));
}

}  // namespace
}  // namespace whittle
