// See gltf_check.h. The tables at the top follow the JSON schemas of glTF 2.0 and of the extensions that are
// read.
#include "scene/gltf_check.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace whittle::gltf {

namespace {

enum class Kind { Index, Size, Number, Flag, Text, Texts, Numbers, Indices, Object, Objects, Map, Maps, Raw };

struct Field {
  const char* key;
  Kind kind;
  const char* target = nullptr;        ///< indices: the array they refer to
  std::span<const Field> fields = {};  ///< objects
  std::size_t length = 0;              ///< numbers: exactly so many; 0: any
  std::span<const int> oneOf = {};     ///< indices without a target: the legal values; empty: any
  bool isRequired = false;
};

constexpr Field required(Field field) {
  field.isRequired = true;
  return field;
}
constexpr Field index(const char* key, const char* target) { return {key, Kind::Index, target}; }
constexpr Field code(const char* key, std::span<const int> oneOf) {
  return {key, Kind::Index, nullptr, {}, 0, oneOf};
}
constexpr Field size(const char* key) { return {key, Kind::Size}; }
/// tinygltf keeps the numbers of sparse accessors as int.
constexpr Field smallSize(const char* key) { return {key, Kind::Index}; }
constexpr Field num(const char* key) { return {key, Kind::Number}; }
constexpr Field nums(const char* key, std::size_t n) { return {key, Kind::Numbers, nullptr, {}, n}; }
constexpr Field flag(const char* key) { return {key, Kind::Flag}; }
constexpr Field text(const char* key) { return {key, Kind::Text}; }
constexpr Field texts(const char* key) { return {key, Kind::Texts}; }
constexpr Field indices(const char* key, const char* target) { return {key, Kind::Indices, target}; }
constexpr Field object(const char* key, std::span<const Field> f) { return {key, Kind::Object, nullptr, f}; }
constexpr Field objects(const char* key, std::span<const Field> f) {
  return {key, Kind::Objects, nullptr, f};
}
constexpr Field raw(const char* key) { return {key, Kind::Raw}; }

constexpr std::array kComponentTypes{5120, 5121, 5122, 5123, 5125, 5126};
constexpr std::array kIndexTypes{5121, 5123, 5125};
constexpr std::array kModes{0, 1, 2, 3, 4, 5, 6};
constexpr std::array kWraps{10497, 33071, 33648};
constexpr std::array kMagFilters{9728, 9729};
constexpr std::array kMinFilters{9728, 9729, 9984, 9985, 9986, 9987};

constexpr std::array kAsset{required(text("version")), text("minVersion")};
constexpr std::array kBuffer{required(size("byteLength")), text("uri")};
constexpr std::array kView{required(index("buffer", "buffers")), size("byteOffset"),
                           required(size("byteLength")), size("byteStride")};
constexpr std::array kSparseIndices{required(index("bufferView", "bufferViews")), smallSize("byteOffset"),
                                    required(code("componentType", kIndexTypes))};
constexpr std::array kSparseValues{required(index("bufferView", "bufferViews")), smallSize("byteOffset")};
constexpr std::array kSparse{required(smallSize("count")), required(object("indices", kSparseIndices)),
                             required(object("values", kSparseValues))};
constexpr std::array kAccessor{index("bufferView", "bufferViews"),
                               size("byteOffset"),
                               flag("normalized"),
                               required(code("componentType", kComponentTypes)),
                               required(size("count")),
                               required(text("type")),
                               object("sparse", kSparse)};
constexpr std::array kPrimitive{required(Field{"attributes", Kind::Map, "accessors"}),
                                index("indices", "accessors"), index("material", "materials"),
                                code("mode", kModes), Field{"targets", Kind::Maps, "accessors"}};
constexpr std::array kMesh{required(objects("primitives", kPrimitive)), nums("weights", 0), text("name")};
constexpr std::array kInstancing{required(Field{"attributes", Kind::Map, "accessors"})};
constexpr std::array kNodeLight{required(index("light", "lights"))};
constexpr std::array kNodeExtensions{object("KHR_lights_punctual", kNodeLight),
                                     object("EXT_mesh_gpu_instancing", kInstancing)};
constexpr std::array kNode{text("name"),
                           indices("children", "nodes"),
                           index("mesh", "meshes"),
                           index("skin", "skins"),
                           index("camera", "cameras"),
                           nums("matrix", 16),
                           nums("translation", 3),
                           nums("rotation", 4),
                           nums("scale", 3),
                           nums("weights", 0),
                           object("extensions", kNodeExtensions),
                           raw("extras")};
constexpr std::array kScene{text("name"), indices("nodes", "nodes"), raw("extras")};
constexpr std::array kSkin{text("name"), required(indices("joints", "nodes")),
                           index("inverseBindMatrices", "accessors")};
constexpr std::array kPerspective{required(num("yfov")), required(num("znear")), num("aspectRatio"),
                                  num("zfar")};
constexpr std::array kOrthographic{required(num("xmag")), required(num("ymag")), required(num("znear")),
                                   required(num("zfar"))};
constexpr std::array kCamera{text("name"), required(text("type")), object("perspective", kPerspective),
                             object("orthographic", kOrthographic)};
constexpr std::array kSpot{num("innerConeAngle"), num("outerConeAngle")};
constexpr std::array kLight{text("name"), required(text("type")), nums("color", 3), num("intensity"),
                            num("range"), object("spot", kSpot),  raw("extras")};
constexpr std::array kLights{required(objects("lights", kLight))};
constexpr std::array kRootExtensions{object("KHR_lights_punctual", kLights)};

constexpr std::array kSampler{code("magFilter", kMagFilters), code("minFilter", kMinFilters),
                              code("wrapS", kWraps), code("wrapT", kWraps)};
constexpr std::array kImage{text("uri"), text("mimeType"), index("bufferView", "bufferViews"), text("name")};
constexpr std::array kTexture{index("sampler", "samplers"), index("source", "images"), raw("extensions")};
constexpr std::array kTransform{nums("offset", 2), num("rotation"), nums("scale", 2), size("texCoord")};
constexpr std::array kSlotExtensions{object("KHR_texture_transform", kTransform)};
constexpr std::array kSlot{required(index("index", "textures")), size("texCoord"), num("scale"),
                           num("strength"), object("extensions", kSlotExtensions)};
constexpr std::array kPbr{nums("baseColorFactor", 4), object("baseColorTexture", kSlot),
                          num("metallicFactor"), num("roughnessFactor"),
                          object("metallicRoughnessTexture", kSlot)};
constexpr std::array kEmissiveStrength{num("emissiveStrength")};
constexpr std::array kIor{num("ior")};
constexpr std::array kTransmission{num("transmissionFactor"), object("transmissionTexture", kSlot)};
constexpr std::array kVolume{num("thicknessFactor"), num("attenuationDistance"), nums("attenuationColor", 3)};
constexpr std::array kSpecular{num("specularFactor"), object("specularTexture", kSlot),
                               nums("specularColorFactor", 3), object("specularColorTexture", kSlot)};
constexpr std::array kMaterialExtensions{object("KHR_materials_emissive_strength", kEmissiveStrength),
                                         object("KHR_materials_ior", kIor),
                                         object("KHR_materials_transmission", kTransmission),
                                         object("KHR_materials_volume", kVolume),
                                         object("KHR_materials_specular", kSpecular),
                                         object("KHR_materials_unlit", {})};
constexpr std::array kMaterial{text("name"),
                               object("pbrMetallicRoughness", kPbr),
                               object("normalTexture", kSlot),
                               object("occlusionTexture", kSlot),
                               object("emissiveTexture", kSlot),
                               nums("emissiveFactor", 3),
                               text("alphaMode"),
                               num("alphaCutoff"),
                               flag("doubleSided"),
                               object("extensions", kMaterialExtensions)};
constexpr std::array kRoot{required(object("asset", kAsset)),
                           texts("extensionsUsed"),
                           texts("extensionsRequired"),
                           index("scene", "scenes"),
                           objects("scenes", kScene),
                           objects("nodes", kNode),
                           objects("meshes", kMesh),
                           objects("accessors", kAccessor),
                           objects("bufferViews", kView),
                           objects("buffers", kBuffer),
                           objects("materials", kMaterial),
                           objects("textures", kTexture),
                           objects("images", kImage),
                           objects("samplers", kSampler),
                           objects("skins", kSkin),
                           objects("cameras", kCamera),
                           object("extensions", kRootExtensions)};

/// The way to a property, kept as a list on the stack: it becomes text only when something is wrong.
struct Where {
  const Where* parent = nullptr;
  std::string_view key = {};
  std::size_t element = kNone;
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
};

std::string textOf(const Where& where) {
  std::string text = where.parent ? textOf(*where.parent) : std::string();
  if (where.element != Where::kNone) return text + fmt::format("[{}]", where.element);
  if (!text.empty()) text += '.';
  return text + std::string(where.key.substr(0, 60));
}

/// Largest integer that every JSON writer can express: offsets and counts above it are refused, so that sums
/// and products of two of them by small strides never overflow 64 bits.
constexpr double kLargestInteger = 9007199254740992.0;
constexpr double kLargestIndex = 2147483647.0;

class Checker {
 public:
  Checker(const Document& document, const Json& root) : document_(document) {
    for (const Field& field : kRoot) {
      if (field.kind == Kind::Objects && root.contains(field.key))
        counts_[field.key] = root[field.key].size();
    }
    const auto lights = Json::json_pointer("/extensions/KHR_lights_punctual/lights");
    if (root.contains(lights)) counts_["lights"] = root[lights].size();
  }

