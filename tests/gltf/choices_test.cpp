// What a file leaves to choose or to hide: variants of materials, visibility of nodes.
#include <gtest/gtest.h>

#include "gltf/grid.h"

namespace whittle {
namespace {

using test::expectMentions;
using test::GltfBuilder;
using test::Json;
using test::mentions;

/// A red, a green and a blue material; one triangle is red, or by variant green or blue, another stays red.
GltfBuilder variants() {
  GltfBuilder b;
  for (const Json& colour : {Json{1, 0, 0, 1}, Json{0, 1, 0, 1}, Json{0, 0, 1, 1}})
    b.material({{"pbrMetallicRoughness", {{"baseColorFactor", colour}}}});
  b.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "meadow"}}, {{"name", "sea"}}};
  const Json mappings{
      {"mappings", {{{"material", 1}, {"variants", {0}}}, {{"material", 2}, {"variants", {1}}}}}};
  b.node(
      {{"mesh", b.triangleMesh({{"material", 0}, {"extensions", {{"KHR_materials_variants", mappings}}}})}});
  b.node({{"mesh", b.triangleMesh({{"material", 0}})}});
  b.json["extensionsRequired"] = {"KHR_materials_variants"};
  return b;
}

glm::vec3 colourOf(const Scene& scene, std::size_t triangle) {
  return glm::vec3(scene.materials.at(scene.triangles.at(triangle).material).baseColor);
}

TEST(GltfVariants, ByNameByNumberOrNone) {
  const std::vector<std::pair<std::optional<std::string>, glm::vec3>> cases{
      {std::nullopt, {1, 0, 0}}, {"meadow", {0, 1, 0}}, {"sea", {0, 0, 1}}, {"1", {0, 0, 1}}};
  for (const auto& [name, colour] : cases) {
    GltfBuilder b = variants();
    LoadOptions options;
    options.variant = name;
    const Scene scene = b.load(options);
    EXPECT_EQ(colourOf(scene, 0), colour);
    EXPECT_EQ(colourOf(scene, 1), glm::vec3(1, 0, 0)) << "a primitive without variants";
    EXPECT_EQ(b.notices.variants, (std::vector<std::string>{"meadow", "sea"}));
    EXPECT_EQ(mentions(b.notices.notes, "--variant NAME shows one of 2 \"meadow\""), !name);
  }
}

TEST(GltfVariants, OneThatIsNotThereIsRefusedWithAList) {
  GltfBuilder b = variants();
  LoadOptions options;
  options.variant = "desert";
  expectMentions(b.error(options), "has no variant \"desert\" (it has: 0 \"meadow\", 1 \"sea\")");
  GltfBuilder none;
  none.node({{"mesh", none.triangleMesh()}});
  expectMentions(none.error(options), "has no variant \"desert\" (it has: none)");
  b.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"][0]["variants"] = {
      7};
  expectMentions(b.error(), "variants[0] is 7, but there are 2 variants");
}

TEST(GltfVisibility, HidesNodesWithAllBelowButNoCamera) {
  GltfBuilder b;
  b.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "point"}}});
  b.push("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
  const int mesh = b.triangleMesh();
  const auto child = [&](Json node) { return b.node(std::move(node), false); };
  const Json visible{{"KHR_node_visibility", {{"visible", true}}}},
      hidden{{"KHR_node_visibility", {{"visible", false}}}};
  const int below = child({{"mesh", mesh}, {"extensions", visible}});
  const int light = child({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  const int camera = child({{"camera", 0}, {"children", {light}}});
  b.node({{"mesh", mesh}, {"children", {below, camera}}, {"extensions", hidden}});
  b.node({{"mesh", mesh}, {"translation", {5, 0, 0}}, {"extensions", visible}});
  b.json["extensionsRequired"] = {"KHR_node_visibility"};
  const Scene scene = b.load();
  ASSERT_EQ(scene.triangles.size(), 1U);
  EXPECT_EQ(test::corner(scene, 0, 0).x, 5.0F);
  for (const Light& l : scene.lights) EXPECT_LT(l.node, 0) << "a light of the file, below a hidden node";
  EXPECT_EQ(scene.cameras.size(), 1U);
  EXPECT_FALSE(scene.hasOurCamera);
}

}  // namespace
}  // namespace whittle
