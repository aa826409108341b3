// KHR_animation_pointer: each property that is drawn half way between two keyframes, open files that follow,
// and pointers that are wrong.
#include <gtest/gtest.h>

#include <cmath>

#include "gltf/builder.h"

namespace whittle {
namespace {

using test::corner;
using test::expectNear;
using test::GltfBuilder;
using test::Json;
using test::mentions;

/// A channel for `pointer` whose sampler has these values at 0, 2, 4, … seconds.
void channel(GltfBuilder& b, const std::string& pointer, int output, std::size_t keys,
             const char* interpolation) {
  std::vector<float> times(keys);
  for (std::size_t i = 0; i < keys; ++i) times[i] = 2 * static_cast<float>(i);
  const int input = b.floats("SCALAR", 1, times);
  b.json["accessors"][input]["max"] = {times.back()};
  if (!b.json.contains("animations"))
    b.push("animations", {{"name", "show"}, {"channels", Json::array()}, {"samplers", Json::array()}});
  Json& animation = b.json["animations"].back();
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size()},
       {"target",
        {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}});
  animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
}

void animate(GltfBuilder& b, const std::string& pointer, int components, const std::vector<float>& values,
             const char* interpolation = "LINEAR") {
  static const char* const kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  const std::size_t elements = values.size() / static_cast<std::size_t>(components);
  channel(b, pointer, b.floats(kTypes[components - 1], components, values),
          interpolation == std::string("CUBICSPLINE") ? elements / 3 : elements, interpolation);
}

/// Shown or not, at 0, 2, 4, … seconds.
void showAtTimes(GltfBuilder& b, int node, const std::vector<std::uint8_t>& shown) {
  b.json["nodes"][node]["extensions"]["KHR_node_visibility"]["visible"] = shown[0] != 0;
  const int output = b.accessor(b.view(shown), "SCALAR", test::kUbyte, shown.size());
  channel(b, "/nodes/" + std::to_string(node) + "/extensions/KHR_node_visibility/visible", output,
          shown.size(), "STEP");
}

LoadOptions at(double seconds) {
  LoadOptions options;
  options.time = seconds;
  return options;
}

/// A textured triangle with a material of every extension, two cameras and a spot light.
GltfBuilder gallery() {
  GltfBuilder b;
  b.json["extensionsRequired"] = {"KHR_animation_pointer"};
  b.json["extensions"]["KHR_lights_punctual"]["lights"] =
      Json::array({{{"type", "spot"}, {"range", 9}, {"spot", Json::object()}}});
  const std::string png = test::pngBytes();
  b.push("images", {{"bufferView", b.view(std::vector<char>(png.begin(), png.end()))}});
  b.push("textures", {{"source", 0}});
  const Json texture{{"index", 0}, {"extensions", {{"KHR_texture_transform", Json::object()}}}};
  b.material({{"alphaMode", "MASK"},
              {"pbrMetallicRoughness", {{"baseColorTexture", texture}}},
              {"normalTexture", texture},
              {"occlusionTexture", texture},
              {"emissiveFactor", {1, 1, 1}},
              {"extensions",
               {{"KHR_materials_emissive_strength", Json::object()},
                {"KHR_materials_ior", Json::object()},
                {"KHR_materials_transmission", Json::object()},
                {"KHR_materials_volume", {{"attenuationDistance", 1}}},
                {"KHR_materials_specular", Json::object()},
                {"KHR_materials_clearcoat", {{"clearcoatNormalTexture", texture}}},
                {"KHR_materials_sheen", Json::object()},
                {"KHR_materials_iridescence", Json::object()},
                {"KHR_materials_anisotropy", Json::object()}}}});
  b.node({{"mesh", b.triangleMesh({{"material", 0},
                                   {"attributes",
                                    {{"TEXCOORD_0", b.vec2({0, 0, 1, 0, 0, 1})},
                                     {"NORMAL", b.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1})}}}})}});
  b.push("cameras",
         {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}, {"aspectRatio", 1}}}});
  b.push("cameras",
         {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 1}, {"zfar", 2}}}});
  b.node({{"camera", 0}});
  b.node({{"camera", 1}});
  b.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  return b;
}

constexpr const char* kMaterial = "/materials/0/";
constexpr const char* kLight = "/extensions/KHR_lights_punctual/lights/0/";

struct Case {
  std::string pointer;
  std::vector<float> from, to;  ///< at 0 s and at 2 s
  std::function<std::vector<float>(const Scene&)> read;
  std::vector<float> half = {};  ///< at 1 s; empty: their mean
};

