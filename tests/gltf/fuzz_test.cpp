// Every value of a file with every feature replaced by every kind of nonsense, and bytes turned over at
// random: the loader ends in a scene or in one line. Most telling in a build with sanitizers.
#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "gltf/builder.h"
#include "support/mutation.h"

namespace whittle {
namespace {

using test::GltfBuilder;
using test::Json;

/// An animation, a skin, a morph target, sparse values, instances, a texture with transform and sampler,
/// lights, cameras, variants, glossiness, other images of textures, visibility, properties by pointer.
GltfBuilder everything() {
  GltfBuilder b;
  b.json["extensionsUsed"] = {"KHR_texture_transform", "EXT_mesh_gpu_instancing", "KHR_lights_punctual"};
  b.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "spot"},
                                                                        {"color", {1, 1, 1}},
                                                                        {"range", 2},
                                                                        {"spot", {{"innerConeAngle", 0.1}}},
                                                                        {"extras", Json::object()}}});
  b.push("images", {{"uri", "data:image/png;base64,AAAA"}, {"name", "i"}});
  b.push("images", {{"uri", "FILE:t\\%20?a#b"}});
  const std::string png = test::pngBytes();
  b.push("images", {{"bufferView", b.view(std::vector<char>(png.begin(), png.end()))}});
  b.push("samplers", {{"wrapS", 33071}, {"magFilter", 9728}});
  for (int i = 0; i < 3; ++i) b.push("textures", {{"source", i}, {"sampler", 0}});
  const Json transform{
      {"KHR_texture_transform", {{"offset", {0, 1}}, {"rotation", 1}, {"scale", {1, 2}}, {"texCoord", 1}}}};
  b.material(
      {{"name", "m"},
       {"pbrMetallicRoughness",
        {{"baseColorFactor", {1, 1, 1, 1}}, {"baseColorTexture", {{"index", 0}, {"extensions", transform}}}}},
       {"normalTexture", {{"index", 2}, {"scale", 1}, {"extensions", transform}}},
       {"emissiveFactor", {0, 0, 0}},
       {"emissiveTexture", {{"index", 1}}},
       {"alphaMode", "MASK"},
       {"extensions",
        {{"KHR_materials_volume",
          {{"thicknessFactor", 1}, {"attenuationDistance", 1}, {"attenuationColor", {1, 1, 1}}}},
         {"KHR_materials_specular", {{"specularColorTexture", {{"index", 0}}}}},
         {"KHR_materials_ior", {{"ior", 1.4}}}}}});
  const int positions = b.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
  b.json["accessors"][positions]["sparse"] = {
      {"count", 1},
      {"indices",
       {{"bufferView", b.view<std::uint8_t>({1})}, {"componentType", test::kUbyte}, {"byteOffset", 0}}},
      {"values", {{"bufferView", b.view<float>({2, 0, 0})}, {"byteOffset", 0}}}};
  const int joints = b.accessor(b.view(std::vector<std::uint8_t>(12, 0), 4), "VEC4", test::kUbyte, 3);
  const int weights = b.floats("VEC4", 4, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  const int colours =
      b.accessor(b.view(std::vector<std::uint16_t>(12, 9)), "VEC4", test::kUshort, 3, 0, true);
  const int mesh =
      b.push("meshes", {{"weights", {0.5}},
                        {"primitives",
                         {{{"mode", 4},
                           {"material", 0},
                           {"indices", b.indices<std::uint16_t>({0, 1, 2})},
                           {"targets", Json::array({{{"POSITION", b.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1})},
                                                     {"COLOR_0", b.vec3({1, 0, 0, 1, 0, 0, -1, 0, 0})}}})},
                           {"attributes",
                            {{"POSITION", positions},
                             {"NORMAL", b.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1})},
                             {"TANGENT", b.floats("VEC4", 4, {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1})},
                             {"TEXCOORD_0", b.vec2({0, 0, 1, 0, 0, 1})},
                             {"TEXCOORD_1", b.vec2({0, 0, 1, 0, 0, 1})},
                             {"COLOR_0", colours},
                             {"JOINTS_0", joints},
                             {"WEIGHTS_0", weights}}}}}}});
  b.json["extensions"]["KHR_materials_variants"]["variants"] = Json::array({{{"name", "v"}}});
  b.material({{"extensions",
               {{"KHR_materials_pbrSpecularGlossiness",
                 {{"diffuseFactor", {1, 1, 1, 1}}, {"specularGlossinessTexture", {{"index", 2}}}}}}}});
  b.json["meshes"][mesh]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] =
      Json::array({{{"material", 1}, {"variants", {0}}}});
  b.json["textures"][1]["extensions"]["EXT_texture_webp"]["source"] = 2;
  std::vector<float> identity(16, 0.0F);
  for (std::size_t i = 0; i < 16; i += 5) identity[i] = 1.0F;
  b.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
  b.push("cameras",
         {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 1}, {"zfar", 2}}}});
  const int joint =
      b.node({{"camera", 0}, {"translation", {1, 2, 3}}, {"rotation", {0, 0, 0, 1}}, {"scale", {1, 1, 1}}});
  b.push("skins",
         {{"joints", Json::array({joint})}, {"inverseBindMatrices", b.floats("MAT4", 16, identity)}});
  b.node({{"mesh", mesh}, {"skin", 0}, {"weights", Json::array({1})}});
  const int child = b.node({{"camera", 1}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}, false);
  b.node({{"mesh", mesh},
          {"children", Json::array({child})},
          {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
          {"extensions",
           {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", b.vec3({0, 0, 0, 1, 1, 1})}}}}}}}});
  b.push("animations",
         {{"name", "a"},
          {"samplers",
           {{{"input", b.floats("SCALAR", 1, {0, 1})}, {"output", b.vec3({0, 0, 0, 1, 1, 1})}},
            {{"input", b.floats("SCALAR", 1, {0, 1})},
             {"output",
              b.floats("VEC4", 4, {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0})},
             {"interpolation", "CUBICSPLINE"}},
            {{"input", b.floats("SCALAR", 1, {0, 1})}, {"output", b.floats("SCALAR", 1, {0, 1})}}}},
          {"channels",
           {{{"sampler", 0}, {"target", {{"node", joint}, {"path", "translation"}}}},
            {{"sampler", 1}, {"target", {{"node", joint}, {"path", "rotation"}}}},
            {{"sampler", 2}, {"target", {{"node", joint + 1}, {"path", "weights"}}}}}}});
  const auto point = [&](const char* pointer, int sampler) {
    b.json["animations"][0]["channels"].push_back(
        {{"sampler", sampler},
         {"target",
          {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}});
  };
  point("/materials/0/emissiveFactor", 0);
  point("/nodes/0/translation", 0);
  point("/meshes/0/weights/0", 2);
  point("/cameras/0/perspective/yfov", 2);
  point("/extensions/KHR_lights_punctual/lights/0/spot/innerConeAngle", 2);
  point("/materials/0/normalTexture/extensions/KHR_texture_transform/rotation", 2);
  b.node({{"mesh", b.triangleMesh({{"material", 1}})},
          {"extensions", {{"KHR_node_visibility", {{"visible", true}}}}}});
  b.json["scenes"][0]["extras"]["whittle"]["background"] = {1, 1, 1};
  b.json["buffers"] = Json::array({{{"byteLength", b.binary.size()}}});
  return b;
}

/// All values of a document, inner ones included.
void collect(const Json& json, const Json::json_pointer& here, std::vector<Json::json_pointer>& all) {
  all.push_back(here);
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) collect(value, here / key, all);
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) collect(json[i], here / i, all);
  }
}

/// True if it loads; an InputError must be one line that starts with the path.
bool loadsOrSays(const test::TemporaryFolder& folder, const std::string& content) {
  const auto path = folder.write("fuzz.glb", content);
  Notices notices;
  LoadOptions options;
  options.time = 0.5;
  try {
    OpenFile file;
    Scene scene = file.load(path, options, notices);
    file.moveTo(0.75, scene);
    return true;
  } catch (const InputError& e) {
    const std::string text = e.what();
    EXPECT_TRUE(text.starts_with(path.string() + ": ") && text.size() < 400) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return false;
  }
}

TEST(GltfFuzz, TheFileItselfIsFine) {
  GltfBuilder b = everything();
  const Scene scene = b.load();
  EXPECT_EQ(scene.triangles.size(), 4U);
  EXPECT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.cameras.size(), 2U);
}

TEST(GltfFuzz, NonsenseInTheJson) {
  const GltfBuilder whole = everything();
  std::vector<Json::json_pointer> places;
  collect(whole.json, Json::json_pointer(), places);
  ASSERT_GT(places.size(), 200U);
  const std::vector<Json> nonsense{nullptr,
                                   true,
                                   -1,
                                   0,
                                   1,
                                   3,
                                   255,
                                   2147483647,
                                   4294967296ULL,
                                   18446744073709551615ULL,
                                   1e300,
                                   -1e300,
                                   0.5,
                                   "",
                                   "text",
                                   Json::array(),
                                   Json::object(),
                                   Json::array({0}),
                                   Json::array({Json::array({Json::object()})})};
  const test::TemporaryFolder folder;
  std::size_t loaded = 0, refused = 0;
  for (const auto& place : places) {
    for (const Json& value : nonsense) {
      GltfBuilder b = whole;
      b.json[place] = value;
      if (!b.json.is_object()) continue;
      ++(loadsOrSays(folder, b.glbAsIs()) ? loaded : refused);
    }
  }
  EXPECT_GT(loaded, 500U);
  EXPECT_GT(refused, 1000U);
}

TEST(GltfFuzz, BytesTurnedOver) {
  const std::string whole = everything().glbAsIs();
  const test::TemporaryFolder folder;
  std::mt19937 random(1);
  std::size_t refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string copy = whole;
    const unsigned changes = 1 + random() % 4;
    for (unsigned k = 0; k < changes; ++k) copy[random() % copy.size()] = static_cast<char>(random() & 0xff);
    refused += loadsOrSays(folder, copy) ? 0 : 1;
  }
  EXPECT_GT(refused, 300U);
}