  Json object(const Json& in, std::span<const Field> fields, const Where& where) const {
    if (!in.is_object()) wrong(where, "must be an object");
    Json out = Json::object();
    for (const Field& field : fields) {
      const auto found = in.find(field.key);
      if (found == in.end() || found->is_null()) {
        if (field.isRequired) wrong({&where, field.key}, "is missing");
        continue;
      }
      out[field.key] = value(*found, field, {&where, field.key});
    }
    return out;
  }

 private:
  [[noreturn]] void wrong(const Where& where, std::string_view what) const {
    document_.fail(fmt::format("{} {}", textOf(where), what));
  }

  Json value(const Json& in, const Field& field, const Where& where) const {
    switch (field.kind) {
      case Kind::Index:
        return indexValue(in, field, where);
      case Kind::Size:
        return integer(in, kLargestInteger, where);
      case Kind::Number:
        return numberValue(in, where);
      case Kind::Flag:
        if (!in.is_boolean()) wrong(where, "must be true or false");
        return in;
      case Kind::Text:
        return textValue(in, where);
      case Kind::Object:
        return object(in, field.fields, where);
      case Kind::Map:
        return map(in, field, where);
      case Kind::Raw:
        return in;
      default:
        return array(in, field, where);
    }
  }

  Json array(const Json& in, const Field& field, const Where& where) const {
    if (!in.is_array()) wrong(where, "must be an array");
    if (field.kind == Kind::Numbers && field.length > 0 && in.size() != field.length) {
      wrong(where, fmt::format("must have {} numbers, but has {}", field.length, in.size()));
    }
    Json out = Json::array();
    for (std::size_t i = 0; i < in.size(); ++i) {
      const Where element{&where, {}, i};
      switch (field.kind) {
        case Kind::Numbers:
          out.push_back(numberValue(in[i], element));
          break;
        case Kind::Texts:
          out.push_back(textValue(in[i], element));
          break;
        case Kind::Indices:
          out.push_back(indexValue(in[i], field, element));
          break;
        case Kind::Maps:
          out.push_back(map(in[i], field, element));
          break;
        default:
          out.push_back(object(in[i], field.fields, element));
          break;
      }
    }
    return out;
  }