/// Of the material, by the rest of its pointer.
Case ofMaterial(const std::string& rest, float from, float to, float Material::*factor) {
  return {kMaterial + rest, {from}, {to}, [factor](const Scene& s) {
            return std::vector<float>{s.materials[0].*factor};
          }};
}

std::vector<float> list(const glm::vec3& v) { return {v.x, v.y, v.z}; }

std::vector<Case> materialCases() {
  using M = Material;
  const std::string e = "extensions/KHR_materials_";
  return {
      {std::string(kMaterial) + "pbrMetallicRoughness/baseColorFactor",
       {0, 0.2F, 0.4F, 1},
       {1, 0.4F, 0.8F, 0},
       [](const Scene& s) {
         const glm::vec4 c = s.materials[0].baseColor;
         return std::vector<float>{c.r, c.g, c.b, c.a};
       }},
      ofMaterial("pbrMetallicRoughness/metallicFactor", 0, 1, &M::metallic),
      ofMaterial("pbrMetallicRoughness/roughnessFactor", 0.2F, 0.6F, &M::roughness),
      ofMaterial("alphaCutoff", 0.1F, 0.3F, &M::alphaCutoff),
      ofMaterial("normalTexture/scale", 0, 3, &M::normalScale),
      ofMaterial("occlusionTexture/strength", 0, 1, &M::occlusionStrength),
      {std::string(kMaterial) + "emissiveFactor",
       {0, 0, 1},
       {1, 0, 0},
       [](const Scene& s) { return list(s.materials[0].emission); }},
      {std::string(kMaterial) + e + "emissive_strength/emissiveStrength",
       {2},
       {6},
       [](const Scene& s) { return std::vector<float>{s.materials[0].emission.g}; }},
      ofMaterial(e + "ior/ior", 1, 2, &M::ior),
      ofMaterial(e + "transmission/transmissionFactor", 0, 1, &M::transmission),
      ofMaterial(e + "specular/specularFactor", 0, 0.5F, &M::specular),
      {std::string(kMaterial) + e + "specular/specularColorFactor",
       {0, 0, 1},
       {1, 0, 0},
       [](const Scene& s) { return list(s.materials[0].specularColor); }},
      ofMaterial(e + "clearcoat/clearcoatFactor", 0, 1, &M::clearcoat),
      ofMaterial(e + "clearcoat/clearcoatRoughnessFactor", 0, 1, &M::clearcoatRoughness),
      ofMaterial(e + "clearcoat/clearcoatNormalTexture/scale", 1, 2, &M::clearcoatNormalScale),
      {std::string(kMaterial) + e + "sheen/sheenColorFactor",
       {0, 0, 1},
       {1, 0, 0},
       [](const Scene& s) { return list(s.materials[0].sheenColor); }},
      ofMaterial(e + "sheen/sheenRoughnessFactor", 0, 1, &M::sheenRoughness),
      ofMaterial(e + "iridescence/iridescenceFactor", 0, 1, &M::iridescence),
      ofMaterial(e + "iridescence/iridescenceIor", 1, 2, &M::iridescenceIor),
      ofMaterial(e + "iridescence/iridescenceThicknessMinimum", 100, 200, &M::leastThickness),
      ofMaterial(e + "iridescence/iridescenceThicknessMaximum", 300, 500, &M::mostThickness),
      ofMaterial(e + "anisotropy/anisotropyStrength", 0, 1, &M::anisotropy),
      ofMaterial(e + "anisotropy/anisotropyRotation", 0, 3, &M::anisotropyRotation),
      {std::string(kMaterial) + e + "volume/thicknessFactor",
       {0},
       {1},
       [](const Scene& s) { return std::vector<float>{s.materials[0].volume ? 1.0F : 0.0F}; },
       {1}},
  };
}

