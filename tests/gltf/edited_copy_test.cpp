// Copies of files with edited lights and materials: what is read from them, and what else they change.
#include "gltf/edited_copy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gltf/builder.h"

namespace whittle {
namespace {

using test::GltfBuilder;
using test::Json;
using test::TemporaryFolder;

constexpr const char* kPunctual = "KHR_lights_punctual";

Json lightOf(int index) { return {{kPunctual, {{"light", index}}}}; }

/// A turned and scaled group with a light of its own, one on a mesh, one definition that two nodes share; a
/// material with an extension and extras that nobody reads, and a primitive without a material.
GltfBuilder litFile() {
  GltfBuilder b;
  b.json["extensionsUsed"] = {kPunctual, "VENDOR_thing"};
  b.json["extensions"][kPunctual]["lights"] = {
      {{"type", "point"}, {"name", "Glühbirne"}, {"intensity", 40}, {"color", {1.0, 0.5, 0.25}}},
      {{"type", "spot"}, {"intensity", 0.1}, {"spot", {{"outerConeAngle", 0.7}}}},
      {{"type", "directional"}, {"intensity", 3}}};
  b.material({{"name", "clay"},
              {"pbrMetallicRoughness", {{"roughnessFactor", 0.9}, {"baseColorFactor", {0.3, 0.2, 0.1, 1.0}}}},
              {"extensions", {{"VENDOR_thing", {{"x", 1}}}}},
              {"extras", {{"keep", "me"}}}});
  b.node(
      {{"mesh", b.triangleMesh({{"material", 0}})}, {"extensions", lightOf(1)}, {"name", "lamp and mesh"}});
  b.node({{"mesh", b.triangleMesh()}, {"translation", {0, 0, 2}}});
  const int bulb = b.node({{"extensions", lightOf(0)}, {"translation", {1, 2, 3}}}, false);
  b.node({{"children", {bulb}},
          {"rotation", {0.1, 0.2, 0.3, 0.9}},
          {"scale", {2, 3, 0.5}},
          {"translation", {5, 0, 1}}});
  b.node({{"extensions", lightOf(2)}, {"rotation", {0.3, 0, 0, 0.95}}});
  b.node({{"extensions", lightOf(2)}, {"matrix", {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 7, 8, 9, 1}}});
  b.node({{"extensions", lightOf(1)}, {"matrix", {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 7, 8, 9, 1}}});
  return b;
}

Scene read(const std::filesystem::path& file) {
  Notices notices;
  return loadGltf(file, {}, notices);
}

Json jsonOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!bytes.starts_with("glTF")) return Json::parse(bytes);
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, sizeof(size));
  return Json::parse(bytes.substr(20, size));
}

/// A file, an edit, its copy, and what is read from that.
struct Edited {
  TemporaryFolder folder;
  std::filesystem::path file, copy;
  Scene scene, again;

  Edited(const GltfBuilder& b, const std::function<void(Appearance&)>& change)
      : file(folder.write("a.glb", b.glb())) {
    scene = read(file);
    const Appearance before = appearanceOf(scene);
    Appearance after = before;
    change(after);
    copy = writeEditedCopy({file, {}, scene.origin, before, after}, {});
    again = read(copy);
    expectSame(after);
  }

  /// To the bit, in the same order.
  void expectSame(const Appearance& after) const {
    ASSERT_EQ(again.lights.size(), after.lights.size());
    for (std::size_t i = 0; i < after.lights.size(); ++i) {
      const Light &is = again.lights[i], &wanted = after.lights[i];
      EXPECT_FALSE(differs(is, wanted)) << "light " << i;
      EXPECT_EQ(is.direction, wanted.direction) << "light " << i;
      EXPECT_EQ(is.name, wanted.name);
      EXPECT_EQ(is.castsShadows, wanted.castsShadows);
    }
    ASSERT_EQ(again.materials.size(), after.materials.size());
    for (std::size_t i = 0; i < after.materials.size(); ++i)
      EXPECT_FALSE(differs(again.materials[i], after.materials[i])) << "material " << i;
  }

  /// Paths of the JSON that differ, without what comes below a new thing.
  std::vector<std::string> changes() const {
    std::vector<std::string> paths;
    for (const Json& step : Json::diff(jsonOf(file), jsonOf(copy))) paths.push_back(step["path"]);
    return paths;
  }
};

