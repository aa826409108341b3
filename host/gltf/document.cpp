// Opens a file: versions, extensions, tinygltf, and buffers, which are read on first use.
#include "gltf/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "gltf/animation.h"
#include "gltf/check.h"
#include "gltf/container.h"
#include "gltf/extensions.h"
#include "gltf/json_cost.h"
#include "gltf/packed_views.h"
#include "gltf/uri.h"
#include "scene/input_error.h"

namespace whittle::gltf {

namespace {

/// Before anything else is checked: in glTF 1.0 nearly every property has another type.
void checkVersion(const Document& document, const Json& json) {
  if (!json.is_object() || !json.contains("asset")) return;  // checkedCopy says it better
  for (const char* array : {"scenes", "nodes", "meshes", "accessors"}) {
    if (json.contains(array) && json[array].is_object()) {
      document.fail("is glTF 1.0; Whittle reads glTF 2.0 (convert the file first)");
    }
  }
  for (const char* key : {"minVersion", "version"}) {
    const auto found = json["asset"].is_object() ? json["asset"].find(key) : json["asset"].end();
    if (found == json["asset"].end() || !found->is_string()) continue;
    const auto version = found->get<std::string>();
    const bool isTwo = version == "2" || version.starts_with("2.");
    const bool tooNew = std::string_view(key) == "minVersion" && isTwo && version != "2.0" && version != "2";
    if (!isTwo || tooNew) {
      document.fail(fmt::format("asset.{} is{}; Whittle reads glTF 2.0 (convert the file first)", key,
                                quotedName(version)));
    }
  }
}

/// tinygltf refuses index accessors without a buffer view, which are legal (zeros, or sparse values over
/// zeros): while it reads, such accessors have a view of their own, behind all the others.
std::string withStandInView(Json description) {
  const std::size_t standIn = child(description, "bufferViews").size();
  for (Json& accessor : description["accessors"]) {
    if (!accessor.contains("bufferView")) accessor["bufferView"] = standIn;
  }
  description["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 1}});
  return description.dump();
}

void removeStandInView(tinygltf::Model& model) {
  model.bufferViews.pop_back();
  const auto standIn = static_cast<int>(model.bufferViews.size());
  for (tinygltf::Accessor& accessor : model.accessors) {
    if (accessor.bufferView == standIn) accessor.bufferView = -1;
  }
}

/// tinygltf adds a line for each level that fails, the innermost first.
std::string firstSentence(const std::string& error) {
  std::string line = oneLine(error.substr(0, error.find('\n')));
  while (!line.empty() && (line.back() == '.' || line.back() == ' ')) line.pop_back();
  return line;
}

/// What tinygltf takes of an object of an array, on top of its JSON: names, maps of extensions, extras.
constexpr std::uint64_t kTinyObject = 450;

std::uint64_t objectsIn(const Json& json) {
  std::uint64_t count = json.is_object() ? 1 : 0;
  if (json.is_structured())
    for (const Json& element : json) count += objectsIn(element);
  return count;
}

void readDescription(Document& document) {
  Json description = descriptionOnly(document.json);
  const std::uint64_t bytes = bytesOf(description);
  document.pass(3 * bytes, "its description");
  document.hold(kTinyObject * objectsIn(description), "its description");
  const std::string text = withStandInView(std::move(description));
  if (text.size() > std::numeric_limits<unsigned int>::max()) document.fail("its JSON is larger than 4 GB");
  tinygltf::TinyGLTF reader;
  std::string error;
  std::string warning;
  if (!reader.LoadASCIIFromString(&document.model, &error, &warning, text.c_str(),
                                  static_cast<unsigned int>(text.size()), "", tinygltf::NO_REQUIRE)) {
    document.fail("its description is not valid glTF 2.0" +
                  (error.empty() ? "" : ": " + firstSentence(error)));
  }
  removeStandInView(document.model);
}

void readFromUri(Document& document, int buffer, const std::string& uri, std::uint64_t length, Bytes& bytes) {
  if (isDataUri(uri)) {
    document.pass(uri.size(), fmt::format("buffer {}", buffer));
    auto decoded = decodeDataUri(uri);
    if (!decoded) document.fail(fmt::format("the data URI of buffer {} cannot be decoded", buffer));
    bytes = std::move(*decoded);
    document.hold(bytes.size(), fmt::format("buffer {}", buffer));
    return;
  }
  if (isAbsoluteUri(uri)) {
    document.fail(fmt::format("buffer {} is at{}; Whittle reads local files only", buffer, quotedName(uri)));
  }
  constexpr std::uint64_t kPointerStart = 64;  // enough to tell a git-lfs pointer by
  const std::filesystem::path file = fileOf(document, uri);
  const std::uint64_t wanted = std::max(length, kPointerStart);
  std::error_code unknown;
  if (const std::uintmax_t size = std::filesystem::file_size(file, unknown); !unknown) {
    document.budget->sawFile(size);
    document.hold(std::min<std::uint64_t>(size, wanted), fmt::format("buffer {}", buffer));
  }
  const auto problem = readStart(file, wanted, bytes);
  if (problem) document.fail(fmt::format("buffer {}: the file{} {}", buffer, quotedName(uri), *problem));
  if (isLfsPointer(asText(bytes))) {
    document.fail(fmt::format("buffer {}: the file{} is a git-lfs pointer, not the data (run git lfs pull)",
                              buffer, quotedName(uri)));
  }
}

/// The bytes of a buffer, at least its byteLength of them. Throws InputError.
std::span<const std::byte> bufferData(Document& document, int buffer) {
  const Json& description = document.json["buffers"][at(buffer)];
  const auto length = description["byteLength"].get<std::uint64_t>();
  std::span<const std::byte> data;
  if (!description.contains("uri")) {
    if (buffer != 0 || !document.hasBinary) document.fail(fmt::format("buffer {} has no data", buffer));
    data = document.binary;
  } else {
    const auto& uri = description["uri"].get_ref<const std::string&>();
    Document::UriData& read = document.buffers[uri];
    if (!read.isRead) readFromUri(document, buffer, uri, std::max(read.length, length), read.bytes);
    read.isRead = true;
    data = read.bytes;
  }
  if (data.size() < length) {
    document.fail(fmt::format("buffer {} is too short: {} bytes of {}", buffer, data.size(), length));
  }
  return data.first(static_cast<std::size_t>(length));
}

std::uint64_t bytesOf(const std::vector<Node>& nodes) {
  std::uint64_t bytes = nodes.capacity() * sizeof(Node);
  for (const Node& node : nodes)
    bytes += (node.local ? sizeof(glm::dmat4) + 16 : 0) + (node.rare ? sizeof(Node::Rare) + 64 : 0) +
             4 * node.children.capacity() + (node.name.size() > 15 ? node.name.size() + 16 : 0);
  return bytes;
}

}  // namespace

std::string oneLine(std::string_view text) {
  std::string line(text);
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

void Document::fail(std::string_view what) const {
  constexpr std::size_t kLongest = 390;  // bytes, so that a line stays a line on any terminal
  std::string line = fmt::format("{}: {}", oneLine(name), oneLine(what));
  if (line.size() > kLongest) {
    std::size_t end = std::max(kLongest - 3, std::min(oneLine(name).size(), line.size()));
    while (end > 0 && end < line.size() && (static_cast<unsigned char>(line[end]) & 0xC0U) == 0x80U) --end;
    line = line.substr(0, end) + "…";
  }
  throw InputError(line);
}

void Document::hold(std::uint64_t bytes, std::string_view what) const {
  named([&] { budget->hold(bytes, what); });
}

void Document::pass(std::uint64_t bytes, std::string_view what) const {
  named([&] { budget->pass(bytes, what); });
}

void Document::promise(std::uint64_t bytes, std::string_view what) const {
  named([&] { budget->promise(bytes, what); });
}

void Document::checkReads(double values, std::string_view what) const {
  named([&] { budget->checkReads(values, what); });
}

void openDocument(Document& document, const std::filesystem::path& path, Notices& notices) {
  document.name = path.string();
  document.folder = path.parent_path();
  document.notices = &notices;
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  if (!unknown) {
    document.budget->sawFile(size);
    document.pass(size, "its bytes");
  }
  {
    const LoggedWork work(document.log, "read the file");
    const auto problem = readStart(path, std::numeric_limits<std::uint64_t>::max(), document.file);
    if (problem) document.fail(*problem);
  }
  document.hold(document.file.size(), "its bytes");
  const LoggedWork work(document.log, "read the description");
  Json json = readContainer(document);
  checkVersion(document, json);
  if (const auto found = json.find("animations"); found != json.end() && found->is_array()) {
    document.animationFacts = animationsOf(json);
    document.animations = std::move(*found);
    json.erase(found);
  }
  document.json = checkedCopy(document, std::move(json), document.nodes);
  checkExtensions(document, notices);
  document.hold(bytesOf(document.json) + bytesOf(document.animations) + bytesOf(document.nodes),
                "its description");
  readDescription(document);
  for (const Json& buffer : child(document.json, "buffers")) {
    if (!buffer.contains("uri")) continue;
    Document::UriData& data = document.buffers[buffer["uri"].get_ref<const std::string&>()];
    data.length = std::max(data.length, buffer["byteLength"].get<std::uint64_t>());
  }
}

std::span<const std::byte> viewData(Document& document, int view) {
  const tinygltf::BufferView& v = document.model.bufferViews[static_cast<std::size_t>(view)];
  if (const auto unpacked = unpackedView(document, view)) return *unpacked;
  return bytesOfBuffer(document, v.buffer, v.byteOffset, v.byteLength, fmt::format("bufferViews[{}]", view));
}

std::span<const std::byte> bytesOfBuffer(Document& document, int buffer, std::uint64_t offset,
                                         std::uint64_t length, std::string_view label) {
  const auto data = bufferData(document, buffer);
  if (offset > data.size() || length > data.size() - offset)
    document.fail(fmt::format("{} reaches beyond buffer {}", label, buffer));
  return data.subspan(offset, length);
}

namespace {

/// Whether `file` lies in `folder` or below, wherever links lead. What is not there lies where its name says.
bool isInside(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code error;
  const auto base = std::filesystem::weakly_canonical(folder.empty() ? "." : folder, error);
  if (error) return false;
  const auto real = std::filesystem::weakly_canonical(file, error);
  if (error) return false;
  const auto [end, unused] = std::mismatch(base.begin(), base.end(), real.begin(), real.end());
  return end == base.end();
}

}  // namespace

std::filesystem::path fileOf(Document& document, std::string_view uri) {
  LocalFile file = resolveUri(document.folder, uri);
  if (file.hadBackslashes) {
    document.warn(fmt::format("the URI{} has backslashes; they are read as slashes", quotedName(uri)));
  }
  if (!isInside(document.folder, file.path)) {
    auto& outside = document.outside;
    if (std::find(outside.begin(), outside.end(), file.path) == outside.end()) outside.push_back(file.path);
    if (document.confined) settleOutside(document);
  }
  document.notices->files.push_back(file.path);
  return std::move(file.path);
}

void settleOutside(const Document& document) {
  if (document.outside.empty()) return;
  const std::string first = document.outside.front().string();
  const std::string more =
      document.outside.size() > 1 ? fmt::format(" and {} more", document.outside.size() - 1) : "";
  if (document.confined)
    document.fail(fmt::format("it asks for {}{} outside its folder, which --confine forbids", first, more));
  document.notices->note(
      fmt::format("the scene reads {}{}, outside its own folder; --confine refuses such files", first, more));
}

const Json& child(const Json& object, const char* key) {
  static const Json kNothing = Json::object();
  const auto found = object.find(key);
  return found == object.end() ? kNothing : *found;
}

const Json* extension(const Json& object, const char* name) {
  const Json& extensions = child(object, "extensions");
  const auto found = extensions.find(name);
  return found == extensions.end() ? nullptr : &*found;
}

double number(const Json& object, const char* key, double fallback) {
  const auto found = object.find(key);
  return found == object.end() ? fallback : found->get<double>();
}

std::string quotedName(std::string_view name) {
  if (name.empty()) return {};
  constexpr std::size_t kLongest = 80;
  std::size_t end = std::min(name.size(), kLongest);
  while (end < name.size() && end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;
  return fmt::format(" \"{}{}\"", oneLine(name.substr(0, end)), end < name.size() ? "…" : "");
}

}  // namespace whittle::gltf
