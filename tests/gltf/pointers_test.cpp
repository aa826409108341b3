// KHR_animation_pointer: each property that is drawn half way between two keyframes, and open files that
// follow.
#include <gtest/gtest.h>

#include <cmath>

#include "gltf/pointers.h"

namespace whittle {
namespace {

using test::animate;
using test::at;
using test::channel;
using test::corner;
using test::expectNear;
using test::gallery;
using test::GltfBuilder;
using test::Json;
using test::showAtTimes;

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

}  // namespace
}  // namespace whittle