TEST(EditedCopy, AnIntensityChangesItsTwoNumbersAndNoByteElse) {
  const Edited e(litFile(), [](Appearance& a) { a.lights[1].intensity = {0.3F, 1e-3F, 123.456F}; });
  EXPECT_EQ(e.copy.filename(), "a-edited.glb");
  EXPECT_EQ(e.changes(), (std::vector<std::string>{"/extensions/KHR_lights_punctual/lights/0/color/0",
                                                   "/extensions/KHR_lights_punctual/lights/0/color/1",
                                                   "/extensions/KHR_lights_punctual/lights/0/color/2",
                                                   "/extensions/KHR_lights_punctual/lights/0/intensity"}));
  std::ifstream a(e.file, std::ios::binary), b(e.copy, std::ios::binary);
  const std::string was{std::istreambuf_iterator<char>(a), {}}, is{std::istreambuf_iterator<char>(b), {}};
  const std::size_t binary = was.find(std::string("BIN\0", 4)) - 4;
  EXPECT_EQ(was.substr(binary), is.substr(is.find(std::string("BIN\0", 4)) - 4));
}

/// Of specular-glossiness: what it has no number for is refused.
TEST(EditedCopy, AGlossyMaterialKeepsItsExtension) {
  GltfBuilder b = litFile();
  b.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
      {"diffuseFactor", {0.5, 0.5, 0.5, 1}}, {"specularFactor", {0.2, 0.3, 0.4}}, {"glossinessFactor", 0.6}};
  const Edited e(b, [](Appearance& a) {
    a.materials[0].baseColor = {0.1F, 0.2F, 0.7F, 1};
    a.materials[0].roughness = 0.3F;
    a.materials[0].emission = {0, 0.5F, 0};
  });
  const Json material = jsonOf(e.copy)["materials"][0];
  EXPECT_EQ(material["pbrMetallicRoughness"], jsonOf(e.file)["materials"][0]["pbrMetallicRoughness"]);
  EXPECT_EQ(material["extensions"]["VENDOR_thing"]["x"], 1);
  try {
    const Edited refused(b, [](Appearance& a) { a.materials[0].metallic = 0.5F; });
    ADD_FAILURE() << "it was written";
  } catch (const InputError& error) {
    EXPECT_NE(
        std::string(error.what()).find("\"clay\" is of KHR_materials_pbrSpecularGlossiness, which has no"),
        std::string::npos)
        << error.what();
  }
}

TEST(EditedCopy, ALightThatIsOffKeepsItsColour) {
  const Edited e(litFile(), [](Appearance& a) { a.lights[1].intensity = glm::vec3(0.0F); });
  EXPECT_EQ(e.changes(), (std::vector<std::string>{"/extensions/KHR_lights_punctual/lights/0/intensity"}));
}

TEST(EditedCopy, ALightIsMovedInItsParentsFrame) {
  for (const glm::vec3& place : {glm::vec3(0.1F, 0.2F, 0.3F), glm::vec3(-7.77F, 1e4F, 1e-3F)}) {
    const Edited e(litFile(), [&](Appearance& a) { a.lights[1].position = place; });
    for (const std::string& path : e.changes())
      EXPECT_TRUE(path.starts_with("/nodes/2/translation/")) << path;
  }
}

/// Unit vectors rounded to floats: along the axes, between them, with components that hardly count, and some
/// that round elsewhere when they are brought to unit length again.
std::vector<glm::vec3> directions() {
  std::vector<glm::vec3> all;
  for (const glm::dvec3& v : {glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1), glm::dvec3(3, -4, 0),
                              glm::dvec3(1, 2, 3), glm::dvec3(-1e-9, -0.3, -0.9), glm::dvec3(3e-5, -7, 1)})
    all.emplace_back(glm::normalize(v));
  for (const int i : {1, 2, 3, 4, 5, 6, 7, 8, 51, 60, 89, 280})
    all.emplace_back(glm::normalize(glm::dvec3(std::sin(7.1 * i), std::sin(3.3 * i), std::cos(5.7 * i))));
  return all;
}

TEST(EditedCopy, SomeDirectionsRoundElsewhere) {
  std::size_t elsewhere = 0;
  for (const glm::vec3& v : directions()) elsewhere += glm::vec3(glm::normalize(glm::dvec3(v))) != v;
  EXPECT_GE(elsewhere, 3U) << "else the tests below would not see that the copy minds it";
}

