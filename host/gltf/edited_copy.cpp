// See edited_copy.h. Lights: KHR_lights_punctual; materials: glTF 2.0, 3.9, and the extensions' own texts.
#include "gltf/edited_copy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <vector>

#include "gltf/container.h"
#include "gltf/edited_container.h"
#include "gltf/nodes.h"
#include "scene/machine_memory.h"
#include "scene/whole_file.h"

namespace whittle {
namespace gltf {
namespace {

constexpr const char* kLightsExtension = "KHR_lights_punctual";

/// The unit vector whose components round to those of `v`, a unit vector that was rounded: brought to unit
/// length `v` itself may round elsewhere. Each component goes the same share of its last place.
glm::dvec3 unitThatRoundsTo(const glm::vec3& v) {
  const glm::dvec3 rounded(v);
  glm::dvec3 lastPlace(0.0);  // half of it, away from 0
  for (int i = 0; i < 3; ++i) {
    const float next = std::nextafter(v[i], std::copysign(2.0F, v[i]));
    if (v[i] != 0.0F) lastPlace[i] = 0.5 * (static_cast<double>(next) - rounded[i]);
  }
  const double share = (1.0 - glm::dot(rounded, rounded)) / (2.0 * glm::dot(rounded, lastPlace));
  return rounded + std::clamp(share, -1.0, 1.0) * lastPlace;
}

/// Keys keep their order.
using Ordered = nlohmann::ordered_json;

/// The number with the fewest digits that is read as this float.
double shortest(float value) { return std::strtod(fmt::format("{}", value).c_str(), nullptr); }

Ordered listOf(const auto& v) {
  Ordered list = Ordered::array();
  for (int i = 0; i < v.length(); ++i) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(v[i])>, float>)
      list.push_back(shortest(v[i]));
    else
      list.push_back(v[i]);
  }
  return list;
}

/// The object under `key`; what is none gives way.
Ordered& objectIn(Ordered& parent, const char* key) {
  Ordered& child = parent[key];
  if (!child.is_object()) child = Ordered::object();
  return child;
}
Ordered& listIn(Ordered& parent, const char* key) {
  Ordered& child = parent[key];
  if (!child.is_array()) child = Ordered::array();
  return child;
}

class Editor {
 public:
  Editor(Document& document, const EditedScene& scene, Ordered& root)
      : document_(document),
        scene_(scene),
        root_(root),
        hierarchy_(readHierarchy(document, scene.sceneName, *document.notices)) {}

  /// How many lights and materials differ.
  std::size_t apply() {
    std::size_t edits = 0;
    bool addsOwn = false;
    for (std::size_t i = 0; i < scene_.after.lights.size(); ++i) {
      const Light &before = scene_.before.lights[i], &after = scene_.after.lights[i];
      if (!differs(before, after) || standsForOthers(after.kind)) continue;  // which glTF cannot say
      ++edits;
      if (after.node < 0)
        addsOwn = true;
      else
        editLight(before, after);
    }
    if (addsOwn)
      for (const Light& light : scene_.after.lights)
        if (light.node < 0 && !standsForOthers(light.kind)) addLight(light);
    for (std::size_t i = 0; i < scene_.after.materials.size(); ++i) {
      const Material &before = scene_.before.materials[i], &after = scene_.after.materials[i];
      if (!differs(before, after)) continue;
      ++edits;
      editMaterial(before, after, materialOf(after.index));
    }
    return edits;
  }

 private:
  [[noreturn]] void failChanged() const { document_.fail("has changed since it was read"); }

  void use(const char* name) {
    Ordered& used = listIn(root_, "extensionsUsed");
    if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
  }

  Ordered& extensionOf(Ordered& thing, const char* name) {
    use(name);
    return objectIn(objectIn(thing, "extensions"), name);
  }

  Ordered& lights() { return listIn(objectIn(objectIn(root_, "extensions"), kLightsExtension), "lights"); }

