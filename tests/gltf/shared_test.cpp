// The loader on files that nobody here wrote: triangle counts of known-good models, and malformed ones, which
// must end in a scene or in one clear line.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "gltf/builder.h"
#include "support/mutation.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

std::vector<std::vector<std::string>> readTable(const fs::path& path) {
  std::ifstream stream(path);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(stream, line);) {
    std::vector<std::string> row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, '\t');) row.push_back(cell);
    rows.push_back(row);
  }
  return rows;
}

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void expectConsistent(const Scene& scene) {
  const std::size_t n = scene.positions.size();
  for (const std::size_t size : {scene.normals.size(), scene.tangents.size(), scene.uv0.size(),
                                 scene.uv1.size(), scene.colors.size()}) {
    EXPECT_TRUE(size == 0 || size == n) << size << " of " << n;
  }
  for (const glm::vec3& p : scene.positions) {
    ASSERT_TRUE(std::abs(p.x) <= 1.8e18 && std::abs(p.y) <= 1.8e18 && std::abs(p.z) <= 1.8e18);
  }
  for (const glm::vec3& v : scene.normals) {
    const float length = glm::length(v);
    ASSERT_TRUE(length == 0.0F || std::abs(length - 1.0F) < 1e-5F) << length;
  }
  for (const Triangle& t : scene.triangles) {
    ASSERT_LT(std::max({t.v0, t.v1, t.v2}), n);
    ASSERT_LT(t.material, scene.materials.size());
  }
  for (const Material& m : scene.materials) {
    for (const TextureSlot* s :
         {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture, &m.occlusionTexture,
          &m.emissionTexture, &m.specularTexture, &m.specularColorTexture, &m.transmissionTexture}) {
      ASSERT_LT(s->image, static_cast<int>(scene.images.size()));
      const bool isRead = s->used() && !scene.triangles.empty();
      EXPECT_TRUE(!isRead || s->uvSet != 0 || !scene.uv0.empty());
    }
  }
  EXPECT_FALSE(scene.cameras.empty());
}

TEST(SharedScenes, TriangleCountsAreTheManifests) {
  const fs::path root = fs::path(WHITTLE_SHARED);
  if (!fs::exists(root / "MANIFEST.tsv")) GTEST_SKIP() << "no shared scenes at " << root;
  int checked = 0;
  for (const auto& row : readTable(root / "MANIFEST.tsv")) {
    if (row.size() < 3 || (row[1] != "render" && row[1] != "bench")) continue;
    SCOPED_TRACE(row[0]);
    Notices notices;
    const auto start = std::chrono::steady_clock::now();
    Scene scene;
    ASSERT_NO_THROW(scene = loadGltf(root / row[0], {}, notices));
    if (secondsSince(start) > 1.0) std::cout << row[0] << ": " << secondsSince(start) << " s\n";
    EXPECT_EQ(scene.triangles.size() + scene.droppedTriangles, std::stoull(row[2]));
    for (const std::string& warning : notices.warnings) ADD_FAILURE() << "warning: " << warning;
    expectConsistent(scene);
    ++checked;
  }
  EXPECT_GE(checked, 70) << "the manifest lists fewer files than it did";
}

TEST(SharedScenes, BrokenFilesEndInASceneOrInOneLine) {
  const fs::path root = fs::path(WHITTLE_SHARED) / "broken";
  if (!fs::exists(root)) GTEST_SKIP() << "no shared scenes at " << root;
  std::set<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".gltf" || extension == ".glb") files.insert(entry.path());
  }
  std::size_t loaded = 0;
  const bool verbose = std::getenv("WHITTLE_TEST_VERBOSE") != nullptr;
  for (const fs::path& file : files) {
    SCOPED_TRACE(file);
    Notices notices;
    const auto start = std::chrono::steady_clock::now();
    try {
      const Scene scene = loadGltf(file, {}, notices);
      expectConsistent(scene);
      ++loaded;
      if (verbose) {
        std::cout << "ok " << fs::relative(file, root) << ' ' << scene.triangles.size() << '\n';
        for (const auto& w : notices.warnings) std::cout << "    w " << w << '\n';
        for (const auto& w : notices.notes) std::cout << "    n " << w << '\n';
      }
    } catch (const InputError& e) {
      const std::string text = e.what();
      if (verbose) std::cout << "ERR " << text.substr(root.string().size()) << '\n';
      EXPECT_LT(text.size(), 400U) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
      EXPECT_TRUE(text.starts_with(file.string() + ": ")) << text;
    }
    for (const auto* lines : {&notices.warnings, &notices.notes}) {
      for (const std::string& line : *lines) EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
    EXPECT_LT(secondsSince(start), 10.0);
  }
  EXPECT_EQ(files.size(), 299U);
  EXPECT_GE(loaded, 100U) << "most of these files are merely odd";
}

