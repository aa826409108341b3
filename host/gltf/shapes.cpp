// The properties that are read. The tables follow the JSON schemas of glTF 2.0 and
// of the extensions that are read.
#include "gltf/shapes.h"

#include <algorithm>
#include <array>

namespace whittle::gltf {

namespace {

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

/// How things look or are called: a picture without it is better than none.
constexpr Field forgiven(Field field) {
  field.isForgiven = true;
  return field;
}
/// The same for all properties that an object may do without.
template <std::size_t n>
constexpr std::array<Field, n> forgiving(std::array<Field, n> fields) {
  for (Field& field : fields) field.isForgiven = !field.isRequired;
  return fields;
}
/// A colour with alpha, or without it: opaque.
constexpr Field colourWithAlpha(const char* key) {
  Field field = nums(key, 4);
  field.least = 3;
  return field;
}

constexpr std::array kComponentTypes{5120, 5121, 5122, 5123, 5125, 5126};
constexpr std::array kIndexTypes{5121, 5123, 5125};
constexpr std::array kModes{0, 1, 2, 3, 4, 5, 6};
constexpr std::array kWraps{10497, 33071, 33648};
constexpr std::array kMagFilters{9728, 9729};
constexpr std::array kMinFilters{9728, 9729, 9984, 9985, 9986, 9987};

constexpr std::array kAsset{required(text("version")), text("minVersion")};
constexpr std::array kBuffer{required(size("byteLength")), text("uri")};
constexpr std::array kMeshopt{required(index("buffer", "buffers")),
                              size("byteOffset"),
                              required(size("byteLength")),
                              required(size("byteStride")),
                              required(size("count")),
                              required(text("mode")),
                              text("filter")};
constexpr std::array kViewExtensions{object("EXT_meshopt_compression", kMeshopt),
                                     object("KHR_meshopt_compression", kMeshopt)};
constexpr std::array kView{required(index("buffer", "buffers")), size("byteOffset"),
                           required(size("byteLength")), size("byteStride"),
                           object("extensions", kViewExtensions)};
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
constexpr std::array kDracoPrimitive{required(index("bufferView", "bufferViews")),
                                     required(Field{"attributes", Kind::Map})};
constexpr std::array kVariantMapping{required(index("material", "materials")),
                                     required(indices("variants", "variants"))};
constexpr std::array kVariantMappings{required(objects("mappings", kVariantMapping))};
constexpr std::array kPrimitiveExtensions{object("KHR_draco_mesh_compression", kDracoPrimitive),
                                          forgiven(object("KHR_materials_variants", kVariantMappings))};
constexpr std::array kPrimitive{required(Field{"attributes", Kind::Map, "accessors"}),
                                forgiven(index("indices", "accessors")),
                                forgiven(index("material", "materials")),
                                code("mode", kModes),
                                Field{"targets", Kind::Maps, "accessors"},
                                object("extensions", kPrimitiveExtensions)};
constexpr std::array kMesh{required(objects("primitives", kPrimitive)), nums("weights", 0),
                           forgiven(text("name"))};
constexpr std::array kInstancing{required(Field{"attributes", Kind::Map, "accessors"})};
constexpr std::array kNodeLight{required(index("light", "lights"))};
constexpr auto kVisibility = forgiving(std::array{flag("visible")});
constexpr std::array kNodeExtensions{forgiven(object("KHR_lights_punctual", kNodeLight)),
                                     forgiven(object("KHR_node_visibility", kVisibility)),
                                     object("EXT_mesh_gpu_instancing", kInstancing)};
constexpr std::array kNode{forgiven(text("name")),
                           indices("children", "nodes"),
                           forgiven(index("mesh", "meshes")),
                           forgiven(index("skin", "skins")),
                           forgiven(index("camera", "cameras")),
                           nums("matrix", 16),
                           nums("translation", 3),
                           nums("rotation", 4),
                           nums("scale", 3),
                           nums("weights", 0),
                           object("extensions", kNodeExtensions),
                           raw("extras")};
constexpr std::array kScene{forgiven(text("name")), indices("nodes", "nodes"), raw("extras")};
constexpr std::array kSkin{forgiven(text("name")), required(indices("joints", "nodes")),
                           forgiven(index("inverseBindMatrices", "accessors"))};
constexpr std::array kPerspective{required(num("yfov")), required(num("znear")), num("aspectRatio"),
                                  num("zfar")};
constexpr std::array kOrthographic{required(num("xmag")), required(num("ymag")), required(num("znear")),
                                   required(num("zfar"))};
constexpr std::array kCamera{forgiven(text("name")), required(text("type")),
                             object("perspective", kPerspective), object("orthographic", kOrthographic)};
constexpr auto kSpot = forgiving(std::array{num("innerConeAngle"), num("outerConeAngle")});
constexpr auto kLight =
    forgiving(std::array{text("name"), required(text("type")), nums("color", 3), num("intensity"),
                         num("range"), object("spot", kSpot), raw("extras")});
constexpr std::array kLights{required(objects("lights", kLight))};
constexpr auto kVariant = forgiving(std::array{text("name")});
constexpr std::array kVariants{required(objects("variants", kVariant))};
constexpr std::array kRootExtensions{object("KHR_lights_punctual", kLights),
                                     object("KHR_materials_variants", kVariants)};

constexpr auto kSampler = forgiving(std::array{code("magFilter", kMagFilters), code("minFilter", kMinFilters),
                                               code("wrapS", kWraps), code("wrapT", kWraps)});
constexpr auto kImage =
    forgiving(std::array{text("uri"), text("mimeType"), index("bufferView", "bufferViews"), text("name")});
constexpr auto kTexture =
    forgiving(std::array{index("sampler", "samplers"), index("source", "images"), raw("extensions")});
constexpr auto kTransform =
    forgiving(std::array{nums("offset", 2), num("rotation"), nums("scale", 2), size("texCoord")});
constexpr auto kSlotExtensions = forgiving(std::array{object("KHR_texture_transform", kTransform)});
constexpr auto kSlot =
    forgiving(std::array{required(index("index", "textures")), size("texCoord"), num("scale"),
                         num("strength"), object("extensions", kSlotExtensions)});
constexpr auto kPbr = forgiving(
    std::array{colourWithAlpha("baseColorFactor"), object("baseColorTexture", kSlot), num("metallicFactor"),
               num("roughnessFactor"), object("metallicRoughnessTexture", kSlot)});
constexpr auto kEmissiveStrength = forgiving(std::array{num("emissiveStrength")});
constexpr auto kIor = forgiving(std::array{num("ior")});
constexpr auto kTransmission =
    forgiving(std::array{num("transmissionFactor"), object("transmissionTexture", kSlot)});
constexpr auto kVolume =
    forgiving(std::array{num("thicknessFactor"), num("attenuationDistance"), nums("attenuationColor", 3)});
constexpr auto kSpecular =
    forgiving(std::array{num("specularFactor"), object("specularTexture", kSlot),
                         nums("specularColorFactor", 3), object("specularColorTexture", kSlot)});
constexpr auto kSpecularGlossiness = forgiving(
    std::array{colourWithAlpha("diffuseFactor"), object("diffuseTexture", kSlot), nums("specularFactor", 3),
               num("glossinessFactor"), object("specularGlossinessTexture", kSlot)});
constexpr auto kClearcoat = forgiving(
    std::array{num("clearcoatFactor"), object("clearcoatTexture", kSlot), num("clearcoatRoughnessFactor"),
               object("clearcoatRoughnessTexture", kSlot), object("clearcoatNormalTexture", kSlot)});
constexpr auto kSheen =
    forgiving(std::array{nums("sheenColorFactor", 3), object("sheenColorTexture", kSlot),
                         num("sheenRoughnessFactor"), object("sheenRoughnessTexture", kSlot)});
constexpr auto kIridescence =
    forgiving(std::array{num("iridescenceFactor"), object("iridescenceTexture", kSlot), num("iridescenceIor"),
                         num("iridescenceThicknessMinimum"), num("iridescenceThicknessMaximum"),
                         object("iridescenceThicknessTexture", kSlot)});
constexpr auto kAnisotropy = forgiving(
    std::array{num("anisotropyStrength"), num("anisotropyRotation"), object("anisotropyTexture", kSlot)});
constexpr auto kDispersion = forgiving(std::array{num("dispersion")});
constexpr auto kDiffuseTransmission = forgiving(
    std::array{num("diffuseTransmissionFactor"), object("diffuseTransmissionTexture", kSlot),
               nums("diffuseTransmissionColorFactor", 3), object("diffuseTransmissionColorTexture", kSlot)});
constexpr auto kMaterialExtensions = forgiving(std::array{
    object("KHR_materials_pbrSpecularGlossiness", kSpecularGlossiness),
    object("KHR_materials_emissive_strength", kEmissiveStrength), object("KHR_materials_ior", kIor),
    object("KHR_materials_transmission", kTransmission), object("KHR_materials_volume", kVolume),
    object("KHR_materials_specular", kSpecular), object("KHR_materials_unlit", {}),
    object("KHR_materials_clearcoat", kClearcoat), object("KHR_materials_sheen", kSheen),
    object("KHR_materials_iridescence", kIridescence), object("KHR_materials_anisotropy", kAnisotropy),
    object("KHR_materials_dispersion", kDispersion),
    object("KHR_materials_diffuse_transmission", kDiffuseTransmission)});
constexpr auto kMaterial = forgiving(std::array{
    text("name"), object("pbrMetallicRoughness", kPbr), object("normalTexture", kSlot),
    object("occlusionTexture", kSlot), object("emissiveTexture", kSlot), nums("emissiveFactor", 3),
    text("alphaMode"), num("alphaCutoff"), flag("doubleSided"), object("extensions", kMaterialExtensions)});
constexpr std::array kPointer{required(text("pointer"))};
constexpr std::array kTargetExtensions{object("KHR_animation_pointer", kPointer)};
constexpr std::array kChannelTarget{index("node", "nodes"), required(text("path")),
                                    object("extensions", kTargetExtensions)};
constexpr std::array kChannel{required(smallSize("sampler")), required(object("target", kChannelTarget))};
constexpr std::array kAnimationSampler{required(index("input", "accessors")),
                                       required(index("output", "accessors")), text("interpolation")};
constexpr std::array kAnimation{forgiven(text("name")), required(objects("channels", kChannel)),
                                required(objects("samplers", kAnimationSampler))};
constexpr std::array kAnimations{objects("animations", kAnimation)};
constexpr std::array kRoot{required(object("asset", kAsset)),
                           texts("extensionsUsed"),
                           texts("extensionsRequired"),
                           forgiven(index("scene", "scenes")),
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

bool hasExtension(std::span<const Field> fields, std::string_view name) {
  return std::any_of(fields.begin(), fields.end(), [&](const Field& field) {
    if (std::string_view(field.key) != "extensions") return hasExtension(field.fields, name);
    return std::any_of(field.fields.begin(), field.fields.end(),
                       [&](const Field& own) { return own.key == name || hasExtension(own.fields, name); });
  });
}

}  // namespace

std::span<const Field> rootFields() { return kRoot; }

std::span<const Field> animationFields() { return kAnimations; }

bool readsExtension(std::string_view name) {
  return hasExtension(kRoot, name) || hasExtension(kAnimations, name);
}

}  // namespace whittle::gltf