  void editLight(const Light& before, const Light& after) {
    const auto node = at(after.node);
    if (node >= document_.nodes.size() || document_.nodes[node].light < 0) failChanged();
    if (before.intensity != after.intensity) writeIntensity(after, ownLight(node));
    if (before.innerConeAngle != after.innerConeAngle || before.outerConeAngle != after.outerConeAngle)
      writeCone(after, ownLight(node));
    if (before.position != after.position || before.direction != after.direction)
      placeLight(node, before, after);
  }

  /// The light of this node alone: one that several nodes have is copied.
  Ordered& ownLight(std::size_t node) {
    int& index = document_.nodes[node].light;
    const auto users = std::count_if(document_.nodes.begin(), document_.nodes.end(),
                                     [&](const Node& n) { return n.light == index; });
    if (users > 1) {
      Ordered copy = lights()[at(index)];
      index = static_cast<int>(lights().size());
      lights().push_back(std::move(copy));
      root_["nodes"][node]["extensions"][kLightsExtension]["light"] = index;
    }
    return lights()[at(index)];
  }

  /// The loader multiplies the two in double precision and rounds once: to the same floats.
  static void writeIntensity(const Light& light, Ordered& out) {
    const double intensity = shortest(std::max({light.intensity.x, light.intensity.y, light.intensity.z}));
    out["intensity"] = intensity;
    if (intensity > 0.0) out["color"] = listOf(glm::dvec3(light.intensity) / intensity);
  }

  static void writeCone(const Light& light, Ordered& out) {
    Ordered& spot = objectIn(out, "spot");
    spot["innerConeAngle"] = shortest(light.innerConeAngle);
    spot["outerConeAngle"] = shortest(light.outerConeAngle);
  }

  glm::dvec3 placeInFile(const Light& light) const {
    const glm::vec3& p = light.position;
    return glm::dvec3(shortest(p.x), shortest(p.y), shortest(p.z)) + scene_.origin;
  }

  /// Nothing but the light would move with the node.
  bool isAlone(std::size_t node) const {
    const Node& n = document_.nodes[node];
    const auto& skins = document_.model.skins;
    const bool isJoint = std::any_of(skins.begin(), skins.end(), [&](const tinygltf::Skin& skin) {
      return std::find(skin.joints.begin(), skin.joints.end(), static_cast<int>(node)) != skin.joints.end();
    });
    return n.mesh < 0 && n.camera < 0 && n.children.empty() && !isJoint;
  }

  glm::dmat4 parentToWorld(std::size_t node) const {
    for (std::size_t i = 0; i < document_.nodes.size(); ++i) {
      const auto& children = document_.nodes[i].children;
      if (std::find(children.begin(), children.end(), static_cast<int>(node)) != children.end())
        return hierarchy_.toWorld[i];
    }
    return glm::dmat4(1.0);
  }

  /// An animation that turns it could not turn a matrix (glTF 2.0, 3.5.3).
  bool isAnimated(std::size_t node) const {
    const Ordered none = Ordered::array();
    for (const Ordered& animation : root_.value("animations", none))
      for (const Ordered& channel : animation.value("channels", none))
        if (channel.value("target", Ordered::object()).value("node", -1) == static_cast<int>(node))
          return true;
    return false;
  }