std::vector<Case> otherCases() {
  const auto cone = [](float Light::*angle) {
    return [angle](const Scene& s) { return std::vector<float>{s.lights[0].*angle}; };
  };
  const auto lens = [](std::size_t camera, float Camera::*number) {
    return [camera, number](const Scene& s) { return std::vector<float>{s.cameras[camera].*number}; };
  };
  const auto laid = [](const Scene& s) {
    const auto& t = s.materials[0].baseColorTexture.transform;
    return std::vector<float>(t.begin(), t.end());
  };
  const std::string transform =
      std::string(kMaterial) + "pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/";
  const auto c = static_cast<float>(std::cos(0.5)), s = static_cast<float>(std::sin(0.5));
  return {
      {std::string(kLight) + "color",
       {0, 0, 1},
       {1, 0, 0},
       [](const Scene& scene) { return list(scene.lights[0].intensity); }},
      {std::string(kLight) + "intensity",
       {2},
       {6},
       [](const Scene& scene) { return std::vector<float>{scene.lights[0].intensity.g}; }},
      {std::string(kLight) + "range", {2}, {4}, cone(&Light::range)},
      {std::string(kLight) + "spot/innerConeAngle", {0}, {0.5F}, cone(&Light::innerConeAngle)},
      {std::string(kLight) + "spot/outerConeAngle", {1}, {1.5F}, cone(&Light::outerConeAngle)},
      {"/cameras/0/perspective/yfov", {0.5F}, {1}, lens(0, &Camera::yfov)},
      {"/cameras/0/perspective/znear", {0.5F}, {1}, lens(0, &Camera::znear)},
      {"/cameras/0/perspective/aspectRatio", {1}, {2}, lens(0, &Camera::aspect)},
      {"/cameras/1/orthographic/ymag", {1}, {3}, lens(1, &Camera::ymag)},
      {"/cameras/1/orthographic/xmag", {1}, {3}, lens(1, &Camera::aspect)},  // over a ymag of 1
      {"/cameras/1/orthographic/zfar", {3}, {5}, lens(1, &Camera::zfar)},
      {transform + "offset", {0, 0}, {0.5F, 1}, laid, {1, 0, 0.25F, 0, 1, 0.5F}},
      {transform + "scale", {1, 1}, {3, 5}, laid, {2, 0, 0, 0, 3, 0}},
      {transform + "rotation", {0}, {1}, laid, {c, s, 0, -s, c, 0}},
  };
}

std::vector<Case> allCases() {
  std::vector<Case> all = materialCases();
  for (Case& c : otherCases()) all.push_back(std::move(c));
  return all;
}

void expectHalf(const Case& c, const Scene& scene) {
  const std::vector<float> is = c.read(scene);
  ASSERT_EQ(is.size(), c.half.empty() ? c.from.size() : c.half.size());
  for (std::size_t i = 0; i < is.size(); ++i)
    EXPECT_NEAR(is[i], c.half.empty() ? (c.from[i] + c.to[i]) / 2 : c.half[i],
                1e-6F * std::abs(is[i]) + 1e-7F)
        << c.pointer << i;
}

TEST(GltfPointers, EachPropertyHalfWay) {
  for (const Case& c : allCases()) {
    SCOPED_TRACE(c.pointer);
    GltfBuilder b = gallery();
    std::vector<float> values = c.from;
    values.insert(values.end(), c.to.begin(), c.to.end());
    animate(b, c.pointer, static_cast<int>(c.from.size()), values);
    const Scene scene = b.load(at(1));
    expectHalf(c, scene);
    EXPECT_TRUE(b.notices.warnings.empty()) << b.notices.warnings[0];
    EXPECT_EQ(scene.animations[0].pointers, 1U);
    // And so where the file is open, and a picture of another time was drawn before.
    const test::TemporaryFolder folder;
    Notices notices;
    OpenFile open;
    Scene film = open.load(folder.write("scene.glb", b.glb()), at(0), notices);
    EXPECT_TRUE(open.moves());
    open.moveTo(1, film);
    expectHalf(c, film);
    EXPECT_EQ(film.tangents, scene.tangents);
    EXPECT_EQ(film.materials[0].normalTexture.image, 0);
  }
}

/// Tangents are made along textures as they lie at that time, and where facets lie along them they are there.
TEST(GltfPointers, TangentsFollow) {
  for (const std::string pointer : {"normalTexture/extensions/KHR_texture_transform/rotation",
                                    "extensions/KHR_materials_anisotropy/anisotropyStrength"}) {
    GltfBuilder b = gallery();
    Json& material = b.json["materials"][0];
    if (pointer.starts_with("ext")) {  // which then alone asks for tangents
      material.erase("normalTexture");
      material["extensions"].erase("KHR_materials_clearcoat");
    }
    animate(b, kMaterial + pointer, 1, {0, 1});
    const test::TemporaryFolder folder;
    Notices notices;
    OpenFile open;
    Scene film = open.load(folder.write("scene.glb", b.glb()), at(0), notices);
    const auto before = film.tangents;
    EXPECT_TRUE(film.meshesMove);
    open.moveTo(1, film);
    EXPECT_FALSE(film.tangents.empty()) << pointer;
    EXPECT_NE(film.tangents, before) << pointer;
    EXPECT_EQ(film.tangents, b.load(at(1)).tangents) << pointer;
  }
}