/// The same file without its tangents, its URIs made absolute, as a new file in `folder`.
fs::path withoutTangents(const fs::path& file, const test::TemporaryFolder& folder) {
  std::ifstream stream(file);
  test::Json json = test::Json::parse(stream);
  for (auto& mesh : json["meshes"]) {
    for (auto& primitive : mesh["primitives"]) primitive["attributes"].erase("TANGENT");
  }
  for (const char* array : {"buffers", "images"}) {
    for (auto& entry : json[array]) {
      entry["uri"] = (fs::absolute(file).parent_path() / entry["uri"].get<std::string>()).string();
    }
  }
  return folder.write("without_tangents.gltf", json.dump());
}

/// What an exporter wrote with MikkTSpace is what generated tangents must come close to, handedness included.
/// The JSON of a .gltf or .glb file.
test::Json descriptionOf(const fs::path& file) {
  const std::string bytes = test::fileText(file);
  if (!bytes.starts_with("glTF")) return test::Json::parse(bytes);
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, sizeof size);
  return test::Json::parse(bytes.substr(20, size));
}

/// Of lists with indices, which those of compressed files all are.
std::uint64_t trianglesAnnounced(const test::Json& json) {
  std::uint64_t corners = 0;
  for (const test::Json& node : json["nodes"])
    if (node.contains("mesh"))
      for (const test::Json& primitive : json["meshes"][node["mesh"].get<std::size_t>()]["primitives"])
        corners += json["accessors"][primitive["indices"].get<std::size_t>()]["count"].get<std::uint64_t>();
  return corners / 3;
}

/// Decoders change the order of triangles, not their number, and what they unpack is no nonsense.
TEST(SharedScenes, CompressedFilesHoldWhatTheyAnnounce) {
  const fs::path root = fs::path(WHITTLE_SHARED) / "compressed";
  if (!fs::exists(root)) GTEST_SKIP() << "no compressed scenes at " << root;
  int checked = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".glb" && entry.path().extension() != ".gltf") continue;
    SCOPED_TRACE(entry.path());
    ++checked;
    const test::Json json = descriptionOf(entry.path());
    Notices notices;
    Scene scene;
    try {
      scene = loadGltf(entry.path(), {}, notices);
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("Whittle was built without"), std::string::npos) << e.what();
      continue;
    }
    EXPECT_EQ(scene.triangles.size() + scene.droppedTriangles, trianglesAnnounced(json));
    expectConsistent(scene);
    if (canDecodeWebp()) {
      EXPECT_EQ(scene.images.size(), json.value("images", test::Json::array()).size());
    }
  }
  EXPECT_GE(checked, 5);
}

TEST(SharedScenes, GeneratedTangentsAgreeWithTheExporters) {
  const fs::path root = fs::path(WHITTLE_SHARED) / "gltf";
  if (!fs::exists(root)) GTEST_SKIP() << "no shared scenes at " << root;
  for (const char* name : {"FlightHelmet/glTF-bevy-downscaled/FlightHelmet.gltf",
                           "LightsPunctualLamp/glTF/LightsPunctualLamp.gltf"}) {
    SCOPED_TRACE(name);
    const test::TemporaryFolder folder;
    Notices notices;
    const Scene given = loadGltf(root / name, {}, notices);
    const Scene generated = loadGltf(withoutTangents(root / name, folder), {}, notices);
    ASSERT_EQ(given.triangles.size(), generated.triangles.size());
    std::size_t corners = 0, near = 0, sameHand = 0;
    for (std::size_t i = 0; i < given.triangles.size(); ++i) {
      const Triangle& a = given.triangles[i];
      const Triangle& b = generated.triangles[i];
      if (!given.materials[a.material].normalTexture.used()) continue;
      for (const auto& [v, w] : {std::pair(a.v0, b.v0), std::pair(a.v1, b.v1), std::pair(a.v2, b.v2)}) {
        const glm::vec4 t = given.tangents[v], u = generated.tangents[w];
        ++corners;
        near += glm::dot(glm::vec3(t), glm::vec3(u)) > 0.95F;
        sameHand += t.w == u.w;
      }
    }
    std::cout << name << ": " << corners << " corners, within 18 degrees " << near << ", same hand "
              << sameHand << '\n';
    ASSERT_GT(corners, 1000U);
    // Not all: exporters weigh and split vertices at texture seams in their own ways.
    EXPECT_GT(near, corners * 9 / 10);
    EXPECT_GT(sameHand, corners * 97 / 100);
  }
}

}  // namespace
}  // namespace whittle