  /// Moves and turns its node, or where others would go along, hangs it on a new first child: lights are in
  /// the order of the nodes, depth first.
  void placeLight(std::size_t node, const Light& before, const Light& after) {
    const bool moves = before.position != after.position, turns = before.direction != after.direction;
    const bool alone = isAlone(node) && !(turns && isAnimated(node));
    const glm::dmat4 frame = alone ? parentToWorld(node) : hierarchy_.toWorld[node];
    const glm::dmat4 toFrame = glm::inverse(frame);
    const glm::dmat4* const local = document_.nodes[node].local.get();
    glm::dvec3 place(alone && local ? (*local)[3] : glm::dvec4(0, 0, 0, 1));
    if (moves) place = glm::dvec3(toFrame * glm::dvec4(placeInFile(after), 1.0));
    const glm::dvec3 z = -(glm::dmat3(toFrame) * unitThatRoundsTo(after.direction));
    if (!std::isfinite(place.x + place.y + place.z) || (turns && !(glm::length(z) > 0.0)))
      document_.fail(fmt::format("{} cannot be moved or turned: it lies below a scale of 0",
                                 nodeLabel(document_, static_cast<int>(node))));
    Ordered transform = Ordered::object();
    if (turns)
      transform["matrix"] = matrixOf(z, place);
    else
      transform["translation"] = listOf(place);
    Ordered& json = root_["nodes"][node];
    if (!alone) return moveToChild(node, std::move(transform));
    if (Ordered& matrix = json["matrix"]; !turns && matrix.is_array() && matrix.size() == 16) {
      for (std::size_t i = 0; i < 3; ++i) matrix[12 + i] = place[static_cast<int>(i)];
      return;
    }
    json.erase("matrix");
    if (turns)
      for (const char* key : {"translation", "rotation", "scale"}) json.erase(key);
    json.update(transform);
  }

  /// `child`: its transform.
  void moveToChild(std::size_t node, Ordered child) {
    if (!document_.nodes[node].name.empty()) child["name"] = document_.nodes[node].name;
    child["extensions"][kLightsExtension]["light"] = document_.nodes[node].light;
    if (!document_.nodes[node].castsShadows()) child["extras"]["castsShadows"] = false;
    const std::size_t index = root_["nodes"].size();
    Ordered& json = root_["nodes"][node];
    json["extensions"].erase(kLightsExtension);
    if (json["extensions"].empty()) json.erase("extensions");
    Ordered& children = listIn(json, "children");
    children.insert(children.begin(), index);
    root_["nodes"].push_back(std::move(child));
  }

  /// With this +Z, which keeps its bits: a light shines along -Z, and a rotation would round it.
  static Ordered matrixOf(const glm::dvec3& z, const glm::dvec3& place) {
    const glm::dvec3 unit = glm::normalize(z);
    const glm::dvec3 aside = std::abs(unit.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(aside, unit)), y = glm::cross(unit, x);
    Ordered matrix = Ordered::array();
    for (const glm::dvec4& column :
         {glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(place, 1)})
      for (int i = 0; i < 4; ++i) matrix.push_back(column[i]);
    return matrix;
  }

  /// A node of its own among the scene's roots, with the light's direction as its -Z.
  void addLight(const Light& light) {
    use(kLightsExtension);
    const LightType& type = typeOf(light.kind);
    Ordered definition{{"name", light.name}, {"type", type.word}};
    writeIntensity(light, definition);
    if (type.hasCone) writeCone(light, definition);
    if (!light.castsShadows) definition["extras"]["castsShadows"] = false;
    const glm::dvec3 place = type.isPlaced ? placeInFile(light) : glm::dvec3(0.0);
    const Ordered matrix = matrixOf(-unitThatRoundsTo(light.direction), place);
    Ordered node{{"name", light.name}, {"matrix", matrix}};
    node["extensions"][kLightsExtension]["light"] = lights().size();
    lights().push_back(std::move(definition));
    Ordered& nodes = listIn(root_, "nodes");
    if (hierarchy_.scene >= 0) listIn(root_["scenes"][at(hierarchy_.scene)], "nodes").push_back(nodes.size());
    nodes.push_back(std::move(node));
  }

  /// -1: the default one becomes a real one, of all primitives that have none.
  Ordered& materialOf(int index) {
    Ordered& materials = listIn(root_, "materials");
    if (index >= 0) {
      if (at(index) >= materials.size()) failChanged();
      return materials[at(index)];
    }
    for (Ordered& mesh : listIn(root_, "meshes"))
      for (Ordered& primitive : mesh["primitives"])
        if (!primitive.contains("material")) primitive["material"] = materials.size();
    materials.push_back(Ordered{{"name", "default"}});
    return materials.back();
  }

