// Nodes and meshes are in structures of their own; cameras, lights and materials are read from the checked
// JSON each time, so that a number is moved by writing it there: the tables of shapes.h say which there are.
#include "gltf/properties.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <span>
#include <string_view>

#include "gltf/shapes.h"

namespace whittle::gltf {
namespace {

using Tokens = std::vector<std::string_view>;
using Values = std::vector<double>;

const std::vector<double> kNoWeights;
constexpr const char* kUnknown = "unknown";
constexpr const char* kAbsent = "not in the file";

/// Of "/a/b": a, b. No property that is known has a name with `~` or `/` in it (RFC 6901).
Tokens tokensOf(std::string_view pointer) {
  Tokens tokens;
  while (pointer.starts_with('/')) {
    const std::size_t end = pointer.find('/', 1);
    tokens.push_back(pointer.substr(1, end == std::string_view::npos ? end : end - 1));
    pointer = end == std::string_view::npos ? std::string_view() : pointer.substr(end);
  }
  return tokens;
}

/// An element of an array of `size`; nothing for other words.
std::optional<int> elementIn(std::string_view token, std::size_t size) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), number);
  const bool isWhole = error == std::errc{} && end == token.data() + token.size();
  if (!isWhole || (token.size() > 1 && token[0] == '0') || number >= size) return std::nullopt;
  return static_cast<int>(number);
}

std::size_t targetsOf(const Document& document, int mesh) {
  if (mesh < 0) return 0;
  const auto& primitives = document.model.meshes[at(mesh)].primitives;
  return primitives.empty() ? 0 : primitives[0].targets.size();
}

/// All weights, or that which the token behind them names.
FoundProperty weights(std::span<const std::string_view> rest, std::vector<double>& all, std::size_t targets,
                      const std::vector<double>& otherwise) {
  if (rest.empty()) return {Property{Property::Type::List, 0, [&all](const Values& v) { all = v; }}};
  const auto one = elementIn(rest[0], targets);
  if (rest.size() > 1 || !one) return {std::nullopt, kAbsent};
  return {Property{Property::Type::Number, 1, [&all, &otherwise, targets, i = at(*one)](const Values& v) {
                     if (all.empty()) all = otherwise;
                     if (all.size() < targets) all.resize(targets);
                     all[i] = v[0];
                   }}};
}

/// Translation, rotation or scale.
FoundProperty transform(Node& node, std::string_view name) {
  Node::Parts& parts = *node.rare->parts;
  if (parts.isMatrix) return {std::nullopt, "its node has a matrix"};
  const auto compose = [&node, &parts] {
    node.local = std::make_unique<glm::dmat4>(composed(parts.translation, parts.rotation, parts.scale));
  };
  if (name == "rotation")
    return {Property{Property::Type::Turn, 4, [&parts, compose](const Values& v) {
                       parts.rotation = {v[0], v[1], v[2], v[3]};
                       compose();
                     }}};
  glm::dvec3& part = name == "scale" ? parts.scale : parts.translation;
  return {Property{Property::Type::Vector, 3, [&part, compose](const Values& v) {
                     part = {v[0], v[1], v[2]};
                     compose();
                   }}};
}

FoundProperty ofNode(Document& document, int index, std::span<const std::string_view> rest) {
  constexpr std::array kVisible{std::string_view("extensions"), std::string_view("KHR_node_visibility"),
                                std::string_view("visible")};
  Node& node = document.nodes[at(index)];
  if (rest.size() == 1 && (rest[0] == "translation" || rest[0] == "rotation" || rest[0] == "scale"))
    return transform(node, rest[0]);
  if (rest[0] == "weights") {
    const auto& meshes = document.model.meshes;
    return weights(rest.subspan(1), node.rare->weights, targetsOf(document, node.mesh),
                   node.mesh < 0 ? kNoWeights : meshes[at(node.mesh)].weights);
  }
  if (!std::equal(rest.begin(), rest.end(), kVisible.begin(), kVisible.end()))
    return {std::nullopt, kUnknown};
  node.comesAndGoes = true;
  return {Property{Property::Type::Flag, 1, [&node](const Values& v) { node.isVisible = v[0] != 0.0; }}};
}