TEST(GltfPointers, AllInterpolations) {
  const auto metallicAt = [](const char* interpolation, const std::vector<float>& values, double seconds) {
    GltfBuilder b = gallery();
    animate(b, "/materials/0/pbrMetallicRoughness/metallicFactor", 1, values, interpolation);
    return b.load(at(seconds)).materials[0].metallic;
  };
  EXPECT_EQ(metallicAt("STEP", {0.25F, 0.75F}, 1.99), 0.25F);
  EXPECT_EQ(metallicAt("STEP", {0.25F, 0.75F}, 2), 0.75F);
  EXPECT_EQ(metallicAt("LINEAR", {0.25F, 0.75F}, 1.5), 0.625F);
  // f(t) = t²/4 of slopes 0 and 1 is its own spline.
  EXPECT_NEAR(metallicAt("CUBICSPLINE", {0, 0, 0, 1, 1, 0}, 1.5), 1.5 * 1.5 / 4, 1e-7);
}

TEST(GltfPointers, IntegersAreNumbers) {
  GltfBuilder b = gallery();
  channel(b, "/extensions/KHR_lights_punctual/lights/0/intensity",
          b.accessor(b.view<std::uint16_t>({100, 300}), "SCALAR", test::kUshort, 2), 2, "LINEAR");
  EXPECT_EQ(b.load(at(1)).lights[0].intensity.r, 200.0F);
  b.json["accessors"][b.json["animations"][0]["samplers"][0]["output"].get<int>()]["normalized"] = true;
  EXPECT_NEAR(b.load(at(1)).lights[0].intensity.r, 200.0 / 65535, 1e-9);
}

/// A pointer to a node's property is the channel of that node.
TEST(GltfPointers, NodesMeshesAndTheirWeights) {
  GltfBuilder b;
  const Json targets{{"targets",
                      {{{"POSITION", b.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1})}},
                       {{"POSITION", b.vec3({0, 1, 0, 0, 1, 0, 0, 1, 0})}}}}};
  const int mesh = b.triangleMesh(targets);
  b.node({{"mesh", mesh}, {"translation", {9, 9, 9}}});
  b.json["meshes"][mesh]["weights"] = {0, 4};
  const float r = std::sqrt(0.5F);
  animate(b, "/nodes/0/translation", 3, {0, 0, 0, 2, 4, 6});
  animate(b, "/nodes/0/rotation", 4, {0, 0, 0, 1, 0, 0, r, r});  // a quarter turn about Z
  animate(b, "/nodes/0/scale", 3, {1, 1, 1, 3, 3, 3});
  animate(b, "/nodes/0/weights/0", 1, {0, 1});
  // (0,0,0) goes to (0, 4, 0.5) by its weights, twice as far from there, turned by 45°, and to (1, 2, 3).
  const auto half = static_cast<float>(4 * std::sqrt(2.0));
  expectNear(corner(b.load(at(1)), 0, 0), {1 - half, 2 + half, 4}, 1e-6F);
  GltfBuilder other = b;
  other.json["animations"][0]["channels"].erase(3);
  const auto weightsBy = [&](const char* pointer, const std::vector<float>& values) {
    GltfBuilder one = other;
    channel(one, pointer, one.floats("SCALAR", 1, values), 2, "LINEAR");
    return corner(one.load(at(1)), 0, 0).z;
  };
  EXPECT_NEAR(weightsBy("/nodes/0/weights", {0, 4, 1, 4}), 4, 1e-6);
  EXPECT_NEAR(weightsBy("/meshes/0/weights", {0, 4, 1, 4}), 4, 1e-6);
  EXPECT_NEAR(weightsBy("/meshes/0/weights/0", {0, 1}), 4, 1e-6);
}

/// What comes later is read at the start, its textures too, and what hangs on it comes with it.
TEST(GltfPointers, NodesComeAndGo) {
  GltfBuilder b = gallery();
  const int parent = b.node({{"children", {0}}});
  b.json["scenes"][0]["nodes"].erase(0);
  showAtTimes(b, parent, {0, 1, 0});
  const test::TemporaryFolder folder;
  Notices notices;
  OpenFile open;
  Scene scene = open.load(folder.write("scene.glb", b.glb()), at(0), notices);
  EXPECT_TRUE(scene.triangles.empty());
  EXPECT_TRUE(scene.meshesMove);
  EXPECT_EQ(scene.images.size(), 1U);
  for (const double seconds : {1.99, 2.0, 3.9, 4.0}) {
    open.moveTo(seconds, scene);
    const Scene anew = b.load(at(seconds));
    EXPECT_EQ(scene.triangles.size(), seconds < 2 || seconds >= 4 ? 0U : 1U) << seconds;
    EXPECT_EQ(scene.positions, anew.positions) << seconds;
    EXPECT_EQ(scene.uv0, anew.uv0) << seconds;
  }
}

