// Extensions that a file asks for: those that are not read, and images beside those of a texture.
#include <gtest/gtest.h>

#include "gltf/grid.h"

namespace whittle {
namespace {

using test::expectMentions;
using test::GltfBuilder;
using test::mentions;

GltfBuilder needing(const char* extension) {
  GltfBuilder b;
  b.json["extensionsRequired"] = b.json["extensionsUsed"] = {extension};
  b.node({{"mesh", b.triangleMesh()}});
  return b;
}

TEST(GltfRequired, WhatOnlyChangesTheLookIsAWarning) {
  for (const char* extension : {"KHR_materials_volume_scatter", "KHR_materials_of_tomorrow"}) {
    GltfBuilder b = needing(extension);
    EXPECT_EQ(b.load().triangles.size(), 1U);
    EXPECT_TRUE(
        mentions(b.notices.warnings, std::string("needs \"") + extension + "\", which is not drawn: "));
    EXPECT_FALSE(mentions(b.notices.notes, extension)) << "said twice";
  }
  GltfBuilder b = needing("EXT_something_else");
  expectMentions(b.error(), "needs EXT_something_else, which Whittle does not read");
}

TEST(GltfRequired, TexturesOfOtherFormatsWithAnImageBesideThem) {
  const std::string png = test::pngBytes();
  GltfBuilder b = needing("KHR_texture_basisu");
  b.push("images", {{"bufferView", b.view(std::vector<char>(png.begin(), png.end()))}});
  b.push("textures", {{"source", 0}, {"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}});
  b.load();
  EXPECT_TRUE(mentions(b.notices.warnings, "textures are those beside them"));
  b.json["textures"][0].erase("source");
  expectMentions(b.error(),
                 "its textures are KTX2 (KHR_texture_basisu): gltf-transform ktxdecompress IN OUT");
}

TEST(GltfRequired, SplatsAreNoSurfaces) {
  GltfBuilder b = needing("KHR_gaussian_splatting");
  expectMentions(b.error(), "Gaussian splats, which are no surfaces");
}

TEST(GltfWebp, TheImageOfTheExtensionOrTheOneBesideIt) {
  const std::string png = test::pngBytes();
  GltfBuilder b;
  const auto image = [&](const char* name) {
    return b.push("images",
                  {{"bufferView", b.view(std::vector<char>(png.begin(), png.end()))}, {"name", name}});
  };
  const int plain = image("plain"), other = image("other");
  b.push("textures", {{"source", plain}, {"extensions", {{"EXT_texture_webp", {{"source", other}}}}}});
  b.material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  b.node({{"mesh",
           b.triangleMesh({{"material", 0}, {"attributes", {{"TEXCOORD_0", b.vec2({0, 1, 1, 1, 0, 0})}}}})}});
  b.json["extensionsRequired"] = {"EXT_texture_webp"};
  const Scene scene = b.load();
  ASSERT_EQ(scene.images.size(), 1U);
  EXPECT_EQ(scene.images[0].name, canDecodeWebp() ? "other" : "plain");
  b.json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 17;
  EXPECT_EQ(b.load().images.at(0).name, "plain") << "an image that is not there";
}

}  // namespace
}  // namespace whittle