/// Light 0 hangs on a mesh, 2 on a node with a rotation, 3 and 4 on ones with matrices.
TEST(EditedCopy, ALightIsTurned) {
  for (const glm::vec3& direction : directions()) {
    const Edited e(litFile(), [&](Appearance& a) {
      for (const std::size_t i : {0U, 2U, 3U, 4U}) a.lights[i].direction = direction;
      a.lights[4].position = {0.5F, 0.25F, -4.0F};
    });
    EXPECT_EQ(e.again.positions, e.scene.positions) << "its mesh stays";
    EXPECT_FALSE(jsonOf(e.copy).contains("animations"));
  }
}

/// A turn and a scale above it leave no 0 as it is.
TEST(EditedCopy, ALightIsTurnedInItsParentsFrame) {
  GltfBuilder b = litFile();
  b.json["nodes"][2]["extensions"] = lightOf(1);
  for (const glm::vec3& direction : directions()) {
    if (std::min({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)}) < 1e-6F) continue;
    const Edited e(b, [&](Appearance& a) { a.lights[1].direction = direction; });
    for (const std::string& path : e.changes()) EXPECT_TRUE(path.starts_with("/nodes/2/")) << path;
    EXPECT_EQ(e.again.lights[1].position, e.scene.lights[1].position);
  }
}

/// glTF 2.0, 3.5.3: no matrix where an animation turns or moves the node.
TEST(EditedCopy, AnAnimatedLightIsTurnedBelowItsNode) {
  GltfBuilder b = litFile();
  const int times = b.floats("SCALAR", 1, {0, 1});
  const int turns = b.floats("VEC4", 4, {0, 0, 0, 1, 0, 0, 0, 1});
  b.json["animations"] =
      Json::array({{{"samplers", {{{"input", times}, {"output", turns}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 4}, {"path", "rotation"}}}}}}}});
  const Edited e(b, [](Appearance& a) { a.lights[2].direction = directions()[3]; });
  const Json nodes = jsonOf(e.copy)["nodes"];
  EXPECT_EQ(nodes[4]["rotation"], b.json["nodes"][4]["rotation"]);
  EXPECT_FALSE(nodes[4].contains("matrix"));
  EXPECT_EQ(nodes[4]["children"], Json::array({nodes.size() - 1}));
}

TEST(EditedCopy, AMeshStaysWhereItsLightLeaves) {
  const Edited e(litFile(), [](Appearance& a) { a.lights[0].position = {3, 2, 1}; });
  EXPECT_EQ(e.again.positions, e.scene.positions);
  EXPECT_EQ(jsonOf(e.copy)["nodes"][0]["name"], "lamp and mesh");
}

TEST(EditedCopy, AMatrixIsMovedAsOne) {
  const Edited e(litFile(), [](Appearance& a) { a.lights[4].position = {0.5F, 0.25F, -4.0F}; });
  for (const std::string& path : e.changes()) EXPECT_TRUE(path.starts_with("/nodes/6/matrix/1")) << path;
}

TEST(EditedCopy, OfTwoThatShareALightOneChanges) {
  const Edited e(litFile(), [](Appearance& a) {
    a.lights[0].intensity = {5, 6, 7};
    a.lights[0].innerConeAngle = 0.1F, a.lights[0].outerConeAngle = 1.1F;
    a.lights[3].intensity = {1, 2, 3};
  });
  EXPECT_EQ(jsonOf(e.copy)["extensions"][kPunctual]["lights"].size(), 5U);
}

TEST(EditedCopy, MaterialsChangeTheirFactors) {
  const Edited e(litFile(), [](Appearance& a) {
    Material& m = a.materials[0];
    m.baseColor = {0.1F, 0.7F, 1.0F, 1.0F};
    m.metallic = 0.3F, m.roughness = 0.05F, m.transmission = 0.9F, m.ior = 1.33F;
    m.emission = {0.1F, 7.3F, 12345.678F};
  });
  const Json m = jsonOf(e.copy)["materials"][0];
  EXPECT_EQ(m["extras"], (Json{{"keep", "me"}}));
  EXPECT_EQ(m["extensions"]["VENDOR_thing"], (Json{{"x", 1}}));
  for (const auto& factor : m["emissiveFactor"]) EXPECT_LE(factor.get<double>(), 1.0);
  const Json used = jsonOf(e.copy)["extensionsUsed"];
  for (const char* name :
       {"KHR_materials_transmission", "KHR_materials_ior", "KHR_materials_emissive_strength", "VENDOR_thing"})
    EXPECT_NE(std::find(used.begin(), used.end(), name), used.end()) << name;
}