TEST(GltfPointers, WhatIsNotThereIsSaidOnceByName) {
  const auto warned = [](const std::vector<std::string>& pointers) {
    GltfBuilder b = gallery();
    for (const std::string& pointer : pointers) animate(b, pointer, 1, {0, 1});
    b.load(at(1));
    EXPECT_EQ(b.notices.warnings.size(), 1U);
    return b.notices.warnings.empty() ? "" : b.notices.warnings[0];
  };
  EXPECT_EQ(
      warned({"/materials/0/extensions/KHR_materials_fur/length"}),
      "animations[0] \"show\" does not move /materials/0/extensions/KHR_materials_fur/length (unknown)");
  for (const char* absent :
       {"/materials/9/alphaCutoff", "/materials/00/alphaCutoff", "/materials/-1/alphaCutoff",
        "/nodes/99/translation", "/meshes/1/weights", "/meshes/0/weights/0", "/cameras/0/orthographic/xmag",
        "/cameras/0/perspective/zfar",
        "/materials/0/emissiveTexture/extensions/KHR_texture_transform/rotation",
        "/extensions/KHR_lights_punctual/lights/1/intensity"})
    EXPECT_EQ(warned({absent}),
              std::string("animations[0] \"show\" does not move ") + absent + " (not in the file)");
  for (const char* unknown :
       {"", "/", "//", "nodes/0/scale", "/nodes/0", "/nodes/0/", "/nodes/0/matrix", "/nodes/0/translation/0",
        "/materials/0/name", "/materials/0/doubleSided", "/materials/0/emissiveFactor/0",
        "/materials/0/normalTexture/index", "/materials/0/normalTexture/texCoord", "/meshes/0/primitives/0",
        "/nodes/0/extensions/KHR_node_visibility", "/scenes/0/nodes", "/~1/~0"}) {
    GltfBuilder b = gallery();
    animate(b, unknown, 1, {0, 1});
    b.load(at(1));
    const std::string name = std::string(unknown).empty() ? "nothing" : unknown;
    EXPECT_TRUE(mentions(b.notices.warnings, name + " (unknown)")) << unknown;
  }
  EXPECT_EQ(warned({"/a", "/b", "/c", "/d", "/e"}),
            "animations[0] \"show\" does not move /a (unknown), /b (unknown), /c (unknown) and 2 more");
  EXPECT_LT(warned({"/" + std::string(5000, 'x')}).size(), 200U);
}

TEST(GltfPointers, WrongAccessorsAreRefused) {
  const auto refused = [](const std::string& pointer, const char* type, int components, const char* words,
                          const char* interpolation = "LINEAR") {
    GltfBuilder b = gallery();
    const std::vector<float> values(static_cast<std::size_t>(2 * components), 0.5F);
    channel(b, pointer, b.floats(type, components, values), 2, interpolation);
    const std::string line = b.error(at(1));
    EXPECT_NE(line.find(words), std::string::npos) << line;
    EXPECT_NE(line.find(pointer), std::string::npos) << line;
    EXPECT_NO_THROW(b.load()) << "at rest nobody reads it";
  };
  refused("/materials/0/alphaCutoff", "VEC3", 3, "takes SCALAR values, but its accessor has others");
  refused("/materials/0/emissiveFactor", "SCALAR", 1, "takes VEC3 values");
  refused("/materials/0/pbrMetallicRoughness/baseColorFactor", "MAT2", 4, "takes VEC4 values");
  refused("/meshes/0/weights", "VEC2", 2, "takes SCALAR values");
  refused("/nodes/0/extensions/KHR_node_visibility/visible", "SCALAR", 1, "takes unsigned bytes", "STEP");
  GltfBuilder b = gallery();
  showAtTimes(b, 0, {1, 0});
  b.json["animations"][0]["samplers"][0]["interpolation"] = "LINEAR";
  EXPECT_NE(b.error(at(1)).find("its interpolation must be STEP"), std::string::npos);
  GltfBuilder nameless = gallery();
  animate(nameless, "/x", 1, {0, 1});
  Json& e = nameless.json["animations"][0]["channels"][0]["target"]["extensions"];
  e["KHR_animation_pointer"] = Json::object();
  EXPECT_NE(nameless.error(at(1)).find("pointer is missing"), std::string::npos);
  e.clear();
  nameless.load(at(1));
  EXPECT_TRUE(mentions(nameless.notices.warnings, "does not move a pointer to nothing"));
}

}  // namespace
}  // namespace whittle
