// Transforms of a mesh's copies: EXT_mesh_gpu_instancing, and the joints of a skin.
#include "gltf/instances.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "gltf/accessor.h"
#include "gltf/nodes.h"

namespace whittle::gltf {

namespace {

struct InstanceAttribute {
  std::vector<float> values;
  std::size_t count = 0;
  int components = 0;

  bool exists() const { return components > 0; }
  double at(std::size_t instance, int c) const {
    return static_cast<double>(
        values[instance * static_cast<std::size_t>(components) + static_cast<std::size_t>(c)]);
  }
  glm::dvec3 vec3(std::size_t i, double absent) const {
    return exists() ? glm::dvec3(at(i, 0), at(i, 1), at(i, 2)) : glm::dvec3(absent);
  }
  glm::dvec4 quaternion(std::size_t i) const {
    return exists() ? glm::dvec4(at(i, 0), at(i, 1), at(i, 2), at(i, 3)) : glm::dvec4(0, 0, 0, 1);
  }
};

using Attributes = std::vector<std::pair<std::string, int>>;

InstanceAttribute readAttribute(Document& document, const Attributes& attributes, const char* name,
                                int components, const std::string& label) {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [name](const auto& attribute) { return attribute.first == name; });
  if (found == attributes.end()) return {};
  const int accessor = found->second;
  const tinygltf::Accessor& a = accessorAt(document, accessor);
  const bool isLegal = componentCount(a) == components && a.type != TINYGLTF_TYPE_MAT2 &&
                       (isFloat(a) || (components == 4 && isSmallInteger(a) && a.normalized));
  if (!isLegal) document.fail(fmt::format("{}: the format of its instances' {} is not legal", label, name));
  return {readFloats(document, accessor), a.count, components};
}

}  // namespace

std::vector<glm::dmat4> instanceTransforms(Document& document, int node, const glm::dmat4& nodeToWorld) {
  const Node& n = document.nodes[at(node)];
  if (!n.rare || !n.rare->instancing) return {nodeToWorld};
  const std::string label = nodeLabel(document, node);
  const Attributes& attributes = *n.rare->instancing;
  const auto translation = readAttribute(document, attributes, "TRANSLATION", 3, label);
  const auto rotation = readAttribute(document, attributes, "ROTATION", 4, label);
  const auto scale = readAttribute(document, attributes, "SCALE", 3, label);

  std::optional<std::size_t> count;
  for (const InstanceAttribute* attribute : {&translation, &rotation, &scale}) {
    if (!attribute->exists()) continue;
    if (count && *count != attribute->count) {
      document.fail(
          fmt::format("{}: its instances have {} and {} elements", label, *count, attribute->count));
    }
    count = attribute->count;
  }
  if (!count) return {nodeToWorld};  // only attributes of an application's own
  std::vector<glm::dmat4> transforms;
  transforms.reserve(*count);
  for (std::size_t i = 0; i < *count; ++i) {
    transforms.push_back(nodeToWorld *
                         composed(translation.vec3(i, 0.0), rotation.quaternion(i), scale.vec3(i, 1.0)));
  }
  return transforms;
}

std::vector<glm::dmat4> jointTransforms(Document& document, int skin,
                                        const std::vector<glm::dmat4>& toWorld) {
  const tinygltf::Skin& s = document.model.skins[static_cast<std::size_t>(skin)];
  if (s.joints.empty()) document.fail(fmt::format("skins[{}] has no joints", skin));
  std::vector<float> inverseBind;
  if (s.inverseBindMatrices >= 0) {
    const tinygltf::Accessor& a = accessorAt(document, s.inverseBindMatrices);
    if (a.type != TINYGLTF_TYPE_MAT4 || !isFloat(a) || a.count < s.joints.size()) {
      document.fail(
          fmt::format("skins[{}]: inverseBindMatrices must be a float matrix for each joint", skin));
    }
    inverseBind = readFloats(document, s.inverseBindMatrices);
  }
  std::vector<glm::dmat4> transforms;
  transforms.reserve(s.joints.size());
  for (std::size_t j = 0; j < s.joints.size(); ++j) {
    glm::dmat4 bind(1.0);
    for (std::size_t i = 0; !inverseBind.empty() && i < 16; ++i) {
      bind[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = static_cast<double>(inverseBind[16 * j + i]);
    }
    transforms.push_back(toWorld[static_cast<std::size_t>(s.joints[j])] * bind);
  }
  return transforms;
}

}  // namespace whittle::gltf
