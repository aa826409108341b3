// Binary glTF (glTF 2.0, 4.4): tinygltf makes the description, which is put right here; the chunks are
// written by hand.
#include "glb_file.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace generator {
namespace {

constexpr std::size_t kFileHeader = 12, kChunkHeader = 8;  // bytes

/// tinygltf writes a camera without a far plane as one whose zfar is 0, which glTF forbids: there the
/// property is left out.
void dropAbsentPlanes(nlohmann::json& description) {
  if (!description.contains("cameras")) return;
  for (auto& camera : description["cameras"]) {
    if (!camera.contains("perspective")) continue;
    auto& lens = camera["perspective"];
    if (lens.value("zfar", 0.0) == 0.0) lens.erase("zfar");
  }
}

nlohmann::json describe(tinygltf::Model& model) {
  std::vector<unsigned char> buffer;
  std::swap(buffer, model.buffers[0].data);  // tinygltf would copy it
  tinygltf::TinyGLTF writer;
  std::stringstream text;
  const bool written =
      writer.WriteGltfSceneToStream(&model, text, /*prettyPrint=*/false, /*writeBinary=*/true);
  std::swap(buffer, model.buffers[0].data);
  if (!written) throw std::runtime_error("tinygltf cannot describe the scene");
  nlohmann::json json = nlohmann::json::parse(text.str().substr(kFileHeader + kChunkHeader));
  json["buffers"][0]["byteLength"] = model.buffers[0].data.size();
  dropAbsentPlanes(json);
  return json;
}

void writeWord(std::ostream& file, std::uint64_t value) {
  for (unsigned i = 0; i < 4; ++i) file.put(static_cast<char>(value >> (8 * i) & 0xffU));
}

std::size_t paddedSize(std::string_view bytes) { return (bytes.size() + 3) / 4 * 4; }

/// Length and type, then the bytes, filled up to a multiple of four.
void writeChunk(std::ostream& file, std::string_view type, std::string_view bytes, char fill) {
  writeWord(file, paddedSize(bytes));
  file << type << bytes << std::string(paddedSize(bytes) - bytes.size(), fill);
}

}  // namespace

void writeGlb(tinygltf::Model& model, const std::filesystem::path& path) {
  const std::string text = describe(model).dump();
  const std::vector<unsigned char>& buffer = model.buffers[0].data;
  const std::string_view bytes(reinterpret_cast<const char*>(buffer.data()), buffer.size());
  std::ofstream file(path, std::ios::binary);
  file << "glTF";
  writeWord(file, 2);
  writeWord(file, kFileHeader + 2 * kChunkHeader + paddedSize(text) + paddedSize(bytes));
  writeChunk(file, "JSON", text, ' ');
  writeChunk(file, std::string_view("BIN\0", 4), bytes, '\0');
  file.close();
  if (!file) throw std::runtime_error(fmt::format("{}: cannot be written", path.string()));
}

}  // namespace generator
