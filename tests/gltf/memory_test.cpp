// Small files that ask for much: the same bytes are decoded once, sums are refused before they are taken.
#include <gtest/gtest.h>

#include <array>

#include "gltf/builder.h"
#include "scene/memory_budget.h"

namespace whittle {
namespace {

using test::GltfBuilder;
using test::Json;

/// A megabyte beside what the program itself takes, and what a test adds.
std::string refusal(GltfBuilder& b, std::uint64_t megabytes, std::uint64_t triangleBytes = 0) {
  MemoryBudget budget({kProgramBytes + megabytes * 1'000'000, true});
  LoadOptions options;
  options.memory = &budget;
  options.laterTriangleBytes = triangleBytes;
  return b.error(options);
}

void expectRefusal(GltfBuilder& b, std::uint64_t megabytes, const std::string& what,
                   std::uint64_t triangleBytes = 0) {
  const std::string text = refusal(b, megabytes, triangleBytes);
  EXPECT_NE(text.find(what), std::string::npos) << text;
  EXPECT_NE(text.find("--memory-limit"), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

/// Peak of the budget after loading.
std::uint64_t peakOf(GltfBuilder& b) {
  MemoryBudget budget({std::uint64_t{1} << 50, true});
  LoadOptions options;
  options.memory = &budget;
  b.load(options);
  return budget.peak() - kProgramBytes;
}

/// The header of a PNG of 8-bit RGB, and nothing behind it.
std::string pngHeader(std::uint32_t width, std::uint32_t height) {
  const auto big = [](std::uint32_t v) {
    std::string word(4, '\0');
    for (int i = 0; i < 4; ++i) word[static_cast<std::size_t>(i)] = static_cast<char>(v >> (24 - 8 * i));
    return word;
  };
  return "\x89PNG\r\n\x1a\n" + big(13) + "IHDR" + big(width) + big(height) +
         std::string("\x08\x02\0\0\0", 5) + big(0);
}

int viewOf(GltfBuilder& b, const std::string& bytes) {
  return b.view(std::vector<char>(bytes.begin(), bytes.end()));
}

/// A triangle for each image, with a material that shows it.
void showImages(GltfBuilder& b, const std::vector<Json>& images) {
  const int uv = b.vec2({0, 0, 1, 0, 0, 1});
  for (const Json& image : images) {
    const int texture = b.push("textures", {{"source", b.push("images", image)}});
    const int material = b.material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}}});
    b.node({{"mesh", b.triangleMesh({{"material", material}, {"attributes", {{"TEXCOORD_0", uv}}}})}});
  }
}

TEST(GltfMemory, ImagesOfTheSameBytesAreDecodedOnce) {
  GltfBuilder b;
  const std::string png = test::pngBytes();
  const int view = viewOf(b, png), other = viewOf(b, png);
  // Another view of the same range is the same picture as well.
  const int alike = b.push("bufferViews", b.json["bufferViews"][static_cast<std::size_t>(view)]);
  showImages(
      b, {{{"bufferView", view}}, {{"bufferView", view}}, {{"bufferView", alike}}, {{"bufferView", other}}});
  const Scene scene = b.load();
  EXPECT_EQ(scene.images.size(), 2U);
  ASSERT_EQ(scene.materials.size(), 4U);
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(scene.materials[static_cast<std::size_t>(i)].baseColorTexture.image, 0) << i;
  EXPECT_EQ(scene.materials[3].baseColorTexture.image, 1);
}

TEST(GltfMemory, ImagesOfOneUriAreDecodedOnce) {
  constexpr const char* kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string uri = "data:image/png;base64,";
  std::string png = test::pngBytes();
  while (png.size() % 3 != 0) png += '\0';
  for (std::size_t i = 0; i < png.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return static_cast<std::uint32_t>(static_cast<unsigned char>(png[i + k]));
    };
    const std::uint32_t bits = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (int shift = 18; shift >= 0; shift -= 6) uri += kAlphabet[bits >> shift & 63U];
  }
  GltfBuilder b;
  showImages(b, {{{"uri", uri}}, {{"uri", uri}}, {{"uri", "missing.png"}}, {{"uri", "missing.png"}}});
  const Scene scene = b.load();
  EXPECT_EQ(scene.images.size(), 1U);
  EXPECT_EQ(scene.materials[0].baseColorTexture.image, 0);
  EXPECT_EQ(scene.materials[1].baseColorTexture.image, 0);
  EXPECT_EQ(scene.materials[3].baseColorTexture.image, -1);
  EXPECT_EQ(b.notices.warnings.size(), 1U) << "one warning for one file";
}

TEST(GltfMemory, ThePixelsOfAllImagesAreSummedBeforeOneIsDecoded) {
  GltfBuilder b;
  std::vector<Json> images;
  for (int i = 0; i < 20; ++i) images.push_back({{"bufferView", viewOf(b, pngHeader(1000, 1000))}});
  showImages(b, images);
  expectRefusal(b, 70, "its 20 images, 20 megapixels in all, would take 80 MB");
  MemoryBudget budget({kProgramBytes + 100'000'000, true});
  LoadOptions options;
  options.memory = &budget;
  b.load(options);
  EXPECT_EQ(b.notices.warnings.size(), 20U) << "none of them can be decoded";
}