TEST(EditedCopy, AGlowThatWasStrongMayBecomeWeak) {
  GltfBuilder b = litFile();
  b.json["materials"][0]["emissiveFactor"] = {1, 1, 1};
  b.json["materials"][0]["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", 40}};
  const Edited e(b, [](Appearance& a) { a.materials[0].emission = {0.25F, 0.5F, 0.1F}; });
}

TEST(EditedCopy, TheDefaultMaterialBecomesARealOne) {
  const Edited e(litFile(), [](Appearance& a) { a.materials[1].roughness = 0.25F; });
  EXPECT_EQ(jsonOf(e.copy)["materials"].size(), 2U);
}

TEST(EditedCopy, StudioLightsBecomeReal) {
  GltfBuilder b;
  b.node({{"mesh", b.triangleMesh()}});
  const TemporaryFolder folder;
  const auto file = folder.write("a.glb", b.glb());
  const Scene scene = read(file);
  ASSERT_TRUE(scene.hasStudioLights);
  const Appearance before = appearanceOf(scene);
  Appearance after = before;
  after.lights[0].intensity = {9, 8, 7};
  const Scene again = read(writeEditedCopy({file, {}, scene.origin, before, after}, {}));
  EXPECT_FALSE(again.hasStudioLights);
  ASSERT_EQ(again.lights.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(again.lights[i].intensity, after.lights[i].intensity);
    EXPECT_EQ(again.lights[i].castsShadows, after.lights[i].castsShadows);
    EXPECT_EQ(again.lights[i].direction, after.lights[i].direction);
  }
}

/// Lights that stand for what glows and for the sky are of options, not of files.
TEST(EditedCopy, LightsThatStandForOthersAreNotWritten) {
  GltfBuilder b;
  b.node({{"mesh", b.triangleMesh()}});
  const TemporaryFolder folder;
  const auto file = folder.write("a.glb", b.glb());
  Scene scene = read(file);
  for (const LightKind kind : {LightKind::Surface, LightKind::Sky}) {
    scene.lights.emplace_back();
    scene.lights.back().kind = kind;
  }
  const Appearance before = appearanceOf(scene);
  Appearance after = before;
  for (Light& light : after.lights) light.intensity = {9, 8, 7};
  EXPECT_EQ(read(writeEditedCopy({file, {}, scene.origin, before, after}, {})).lights.size(), 3U)
      << "the studio";
}

TEST(EditedCopy, NamesAreNeverTakenAndResourcesAreStillFound) {
  GltfBuilder b = litFile();
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "other");
  folder.write("b %1.bin", b.binary);
  b.json["buffers"] = Json::array({{{"byteLength", b.binary.size()}, {"uri", "b%20%251.bin"}}});
  const auto file = folder.write("ä.gltf", b.json.dump());
  const Scene scene = read(file);
  const Appearance before = appearanceOf(scene);
  Appearance after = before;
  after.materials[0].metallic = 0.5F;
  const EditedScene edited{file, {}, scene.origin, before, after};
  EXPECT_EQ(writeEditedCopy(edited, {}).filename(), "ä-edited.gltf");
  EXPECT_EQ(writeEditedCopy(edited, {}).filename(), "ä-edited-2.gltf");
  EXPECT_EQ(writeEditedCopy(edited, file).filename(), "ä-2.gltf");
  EXPECT_EQ(writeEditedCopy(edited, folder.path() / "c.glb").filename(), "c.gltf");
  EXPECT_EQ(jsonOf(folder.path() / "c.gltf")["buffers"], b.json["buffers"]);
  const auto moved = writeEditedCopy(edited, folder.path() / "other" / "d");
  EXPECT_EQ(jsonOf(moved)["buffers"][0]["uri"], "../b%20%251.bin");
  EXPECT_EQ(read(moved).materials[0].metallic, 0.5F);
}

TEST(EditedCopy, WhatCannotBeWrittenIsSaidAndLeavesNothing) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.glb", litFile().glb());
  const Scene scene = read(file);
  const Appearance before = appearanceOf(scene);
  EXPECT_THROW(writeEditedCopy({file, {}, scene.origin, before, before}, {}), InputError);
  Appearance after = before;
  after.lights[0].intensity *= 2.0F;
  EXPECT_ANY_THROW(
      writeEditedCopy({file, {}, scene.origin, before, after}, folder.path() / "none" / "a.glb"));
  folder.write("a.glb", GltfBuilder().glb());
  EXPECT_THROW(writeEditedCopy({file, {}, scene.origin, before, after}, {}), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a-edited.glb"));
}

}  // namespace
}  // namespace whittle
