// Builds small glTF files for the loader's tests: JSON by hand, binary data by value, written into a folder
// of their own.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gltf/loader.h"
#include "image/image_io.h"
#include "scene/input_error.h"

namespace whittle::test {

using Json = nlohmann::json;

/// A folder that goes when it does.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "whittle_gltf_XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// A 2×1 picture, red and green, encoded with the library's own writer.
inline std::string pngBytes() {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> rgb{255, 0, 0, 0, 255, 0};
  writeCodes(folder.path() / "a.png", {2, 1, 3, rgb}, {});
  std::ifstream stream(folder.path() / "a.png", std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline constexpr int kByte = 5120, kUbyte = 5121, kShort = 5122, kUshort = 5123, kUint = 5125, kFloat = 5126;

class GltfBuilder {
 public:
  GltfBuilder() {
    json["asset"]["version"] = "2.0";
    json["scene"] = 0;
    json["scenes"] = Json::array({{{"nodes", Json::array()}}});
  }

  /// A buffer view over `values`; `stride` in bytes, 0: none.
  template <class T>
  int view(const std::vector<T>& values, int stride = 0) {
    while (binary.size() % 4 != 0) binary.push_back('\0');
    Json v{{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", values.size() * sizeof(T)}};
    if (stride > 0) v["byteStride"] = stride;
    binary.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    return push("bufferViews", v);
  }
  int accessor(int viewIndex, const char* type, int componentType, std::size_t count, std::size_t offset = 0,
               bool normalized = false) {
    Json a{{"type", type}, {"componentType", componentType}, {"count", count}, {"byteOffset", offset}};
    if (viewIndex >= 0) a["bufferView"] = viewIndex;
    if (normalized) a["normalized"] = true;
    return push("accessors", a);
  }
  int floats(const char* type, int components, const std::vector<float>& values) {
    return accessor(view(values), type, kFloat, values.size() / static_cast<std::size_t>(components));
  }
  int vec3(const std::vector<float>& values) { return floats("VEC3", 3, values); }
  int vec2(const std::vector<float>& values) { return floats("VEC2", 2, values); }
  template <class T>
  int indices(const std::vector<T>& values) {
    const int type = sizeof(T) == 1 ? kUbyte : sizeof(T) == 2 ? kUshort : kUint;
    return accessor(view(values), "SCALAR", type, values.size());
  }

  /// Appends to a root array and returns the index.
  int push(const char* array, Json value) {
    json[array].push_back(std::move(value));
    return static_cast<int>(json[array].size()) - 1;
  }
  int mesh(Json primitive) { return push("meshes", {{"primitives", Json::array({std::move(primitive)})}}); }
  int material(Json value) { return push("materials", std::move(value)); }
  /// A node; `isRoot`: shown by scene 0.
  int node(Json value, bool isRoot = true) {
    const int index = push("nodes", std::move(value));
    if (isRoot) json["scenes"][0]["nodes"].push_back(index);
    return index;
  }
  /// The triangle (0,0,0), (1,0,0), (0,1,0), as a mesh with the given further primitive members.
  int triangleMesh(Json further = Json::object()) {
    Json primitive{{"attributes", {{"POSITION", vec3({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}};
    primitive.merge_patch(further);
    return mesh(primitive);
  }

  std::string glb() const {
    GltfBuilder complete = *this;
    if (!binary.empty()) complete.json["buffers"] = Json::array({{{"byteLength", binary.size()}}});
    return complete.glbAsIs();
  }
  /// The same with whatever `json` says of its buffers.
  std::string glbAsIs() const {
    std::string text = json.dump();
    while (text.size() % 4 != 0) text += ' ';
    std::string data = binary;
    while (data.size() % 4 != 0) data += '\0';
    return "glTF" + word(2) + word(12 + 8 + text.size() + 8 + data.size()) + word(text.size()) + "JSON" +
           text + word(data.size()) + std::string("BIN\0", 4) + data;
  }

  /// Writes and loads the file. The folder is gone afterwards.
  Scene load(const LoadOptions& options = {}) {
    const TemporaryFolder folder;
    notices = {};
    return loadGltf(folder.write("scene.glb", glb()), options, notices);
  }
  /// The text of the InputError that loading must end in.
  std::string error(const LoadOptions& options = {}) {
    try {
      load(options);
    } catch (const InputError& e) {
      return e.what();
    }
    ADD_FAILURE() << "the file was loaded";
    return {};
  }

  Json json;
  std::string binary;
  Notices notices;

 private:
  static std::string word(std::size_t value) {
    std::string bytes(4, '\0');
    for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<char>(value >> (8 * i) & 0xff);
    return bytes;
  }
};

/// As the animation has the file at that time.
inline LoadOptions at(double seconds) {
  LoadOptions options;
  options.time = seconds;
  return options;
}

/// The text of the InputError that loading `path` must end in.
inline std::string errorOf(const std::filesystem::path& path) {
  Notices notices;
  try {
    loadGltf(path, {}, notices);
  } catch (const InputError& e) {
    return e.what();
  }
  ADD_FAILURE() << path << " was loaded";
  return {};
}

inline bool mentions(const std::vector<std::string>& lines, const std::string& text) {
  for (const std::string& line : lines) {
    if (line.find(text) != std::string::npos) return true;
  }
  return false;
}

inline glm::vec3 corner(const Scene& scene, std::size_t triangle, int c) {
  const Triangle& t = scene.triangles.at(triangle);
  return scene.positions.at(c == 0 ? t.v0 : c == 1 ? t.v1 : t.v2);
}

/// Not normalised: twice the area long, towards the front.
inline glm::vec3 faceNormal(const Scene& scene, std::size_t triangle) {
  return glm::cross(corner(scene, triangle, 1) - corner(scene, triangle, 0),
                    corner(scene, triangle, 2) - corner(scene, triangle, 0));
}

inline void expectNear(const glm::vec3& value, const glm::vec3& expected, float tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], expected[i], tolerance) << "component " << i;
}

}  // namespace whittle::test
