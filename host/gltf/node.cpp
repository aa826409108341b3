// Nodes: glTF 2.0, 3.5.
#include "gltf/node.h"

#include <cmath>

#include "gltf/document.h"

namespace whittle::gltf {
namespace {

int indexIn(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? -1 : found->get<int>();
}

glm::dvec3 vec3Or(const Json& v, double fallback) {
  return v.size() == 3 ? glm::dvec3(v[0].get<double>(), v[1].get<double>(), v[2].get<double>())
                       : glm::dvec3(fallback);
}

Node::Parts partsOf(const Json& node) {
  Node::Parts parts;
  const Json& r = child(node, "rotation");
  if (r.size() == 4)
    parts.rotation = {r[0].get<double>(), r[1].get<double>(), r[2].get<double>(), r[3].get<double>()};
  parts.translation = vec3Or(child(node, "translation"), 0.0);
  parts.scale = vec3Or(child(node, "scale"), 1.0);
  parts.isMatrix = child(node, "matrix").size() == 16;
  return parts;
}

std::unique_ptr<glm::dmat4> localTransform(const Json& node) {
  const Json& matrix = child(node, "matrix");
  if (matrix.size() == 16) {
    auto m = std::make_unique<glm::dmat4>();
    for (int i = 0; i < 16; ++i) (*m)[i / 4][i % 4] = matrix[at(i)].get<double>();
    return m;
  }
  if (!node.contains("translation") && !node.contains("rotation") && !node.contains("scale")) return nullptr;
  const Node::Parts parts = partsOf(node);
  return std::make_unique<glm::dmat4>(composed(parts.translation, parts.rotation, parts.scale));
}

}  // namespace

const std::vector<double>& Node::weights() const {
  static const std::vector<double> kNone;
  return rare ? rare->weights : kNone;
}

Node nodeFrom(const Json& checked, bool keepParts) {
  Node node;
  if (const auto found = checked.find("name"); found != checked.end()) node.name = found->get<std::string>();
  node.mesh = indexIn(checked, "mesh");
  node.skin = indexIn(checked, "skin");
  node.camera = indexIn(checked, "camera");
  if (const Json* light = extension(checked, "KHR_lights_punctual")) node.light = indexIn(*light, "light");
  if (const Json* e = extension(checked, "KHR_node_visibility")) node.isVisible = e->value("visible", true);
  if (const auto found = checked.find("children"); found != checked.end())
    node.children = found->get<std::vector<int>>();
  node.local = localTransform(checked);
  Node::Rare rare;
  const auto weights = checked.find("weights");
  if (weights != checked.end()) rare.weights = weights->get<std::vector<double>>();
  if (const Json* instancing = extension(checked, "EXT_mesh_gpu_instancing")) {
    rare.instancing.emplace();
    for (const auto& [name, accessor] : (*instancing)["attributes"].items())
      rare.instancing->emplace_back(name, accessor.get<int>());
  }
  rare.castsShadows = leavesShadows(child(checked, "extras"));
  if (keepParts) rare.parts = partsOf(checked);
  if (!rare.weights.empty() || rare.instancing || !rare.castsShadows || keepParts)
    node.rare = std::make_unique<Node::Rare>(std::move(rare));
  return node;
}

glm::dmat4 composed(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale) {
  const double length = glm::length(rotation);
  const glm::dvec4 q = length > 0.0 && std::isfinite(length) ? rotation / length : glm::dvec4(0, 0, 0, 1);
  const double x = q.x, y = q.y, z = q.z, w = q.w;
  glm::dmat4 m(1.0);
  m[0] = glm::dvec4(1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0) * scale.x;
  m[1] = glm::dvec4(2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0) * scale.y;
  m[2] = glm::dvec4(2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0) * scale.z;
  m[3] = glm::dvec4(translation, 1.0);
  return m;
}

bool leavesShadows(const Json& extras) {
  if (!extras.is_object()) return true;
  const auto found = extras.find("castsShadows");
  return found == extras.end() || !found->is_boolean() || found->get<bool>();
}

}  // namespace whittle::gltf