  /// Of KHR_materials_pbrSpecularGlossiness: what a dielectric of ior 0 and a roughness cannot say is
  /// refused.
  void editSpecularGlossiness(const Material& before, const Material& after, Ordered& json, Ordered& e) {
    const bool hasTexture = after.metallicRoughnessTexture.used();
    if (before.metallic != after.metallic || before.transmission != after.transmission ||
        before.ior != after.ior || (before.roughness != after.roughness && hasTexture))
      document_.fail(fmt::format(
          "the material{} is of KHR_materials_pbrSpecularGlossiness, which has no {}", quotedName(after.name),
          before.roughness != after.roughness ? "factor of the roughness in its texture"
                                              : "metallic, transmission or ior"));
    if (before.baseColor != after.baseColor) e["diffuseFactor"] = listOf(after.baseColor);
    if (before.roughness != after.roughness)
      e["glossinessFactor"] = 1.0 - static_cast<double>(after.roughness);
    if (before.emission != after.emission) writeEmission(after.emission, json);
  }

  void editMaterial(const Material& before, const Material& after, Ordered& json) {
    if (const auto found = json.find("extensions"); found != json.end() && found->is_object())
      if (const auto e = found->find("KHR_materials_pbrSpecularGlossiness");
          e != found->end() && e->is_object())
        return editSpecularGlossiness(before, after, json, *e);
    const auto pbr = [&]() -> Ordered& { return objectIn(json, "pbrMetallicRoughness"); };
    if (before.baseColor != after.baseColor) pbr()["baseColorFactor"] = listOf(after.baseColor);
    if (before.metallic != after.metallic) pbr()["metallicFactor"] = shortest(after.metallic);
    if (before.roughness != after.roughness) pbr()["roughnessFactor"] = shortest(after.roughness);
    if (before.transmission != after.transmission)
      extensionOf(json, "KHR_materials_transmission")["transmissionFactor"] = shortest(after.transmission);
    if (before.ior != after.ior) extensionOf(json, "KHR_materials_ior")["ior"] = shortest(after.ior);
    if (before.emission != after.emission) writeEmission(after.emission, json);
  }

  /// Factors are at most 1; a power of two as strength changes no bit of their product.
  void writeEmission(const glm::vec3& emission, Ordered& json) {
    const float most = std::max({emission.x, emission.y, emission.z});
    const float strength = most > 1.0F ? std::exp2(std::ceil(std::log2(most))) : 1.0F;
    json["emissiveFactor"] = listOf(emission / strength);
    const auto extensions = json.find("extensions");
    const bool hasStrength = extensions != json.end() && extensions->is_object() &&
                             extensions->contains("KHR_materials_emissive_strength");
    if (strength != 1.0F || hasStrength)
      extensionOf(json, "KHR_materials_emissive_strength")["emissiveStrength"] = shortest(strength);
  }

  Document& document_;
  const EditedScene& scene_;
  Ordered& root_;
  Hierarchy hierarchy_;
};

}  // namespace
}  // namespace gltf

std::filesystem::path writeEditedCopy(const EditedScene& scene, const std::filesystem::path& copy) {
  gltf::Document document;
  MemoryBudget budget(memoryLimitOfMachine());
  document.budget = &budget;
  Notices unheard;
  gltf::openDocument(document, scene.file, unheard);
  try {
    auto root = nlohmann::ordered_json::parse(gltf::readText(document));
    if (gltf::Editor(document, scene, root).apply() == 0)
      throw InputError("nothing is edited that a file can hold");
    const std::filesystem::path name = gltf::freeName(document, copy);
    gltf::moveUris(document, name.parent_path(), root);
    writeWholeFile(name, gltf::containerWith(document, root.dump()));
    return name;
  } catch (const gltf::Json::exception& e) {
    document.fail(e.what());
  }
}

}  // namespace whittle
