// The project's own scenes are valid glTF: the rules that writers break easily, checked without the loader,
// which forgives much. tests/scenes_valid_test.js asks the Khronos validator about all the others.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "gltf/builder.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;
using test::Json;

/// A binary glTF file in its parts; `faults`: what is wrong with how they are put together.
struct Glb {
  Json json;
  std::string binary;
  std::vector<std::string> faults;
};

std::uint32_t wordAt(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

Glb readGlb(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  Glb glb;
  const auto expect = [&glb](bool holds, const char* what) {
    if (!holds) glb.faults.emplace_back(what);
    return holds;
  };
  if (!expect(bytes.size() >= 28 && bytes.starts_with("glTF") && wordAt(bytes, 4) == 2, "header")) return glb;
  expect(wordAt(bytes, 8) == bytes.size(), "length of the file");
  const std::size_t jsonLength = wordAt(bytes, 12), binaryAt = 20 + jsonLength;
  if (!expect(bytes.substr(16, 4) == "JSON" && binaryAt + 8 <= bytes.size(), "JSON chunk")) return glb;
  glb.json = Json::parse(bytes.substr(20, jsonLength));
  expect(bytes.substr(binaryAt + 4, 4) == std::string("BIN\0", 4), "BIN chunk");
  expect(jsonLength % 4 == 0 && bytes.size() % 4 == 0, "chunks end at multiples of four");
  expect(binaryAt + 8 + wordAt(bytes, binaryAt) == bytes.size(), "length of the BIN chunk");
  glb.binary = bytes.substr(binaryAt + 8);
  return glb;
}

/// What of an accessor is needed to find its numbers.
struct Values {
  std::size_t start = 0, count = 0, components = 1, bytes = 4;
  bool isFloat = true;

  double operator()(const std::string& binary, std::size_t i) const {
    const char* at = binary.data() + start + i * bytes;
    if (isFloat) {
      float value = 0;
      std::memcpy(&value, at, sizeof value);
      return static_cast<double>(value);
    }
    std::uint32_t value = 0;
    std::memcpy(&value, at, bytes);
    return value;
  }
};

/// Walks a file and collects what breaks a rule, a line each.
class Rules {
 public:
  explicit Rules(const Glb& file) : glb(file), json(file.json), faults(file.faults) {
    if (!json.is_object()) return;
    checkBuffers();
    for (const Json& accessor : json["accessors"]) checkAccessor(accessor);
    for (const Json& mesh : json["meshes"])
      for (const Json& primitive : mesh["primitives"]) checkPrimitive(primitive);
    for (const Json& node : json["nodes"])
      if (node.contains("rotation"))
        expect(isUnit(node["rotation"]), node["name"], "rotation of unit length");
    for (const Json& camera : json.value("cameras", Json::array())) checkCamera(camera);
    for (const Json& light : lights()) checkLight(light);
    checkExtensions();
  }

  const Glb& glb;
  Json json;
  std::vector<std::string> faults;

 private:
  void expect(bool holds, const std::string& where, const char* what) {
    if (!holds) faults.push_back(fmt::format("{}: {}", where, what));
  }

  static bool isUnit(const Json& vector) {
    double sum = 0;
    for (const Json& c : vector) sum += c.get<double>() * c.get<double>();
    return std::abs(sum - 1) < 1e-6;
  }

  Json lights() const {
    return json.value(Json::json_pointer("/extensions/KHR_lights_punctual/lights"), Json::array());
  }

  void checkBuffers() {
    expect(json["buffers"].size() == 1, "buffers", "one");
    const auto length = json["buffers"][0]["byteLength"].get<std::size_t>();
    expect(length <= glb.binary.size() && glb.binary.size() < length + 4, "buffers[0]",
           "as long as the BIN chunk, but for its padding");
    for (const Json& view : json["bufferViews"])
      expect(view["buffer"] == 0 && view["byteLength"] > 0 &&
                 view.value("byteOffset", 0UL) + view["byteLength"].get<std::size_t>() <= length,
             view.dump(), "within its buffer");
  }

  /// Nothing where the accessor does not lie within its buffer view.
  std::optional<Values> valuesOf(const Json& accessor) {
    const Json& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const int type = accessor["componentType"].get<int>();
    Values values;
    values.bytes = type == test::kUbyte ? 1 : type == test::kUshort ? 2 : 4;
    values.isFloat = type == test::kFloat;
    const auto name = accessor["type"].get<std::string>();
    values.components = name == "SCALAR" ? 1 : static_cast<std::size_t>(name.back() - '0');
    values.count = accessor["count"].get<std::size_t>();
    const auto offset = accessor.value("byteOffset", 0UL);
    values.start = view.value("byteOffset", 0UL) + offset;
    const std::size_t size = values.count * values.components * values.bytes;
    const bool isInside = values.count > 0 && offset + size <= view["byteLength"] &&
                          values.start + size <= glb.binary.size() && values.start % values.bytes == 0;
    expect(isInside, accessor.dump(), "within its buffer view, at a multiple of its components");
    return isInside ? std::optional(values) : std::nullopt;
  }

  /// min and max, where they stand, are those of the numbers.
  void checkAccessor(const Json& accessor) {
    const auto values = valuesOf(accessor);
    if (!values) return;
    for (const char* key : {"min", "max"}) {
      if (!accessor.contains(key)) continue;
      const bool wantsLess = std::string_view(key) == "min";
      for (std::size_t c = 0; c < values->components; ++c) {
        double bound = (*values)(glb.binary, c);
        for (std::size_t i = 1; i < values->count; ++i) {
          const double value = (*values)(glb.binary, i * values->components + c);
          bound = wantsLess ? std::min(bound, value) : std::max(bound, value);
        }
        expect(accessor[key].size() == values->components && accessor[key][c].get<double>() == bound,
               accessor.dump(), key);
      }
    }
  }

  void checkPrimitive(const Json& primitive) {
    const Json& attributes = primitive["attributes"];
    const Json& position = json["accessors"][attributes["POSITION"].get<std::size_t>()];
    expect(position.contains("min") && position.contains("max"), "POSITION", "has min and max");
    for (const auto& [name, index] : attributes.items()) {
      const Json& accessor = json["accessors"][index.get<std::size_t>()];
      expect(accessor["count"] == position["count"], name, "as many as positions");
      if (name == "NORMAL" || name == "TANGENT") checkDirections(name, accessor);
    }
    const auto corners = valuesOf(json["accessors"][primitive["indices"].get<std::size_t>()]);
    if (!corners) return;
    expect(corners->count % 3 == 0, "indices", "three for each triangle");
    for (std::size_t i = 0; i < corners->count; ++i)
      expect((*corners)(glb.binary, i) < position["count"].get<double>(), "indices",
             "of a vertex that is there");
  }

  void checkDirections(const std::string& name, const Json& accessor) {
    const auto values = valuesOf(accessor);
    if (!values) return;
    for (std::size_t i = 0; i < values->count; ++i) {
      const std::size_t at = i * values->components;
      double sum = 0;
      for (std::size_t c = 0; c < 3; ++c) sum += std::pow((*values)(glb.binary, at + c), 2);
      expect(std::abs(sum - 1) < 1e-5, name, "of unit length");
      if (name == "TANGENT") expect(std::abs((*values)(glb.binary, at + 3)) == 1, name, "w is 1 or -1");
    }
  }

  void checkCamera(const Json& camera) {
    const Json& lens = camera["perspective"];
    const double znear = lens["znear"].get<double>(), yfov = lens["yfov"].get<double>();
    expect(znear > 0, "camera", "znear above 0");
    expect(!lens.contains("zfar") || lens["zfar"].get<double>() > znear, "camera", "zfar beyond znear");
    expect(yfov > 0 && yfov < std::numbers::pi, "camera", "yfov");
    expect(lens.value("aspectRatio", 1.0) > 0, "camera", "aspectRatio");
  }

  void checkLight(const Json& light) {
    const auto name = light.value("name", "light");
    expect(light.value("intensity", 1.0) >= 0, name, "intensity");
    if (light["type"] != "spot") return;
    const double inner = light["spot"].value("innerConeAngle", 0.0);
    const double outer = light["spot"].value("outerConeAngle", std::numbers::pi / 4);
    expect(inner >= 0 && inner < outer && outer <= std::numbers::pi / 2, name, "inner cone below the outer");
    // Readers that hold cosines as floats divide by this.
    expect(static_cast<float>(std::cos(inner)) > static_cast<float>(std::cos(outer)), name,
           "cone angles that differ as floats");
  }

  /// Those that are used, and no others, are declared.
  void checkExtensions() {
    std::set<std::string> used;
    collectExtensions(json, used);
    std::set<std::string> declared;
    for (const Json& name : json.value("extensionsUsed", Json::array())) declared.insert(name);
    expect(used == declared, "extensionsUsed", "all that are used");
  }

  static void collectExtensions(const Json& part, std::set<std::string>& used) {
    if (!part.is_structured()) return;
    if (part.is_object() && part.contains("extensions"))
      for (const auto& [name, value] : part["extensions"].items()) used.insert(name);
    for (const Json& inner : part) collectExtensions(inner, used);
  }
};

std::vector<fs::path> ownScenes() {
  std::vector<fs::path> scenes;
  for (const auto& entry : fs::directory_iterator(WHITTLE_SCENES))
    if (entry.path().extension() == ".glb") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

TEST(OwnSceneFiles, KeepTheRulesThatAreEasilyBroken) {
  EXPECT_GE(ownScenes().size(), 12U);
  for (const fs::path& path : ownScenes()) {
    const Rules rules(readGlb(path));
    for (const std::string& fault : rules.faults) ADD_FAILURE() << path.filename() << ": " << fault;
  }
}

TEST(OwnSceneFiles, LoadWithoutAWarning) {
  for (const fs::path& path : ownScenes()) {
    Notices notices;
    loadGltf(path, {}, notices);
    for (const std::string& warning : notices.warnings) ADD_FAILURE() << path.filename() << ": " << warning;
  }
}

TEST(OwnSceneFiles, EachRuleIsSeenBroken) {
  const Glb whole = readGlb(fs::path(WHITTLE_SCENES) / "spot_cone.glb");
  const auto faultsOf = [&](auto&& spoil) {
    Glb spoiled = whole;
    spoil(spoiled);
    return Rules(spoiled).faults;
  };
  ASSERT_TRUE(faultsOf([](Glb&) {}).empty());
  const auto pointer = [](const char* path) { return Json::json_pointer(path); };
  using test::mentions;
  EXPECT_TRUE(mentions(faultsOf([&](Glb& g) { g.json[pointer("/cameras/0/perspective/zfar")] = 0.0; }),
                       "zfar beyond znear"));
  EXPECT_TRUE(mentions(faultsOf([&](Glb& g) {
                         for (Json& light : g.json[pointer("/extensions/KHR_lights_punctual/lights")])
                           if (light["type"] == "spot")
                             light["spot"]["innerConeAngle"] = light["spot"]["outerConeAngle"];
                       }),
                       "inner cone below the outer"));
  EXPECT_TRUE(mentions(faultsOf([&](Glb& g) { g.json["buffers"][0]["byteLength"] = g.binary.size() + 4; }),
                       "as long as the BIN chunk"));
  EXPECT_TRUE(mentions(faultsOf([&](Glb& g) { g.json[pointer("/bufferViews/0/byteLength")] = 4; }),
                       "within its buffer view"));
  EXPECT_TRUE(mentions(faultsOf([&](Glb& g) { g.json[pointer("/accessors/0/max/0")] = 1e3; }), "max"));
  EXPECT_TRUE(
      mentions(faultsOf([&](Glb& g) { g.json[pointer("/accessors/0")].erase("min"); }), "has min and max"));
  EXPECT_TRUE(
      mentions(faultsOf([&](Glb& g) { g.json["extensionsUsed"] = Json::array(); }), "extensionsUsed"));
}

}  // namespace
}  // namespace whittle