/// Moves what a factor alone does not say: tangents are made along textures as they are laid.
bool laysTextures(const Tokens& tokens) {
  const auto has = [&](std::string_view token) {
    return std::find(tokens.begin(), tokens.end(), token) != tokens.end();
  };
  return has("KHR_materials_anisotropy") ||
         (has("KHR_texture_transform") && (has("normalTexture") || has("clearcoatNormalTexture")));
}

/// A number, or some, of the checked JSON.
FoundProperty inJson(Json& owner, const Field& field) {
  const std::string_view key = field.key;
  // Without a default value, so that the file must have them.
  for (const std::string_view bare : {"zfar", "aspectRatio", "range"})
    if (key == bare && !owner.contains(field.key)) return {std::nullopt, kAbsent};
  if (field.kind == Kind::Number)
    return {Property{Property::Type::Number, 1,
                     [&owner, name = field.key](const Values& v) { owner[name] = v[0]; }}};
  if (field.kind == Kind::Numbers && field.length > 0)
    return {Property{Property::Type::Vector, field.length,
                     [&owner, name = field.key](const Values& v) { owner[name] = v; }}};
  return {std::nullopt, kUnknown};
}

/// Follows the tokens through the tables and the file at once. A part of an archived extension that becomes
/// an image is none of it.
FoundProperty ofAppearance(Document& document, const Tokens& tokens) {
  std::span<const Field> fields = rootFields();
  Json* json = &document.json;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const auto field =
        std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return tokens[i] == f.key; });
    if (field == fields.end() || tokens[i] == "KHR_materials_pbrSpecularGlossiness")
      return {std::nullopt, kUnknown};
    if (i + 1 == tokens.size()) return inJson(*json, *field);
    const auto found = json->find(field->key);
    if (found == json->end()) return {std::nullopt, kAbsent};
    json = &*found;
    fields = field->fields;
    if (field->kind != Kind::Objects) continue;
    const auto element = elementIn(tokens[++i], json->size());
    if (!element) return {std::nullopt, kAbsent};
    json = &(*json)[at(*element)];
  }
  return {std::nullopt, kUnknown};
}

/// Notes whose property it is.
void note(const Tokens& tokens, int index, Moved& moved) {
  if (tokens[0] == "materials") {
    moved.materials.insert(index);
    moved.tangents |= laysTextures(tokens);
  } else {
    (tokens[0] == "cameras" ? moved.cameras : moved.lights).insert(index);
  }
}

}  // namespace

FoundProperty propertyAt(Document& document, const std::string& pointer, Moved& moved) {
  const Tokens tokens = tokensOf(pointer);
  const bool isLight = tokens.size() > 4 && tokens[0] == "extensions" && tokens[1] == "KHR_lights_punctual" &&
                       tokens[2] == "lights";
  const std::size_t place = isLight ? 3 : 1;  // of the element's number
  if (tokens.size() < place + 2) return {std::nullopt, kUnknown};
  const std::span<const std::string_view> rest = std::span(tokens).subspan(place + 1);
  if (tokens[0] == "nodes") {
    const auto node = elementIn(tokens[1], document.nodes.size());
    if (!node) return {std::nullopt, kAbsent};
    FoundProperty found = ofNode(document, *node, rest);
    if (found.property) moved.nodes[at(*node)] = true;
    return found;
  }
  if (tokens[0] == "meshes") {
    const auto mesh = elementIn(tokens[1], document.model.meshes.size());
    if (!mesh) return {std::nullopt, kAbsent};
    if (rest[0] != "weights") return {std::nullopt, kUnknown};
    FoundProperty found = weights(rest.subspan(1), document.model.meshes[at(*mesh)].weights,
                                  targetsOf(document, *mesh), kNoWeights);
    if (found.property) moved.meshes.insert(*mesh);
    return found;
  }
  if (!isLight && tokens[0] != "materials" && tokens[0] != "cameras") return {std::nullopt, kUnknown};
  FoundProperty found = ofAppearance(document, tokens);
  if (found.property) note(tokens, *elementIn(tokens[place], std::numeric_limits<int>::max()), moved);
  return found;
}

}  // namespace whittle::gltf