/// Files that need no other: our own scenes, and small ones of others where those are there.
std::vector<std::string> wholeFiles() {
  constexpr std::uintmax_t kSmall = 200'000;
  std::vector<std::string> files;
  std::vector<std::filesystem::path> paths;
  for (const char* folder : {WHITTLE_SCENES, WHITTLE_SHARED}) {
    if (!std::filesystem::is_directory(folder)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      if (entry.is_regular_file() && entry.file_size() < kSmall &&
          (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf"))
        paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  files.reserve(paths.size());
  for (const auto& path : paths) files.push_back(test::fileText(path));
  return files;
}

TEST(GltfFuzz, FilesMutated) {
  const std::vector<std::string> files = wholeFiles();
  ASSERT_GE(files.size(), 12U);
  const test::TemporaryFolder folder;
  std::mt19937 random(2);
  std::size_t loaded = 0, refused = 0;
  for (int i = 0; i < test::mutations(); ++i) {
    const std::string file = test::mutated(files[random() % files.size()], random);
    const auto begin = std::chrono::steady_clock::now();
    ++(loadsOrSays(folder, file) ? loaded : refused);
    // A hang is what this is about: a sanitizer takes its time.
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20)) << "mutation " << i;
  }
  EXPECT_GT(loaded, 0U);
  EXPECT_GT(refused, 0U);
}

}  // namespace
}  // namespace whittle
