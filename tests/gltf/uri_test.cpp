// URIs of images and buffers: names on disk, escapes, queries, schemes, backslashes.
#include "gltf/uri.h"

#include <gtest/gtest.h>

#include "gltf/builder.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;
using gltf::resolveUri;
using test::GltfBuilder;
using test::Json;
using test::mentions;
using test::TemporaryFolder;

/// `uri` with FOLDER in the place of the folder's path.
std::string within(const TemporaryFolder& folder, std::string uri) {
  const auto mark = uri.find("FOLDER");
  return mark == std::string::npos ? uri : uri.replace(mark, 6, folder.path().string());
}

/// Loads a triangle whose image has this URI while `file` lies beside it. The warnings.
std::vector<std::string> drawn(const std::string& uri, const std::string& file) {
  SCOPED_TRACE(uri);
  const TemporaryFolder folder;
  fs::create_directories((folder.path() / file).parent_path());
  folder.write(file, test::pngBytes());
  GltfBuilder b;
  b.push("images", {{"uri", within(folder, uri)}});
  b.push("textures", {{"source", 0}});
  b.material({{"emissiveTexture", {{"index", 0}}}});
  b.node({{"mesh",
           b.triangleMesh({{"material", 0}, {"attributes", {{"TEXCOORD_0", b.vec2({0, 0, 1, 0, 0, 1})}}}})}});
  Notices notices;
  const Scene scene = loadGltf(folder.write("scene.glb", b.glb()), {}, notices);
  EXPECT_TRUE(scene.materials.at(0).emissionTexture.used());
  EXPECT_EQ(scene.images.size(), 1U);
  return notices.warnings;
}

TEST(GltfUri, NamesOnDiskMayHoldAnything) {
  for (const auto& [uri, file] : {std::pair("a.png", "a.png"),
                                  {"a%20b.png", "a b.png"},
                                  {"a b.png", "a b.png"},
                                  {"a%20b.png", "a%20b.png"},
                                  {"100%.png", "100%.png"},
                                  {"50%25.png", "50%.png"},
                                  {"what?.png", "what?.png"},
                                  {"no#1.png", "no#1.png"},
                                  {"a%3Fb%23c.png", "a?b#c.png"},
                                  {"%C3%A4.png", "\xC3\xA4.png"},
                                  {"t/../t/./a.png", "t/a.png"},
                                  {"t%2Fa.png", "t/a.png"},
                                  {"t\\a.png", "t\\a.png"}}) {
    EXPECT_TRUE(drawn(uri, file).empty()) << uri;
  }
}

TEST(GltfUri, QueriesAndFragmentsAreNotPartOfTheName) {
  for (const auto& [uri, file] : {std::pair("a.png?v=2", "a.png"),
                                  {"a.png#top", "a.png"},
                                  {"t/a.png?v=2#top", "t/a.png"},
                                  {"a%20b.png?v=%20", "a b.png"},
                                  {"a%20b.png?v", "a%20b.png"},
                                  {"a.png?", "a.png"}}) {
    EXPECT_TRUE(drawn(uri, file).empty()) << uri;
  }
}

TEST(GltfUri, FileSchemes) {
  for (const char* uri : {"file://FOLDER/t/a.png", "FILE://FOLDER/t/a.png", "file://localhostFOLDER/t/a.png",
                          "file://LocalHostFOLDER/t/a.png?v=1", "file:FOLDER/t/a.png", "file:t/a.png",
                          "File://t/a.png", "FOLDER/t/a.png"}) {
    EXPECT_TRUE(drawn(uri, "t/a.png").empty()) << uri;
  }
}

TEST(GltfUri, BackslashesAreReadAsSlashesWithAWarning) {
  for (const auto& [uri, file] : {std::pair("t\\a.png", "t/a.png"),
                                  {"t%5Ca.png", "t/a.png"},
                                  {".\\t\\u\\a%20b.png?v=2", "t/u/a b.png"}}) {
    const auto warnings = drawn(uri, file);
    EXPECT_EQ(warnings.size(), 1U) << uri;
    EXPECT_TRUE(mentions(warnings, "has backslashes; they are read as slashes")) << uri;
  }
}

TEST(GltfUri, TheMostLiteralReadingWins) {
  const TemporaryFolder folder;
  const auto expectReadings = [&](const std::string& uri, const std::vector<std::string>& names) {
    for (auto name = names.rbegin(); name != names.rend(); ++name) {  // the likeliest arrives last
      folder.write(*name, "x");
      EXPECT_EQ(resolveUri(folder.path(), uri).path, folder.path() / *name) << uri;
    }
  };
  expectReadings("a%20b.png?x%20y", {"a b.png?x y", "a%20b.png?x%20y", "a b.png", "a%20b.png"});
  expectReadings("file:c#d", {"file:c#d", "c#d", "c"});
  EXPECT_EQ(resolveUri(folder.path(), "file:none?x").path, folder.path() / "none?x") << "none is there";
  EXPECT_EQ(resolveUri(folder.path(), "?x").path, folder.path() / "?x") << "not the folder";
}

TEST(GltfUri, BuffersAreFoundInTheSameWays) {
  const TemporaryFolder folder;
  GltfBuilder b;
  b.node({{"mesh", b.triangleMesh()}});
  fs::create_directories(folder.path() / "t");
  folder.write("t/a.bin", b.binary);
  const auto load = [&](const std::string& uri) {
    SCOPED_TRACE(uri);
    b.json["buffers"] = Json::array({{{"byteLength", 36}, {"uri", within(folder, uri)}}});
    b.notices = {};
    EXPECT_EQ(loadGltf(folder.write("a.gltf", b.json.dump()), {}, b.notices).triangles.size(), 1U);
    return b.notices.warnings.size();
  };
  EXPECT_EQ(load("t/a.bin?v=2"), 0U);
  EXPECT_EQ(load("FILE://FOLDER/t/a.bin"), 0U);
  EXPECT_EQ(load("t\\a.bin"), 1U);
  EXPECT_EQ(load("DATA:application/octet-stream;BASE64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"),
            0U);
}

}  // namespace
}  // namespace whittle
