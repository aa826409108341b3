// A glTF 2.0 file opened and checked: the description (JSON), tinygltf's typed view of it, and the buffers,
// which are read on first use. Nothing of it leaves this folder. Follows the glTF 2.0 specification,
// sections 3 and 4.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "gltf/node.h"
#include "scene/input_error.h"
#include "scene/memory_budget.h"
#include "scene/notices.h"
#include "scene/scene.h"
#include "scene/work_log.h"

namespace whittle::gltf {

using Json = nlohmann::json;
using Bytes = std::vector<std::byte>;

/// What every part of the loader reads. Indices stored in `json` and `model` are in range, see check.h.
struct Document {
  Document() = default;
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  std::string name;                   ///< the path as the user gave it: every error starts with it
  std::filesystem::path folder;       ///< relative URIs start here
  Bytes file;                         ///< the whole file; of a .glb, `binary` points into it
  std::span<const std::byte> binary;  ///< BIN chunk of a .glb
  bool hasBinary = false;
  Json json;        ///< checked copy: extensions, extras, buffers and images are read from here
  Json animations;  ///< as the file has them, not checked; null where there are none
  std::vector<AnimationFacts> animationFacts;  ///< what it says of them
  std::vector<Node> nodes;                     ///< of the file, shown or not
  tinygltf::Model model;                       ///< everything else

  /// What a URI of buffers holds: read on first use, once for all buffers that name it.
  struct UriData {
    Bytes bytes;
    std::uint64_t length = 0;  ///< the most that one of them asks for
    bool isRead = false;
  };
  std::unordered_map<std::string_view, UriData> buffers;  ///< by URI, as `json` has it
  std::unordered_map<int, Bytes> unpackedViews;           ///< compressed buffer views, see packed_views.h
  std::unordered_map<int, Bytes> unpackedAccessors;  ///< whose values were compressed, see packed_meshes.h

  Notices* notices = nullptr;                  ///< never null once the file is opened
  MemoryBudget* budget = nullptr;              ///< never null
  bool isPosed = false;                        ///< an animation will move its nodes
  bool textureLevels = false;                  ///< smaller levels of its textures will take memory
  WorkLog log;                                 ///< see LoadOptions
  bool confined = false;                       ///< files outside `folder` are not read
  std::vector<std::filesystem::path> outside;  ///< that were asked for, each once

  /// Throws InputError with one line, "NAME: what".
  [[noreturn]] void fail(std::string_view what) const;
  /// As those of the budget, with an error that starts with the name.
  void hold(std::uint64_t bytes, std::string_view what) const;
  void pass(std::uint64_t bytes, std::string_view what) const;
  void promise(std::uint64_t bytes, std::string_view what) const;
  void checkReads(double values, std::string_view what) const;
  /// Of what the file goes on without.
  void warn(std::string what) const { notices->warn(std::move(what)); }

 private:
  template <class Ask>
  void named(const Ask& ask) const {
    try {
      ask();
    } catch (const InputError& e) {
      fail(e.what());
    }
  }
};

/// A checked index of the file as C++ has it.
inline std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// Reads, splits, parses and checks `path`. Throws InputError; notes what is not supported and not required.
void openDocument(Document& document, const std::filesystem::path& path, Notices& notices);

/// The bytes of a buffer view, unpacked where they are compressed, checked against its buffer. Throws
/// InputError.
std::span<const std::byte> viewData(Document& document, int view);
/// Bytes of a buffer as it is; `label` asks for them. Throws InputError.
std::span<const std::byte> bytesOfBuffer(Document& document, int buffer, std::uint64_t offset,
                                         std::uint64_t length, std::string_view label);

/// The file that the URI of a buffer or an image means. Warns of names that only nearly fit, and remembers
/// those outside the folder of the scene: links are followed. Throws InputError for them where it is
/// confined.
std::filesystem::path fileOf(Document& document, std::string_view uri);
/// Says how many files outside the folder were read. Throws InputError where it is confined and one was asked
/// for.
void settleOutside(const Document& document);

/// The object under `key`, or an empty object where there is none.
const Json& child(const Json& object, const char* key);
/// The extension `name` of a glTF object; null where it is absent.
const Json* extension(const Json& object, const char* name);
/// A number, or `fallback` where it is absent.
double number(const Json& object, const char* key, double fallback);

/// One line of printable text: control characters and line ends become spaces.
std::string oneLine(std::string_view text);
/// ` "name"` for messages, shortened, control characters replaced; nothing for an empty name.
std::string quotedName(std::string_view name);

}  // namespace whittle::gltf