/// A third more, once everything is loaded.
TEST(GltfMemory, SmallerLevelsOfImagesAreSummedToo) {
  GltfBuilder b;
  std::vector<Json> images;
  for (int i = 0; i < 20; ++i) images.push_back({{"bufferView", viewOf(b, pngHeader(1000, 1000))}});
  showImages(b, images);
  const auto limit = MemoryLimit{kProgramBytes + 100'000'000, true};
  MemoryBudget enough(limit), tooLittle(limit);
  LoadOptions options;
  options.memory = &enough;
  b.load(options);
  options.memory = &tooLittle;
  options.laterTextureLevels = true;
  const std::string refused = b.error(options);
  EXPECT_NE(refused.find("the smaller levels of its images would take 26.7 MB"), std::string::npos)
      << refused;
}

TEST(GltfMemory, InstancesWithoutDataAreCounted) {
  GltfBuilder b;
  const int million = b.accessor(-1, "VEC3", test::kFloat, 1'000'000);
  b.node({{"mesh", b.triangleMesh()},
          {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", million}}}}}}}});
  expectRefusal(b, 200, "its 1 million triangles");
  expectRefusal(b, 400, "its 1 million triangles", 500);
}

TEST(GltfMemory, NodesOfOneMeshAreCounted) {
  GltfBuilder b;
  const int p = b.accessor(-1, "VEC3", test::kFloat, 3);
  const int corners = b.accessor(-1, "SCALAR", test::kUbyte, 300'000);
  const int mesh = b.mesh({{"attributes", {{"POSITION", p}}}, {"indices", corners}});
  for (int i = 0; i < 200; ++i) b.node({{"mesh", mesh}});
  expectRefusal(b, 100, "its 20 million triangles would take 3");
}

TEST(GltfMemory, MeshesOverTheSameBytesAreCounted) {
  GltfBuilder b;
  const int p = b.vec3(std::vector<float>(30'000, 1.0F));
  for (int i = 0; i < 200; ++i) b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", p}}}})}});
  expectRefusal(b, 20, "its 666667 triangles would take 34.7 MB");
}

TEST(GltfMemory, PartsOfAMeshThatShareVerticesAreNotCountedWithAllOfThem) {
  GltfBuilder b;
  const int p = b.vec3(std::vector<float>(300'000, 1.0F));
  Json primitives = Json::array();
  for (int i = 0; i < 100; ++i)
    primitives.push_back(
        {{"attributes", {{"POSITION", p}}}, {"indices", b.indices(std::vector<std::uint8_t>{0, 1, 2})}});
  b.node({{"mesh", b.push("meshes", {{"primitives", primitives}})}});
  EXPECT_LT(peakOf(b), 20'000'000U) << "as 10 million vertices they would take 120 MB";
}

TEST(GltfMemory, AnAccessorOfZerosIsCounted) {
  GltfBuilder b;
  const int zeros = b.accessor(-1, "VEC3", test::kFloat, 1 << 24);
  const int three = b.indices(std::vector<std::uint8_t>{0, 1, 2});
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", zeros}}}, {"indices", three}})}});
  expectRefusal(b, 200, "would take");
}

TEST(GltfMemory, TheSameValuesAreNotReadForEver) {
  GltfBuilder b;
  const int zeros = b.accessor(-1, "VEC3", test::kFloat, 1 << 24);
  Json targets = Json::array();
  for (int i = 0; i < 20; ++i) targets.push_back({{"POSITION", zeros}});
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", zeros}}},
                           {"indices", b.indices(std::vector<std::uint8_t>{0, 1, 2})},
                           {"targets", targets}})}});
  const std::string text = b.error();
  EXPECT_NE(text.find("its meshes have 1.06e+03 million values to read"), std::string::npos) << text;
}

TEST(GltfMemory, TextIsCountedBeforeItIsParsed) {
  GltfBuilder b;
  b.node({{"mesh", b.triangleMesh()}});
  b.json["extras"] = std::vector<int>(500'000, 0);
  expectRefusal(b, 10, "its JSON of 1");
}

TEST(GltfMemory, NodesAndMaterialsThatShowNothingTakeLittle) {
  using Add = void (*)(GltfBuilder&);
  for (const Add add : {Add{[](GltfBuilder& b) { b.node(Json::object()); }},
                        Add{[](GltfBuilder& b) { b.material(Json::object()); }}}) {
    const auto bytesWith = [&](int count) {
      GltfBuilder b;
      b.node({{"mesh", b.triangleMesh()}});
      for (int i = 0; i < count; ++i) add(b);
      return peakOf(b);
    };
    // Half of a node is its transform to world space.
    EXPECT_LT(bytesWith(20'000) - bytesWith(10'000), 10'000U * 400);
  }
}

TEST(GltfMemory, AFileOfManyBuffersIsReadOnce) {
  const test::TemporaryFolder folder;
  folder.write("data.bin", std::string(1'000'000, '\0'));
  GltfBuilder b;
  b.json["buffers"] = Json::array();
  Json primitives = Json::array();
  for (int i = 0; i < 50; ++i) {
    b.push("buffers", {{"uri", "data.bin"}, {"byteLength", 900'000 + i}});
    b.push("bufferViews", {{"buffer", i}, {"byteOffset", 0}, {"byteLength", 36}});
    primitives.push_back({{"attributes", {{"POSITION", b.accessor(i, "VEC3", test::kFloat, 3)}}}});
  }
  b.node({{"mesh", b.push("meshes", {{"primitives", primitives}})}});
  MemoryBudget budget({kProgramBytes + 5'000'000, true});
  LoadOptions options;
  options.memory = &budget;
  Notices notices;
  const Scene scene = loadGltf(folder.write("a.gltf", b.json.dump()), options, notices);
  EXPECT_EQ(scene.droppedTriangles, 50U);
}

}  // namespace
}  // namespace whittle