  Json map(const Json& in, const Field& field, const Where& where) const {
    if (!in.is_object()) wrong(where, "must be an object");
    Json out = Json::object();
    for (const auto& [key, element] : in.items()) out[key] = indexValue(element, field, {&where, key});
    return out;
  }

  Json textValue(const Json& in, const Where& where) const {
    if (!in.is_string()) wrong(where, "must be a string");
    return in;
  }

  Json numberValue(const Json& in, const Where& where) const {
    if (!in.is_number()) wrong(where, "must be a number");
    return in.get<double>();
  }

  Json integer(const Json& in, double largest, const Where& where) const {
    if (!in.is_number()) wrong(where, "must be an integer");
    const double number = in.get<double>();
    if (number < 0.0) wrong(where, "must not be negative");
    if (number > largest) wrong(where, "is too large");
    if (std::floor(number) != number) wrong(where, "must be an integer");
    return static_cast<std::uint64_t>(number);
  }

  Json indexValue(const Json& in, const Field& field, const Where& where) const {
    const Json out = integer(in, kLargestIndex, where);
    const auto number = out.get<std::uint64_t>();
    if (field.target) {
      const auto count = counts_.find(field.target);
      const std::size_t size = count == counts_.end() ? 0 : count->second;
      if (number >= size) {
        wrong(where, fmt::format("is {}, but there are {} {}", number, size, field.target));
      }
    }
    bool legal = field.oneOf.empty();
    for (const int allowed : field.oneOf) legal = legal || number == static_cast<std::uint64_t>(allowed);
    if (!legal) wrong(where, fmt::format("has the unknown value {}", number));
    return out;
  }

  const Document& document_;
  std::map<std::string_view, std::size_t> counts_;
};

void dropKeys(Json& json, std::span<const char* const> keys) {
  if (json.is_object()) {
    for (const char* key : keys) json.erase(key);
  }
  if (json.is_structured()) {
    for (Json& element : json) dropKeys(element, keys);
  }
}

}  // namespace

Json checkedCopy(const Document& document, const Json& json) {
  if (!json.is_object()) document.fail("not a glTF file: its JSON is not an object");
  return Checker(document, json).object(json, kRoot, {});
}

Json descriptionOnly(const Json& checked) {
  Json out = checked;
  out.erase("buffers");
  out.erase("images");
  static constexpr std::array<const char*, 2> kKeys{"extensions", "extras"};
  dropKeys(out, kKeys);
  return out;
}

bool nestsTooDeep(std::string_view json) {
  constexpr int kDeepest = 200;
  int depth = 0;
  bool inText = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (inText) {
      if (c == '\\') ++i;
      if (c == '"') inText = false;
    } else if (c == '"') {
      inText = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepest) return true;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return false;
}

}  // namespace whittle::gltf
