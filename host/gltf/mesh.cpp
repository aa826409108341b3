// Reads mesh primitives. Attributes and their formats: glTF 2.0, 3.7.2, and
// KHR_mesh_quantization; morph targets: 3.7.2.2.
#include "gltf/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "gltf/accessor.h"
#include "gltf/topology.h"
#include "scene/material_predicates.h"

namespace whittle::gltf {

namespace {

/// The formats an attribute may have. With KHR_mesh_quantization integers serve as positions and coordinates
/// as they are.
struct Format {
  int leastComponents;
  int mostComponents;
  bool plainIntegers;  ///< small integers that are not normalised are legal
  bool isUnsigned;     ///< integers must be unsigned
};
constexpr Format kPosition{3, 3, true, false};
constexpr Format kDirection{3, 3, false, false};
constexpr Format kTangent{4, 4, false, false};
constexpr Format kCoordinate{2, 2, true, false};
constexpr Format kColour{3, 4, false, true};
constexpr Format kWeights{4, 4, false, true};

/// Something else than a normal map asks for tangents.
bool isLaidAlongTangents(const Material& m) {
  return (isCoated(m) && m.clearcoatNormalTexture.used()) || isAnisotropic(m);
}

/// The texture along which tangents lie; where none has to, one of the first set of coordinates, as it is.
const TextureSlot& tangentSlot(const Material& m) {
  for (const auto slot : {&Material::normalTexture, &Material::clearcoatNormalTexture})
    if ((m.*slot).used()) return m.*slot;
  return m.anisotropyTexture;
}

class PrimitiveReader {
 public:
  PrimitiveReader(Document& document, int mesh, int primitive, std::span<const double> weights,
                  Notices& notices)
      : document_(document),
        primitive_(document.model.meshes[static_cast<std::size_t>(mesh)]
                       .primitives[static_cast<std::size_t>(primitive)]),
        weights_(weights),
        notices_(notices),
        label_(primitiveLabel(document, mesh, primitive)) {}

  LocalMesh read(const Material& material, bool isSkinned) {
    LocalMesh mesh;
    readPositions(mesh);
    copyTo(mesh.normals, attribute("NORMAL", kDirection));
    if (isSkinned) readInfluences(mesh);
    const Needs needs = needsOf(material);
    if (needs.uv[0]) readCoordinates(mesh, 0);
    if (needs.uv[1]) readCoordinates(mesh, 1);
    readColours(mesh);
    mesh.triangles = readTriangles(document_, primitive_, count_, label_, notices_);
    if (needs.tangents) findTangents(mesh, tangentSlot(material));
    return mesh;
  }

 private:
  void readPositions(LocalMesh& mesh) {
    const int accessor = primitive_.attributes.at("POSITION");
    const tinygltf::Accessor& a = accessorAt(document_, accessor);
    if (!fits(a, kPosition)) {
      document_.fail(
          fmt::format("{}: POSITION is not made of three-component vectors of a legal type", label_));
    }
    count_ = a.count;
    std::vector<float> values = readFloats(document_, accessor);
    if (a.count >= std::numeric_limits<std::uint32_t>::max()) {
      document_.fail(fmt::format("{}: more vertices than 32-bit indices can name", label_));
    }
    morph("POSITION", 3, values);
    copyTo(mesh.positions, values);
  }

  void readCoordinates(LocalMesh& mesh, int set) {
    const std::string name = fmt::format("TEXCOORD_{}", set);
    copyTo(mesh.uv[set], attribute(name, kCoordinate));
    if (mesh.uv[set].empty()) {
      notices_.warn(fmt::format("{}: its material reads {}, which it does not have", label_, name));
    }
  }

  /// The file's tangents, turned as the image is; others where it has none that count. Without normals they
  /// do not count: the triangles are flat, whatever the tangents were made for (glTF 2.0, 3.7.2.1).
  void findTangents(LocalMesh& mesh, const TextureSlot& slot) {
    if (!mesh.normals.empty() && tangentsFollow(slot)) {
      copyTo(mesh.tangents, attribute("TANGENT", kTangent));
    }
    mesh.tangents.empty() ? generateTangents(mesh, slot) : turnTangents(mesh, slot);
  }

  /// TANGENT belongs to the coordinates that the normal texture names, whichever set that is (3.7.2.1): a
  /// file does not say what else it was made for. Where KHR_texture_transform then chooses another set,
  /// TANGENT says nothing of how the image lies.
  bool tangentsFollow(const TextureSlot& slot) const {
    if (primitive_.material < 0) return true;
    const Json& material = document_.json["materials"][at(primitive_.material)];
    return number(child(material, "normalTexture"), "texCoord", 0.0) == slot.uvSet;
  }

  /// RGB or RGBA, and so may its deltas be, each for itself. Within [0, 1] after morphing (3.7.2.1, 3.7.2.2).
  void readColours(LocalMesh& mesh) {
    const std::vector<float> stored = withoutMorphs("COLOR_0", kColour);
    if (stored.empty()) return;
    const std::size_t n = stored.size() / count_;
    std::vector<float> values(4 * count_, 1.0F);
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t c = 0; c < n; ++c) values[4 * i + c] = stored[n * i + c];
    }
    morph("COLOR_0", 4, values);
    for (float& value : values) value = std::clamp(value, 0.0F, 1.0F);
    copyTo(mesh.colors, values);
  }

  /// JOINTS_0 and WEIGHTS_0, then 1, …: as many sets as there are.
  void readInfluences(LocalMesh& mesh) {
    std::vector<std::vector<std::uint32_t>> joints;
    std::vector<std::vector<float>> weights;
    for (int set = 0;; ++set) {
      const auto found = primitive_.attributes.find(fmt::format("JOINTS_{}", set));
      if (found == primitive_.attributes.end()) break;
      const tinygltf::Accessor& a = accessorAt(document_, found->second);
      const bool isLegal = a.type == TINYGLTF_TYPE_VEC4 && a.count == count_ &&
                           (a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                            a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
      if (!isLegal)
        document_.fail(fmt::format("{}: JOINTS_{} has a type or count that is not legal", label_, set));
      weights.push_back(attribute(fmt::format("WEIGHTS_{}", set), kWeights));
      if (weights.back().empty())
        document_.fail(fmt::format("{}: JOINTS_{} without WEIGHTS_{}", label_, set, set));
      joints.push_back(readUnsigned(document_, found->second));
    }
    mesh.influences = static_cast<int>(4 * joints.size());
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t set = 0; set < joints.size(); ++set) {
        mesh.joints.insert(mesh.joints.end(), &joints[set][4 * i], &joints[set][4 * i] + 4);
        mesh.weights.insert(mesh.weights.end(), &weights[set][4 * i], &weights[set][4 * i] + 4);
      }
    }
  }

  static bool fits(const tinygltf::Accessor& a, const Format& format) {
    const int n = componentCount(a);
    const bool isVector =
        a.type == TINYGLTF_TYPE_VEC2 || a.type == TINYGLTF_TYPE_VEC3 || a.type == TINYGLTF_TYPE_VEC4;
    if (!isVector || n < format.leastComponents || n > format.mostComponents) return false;
    if (isFloat(a)) return true;
    const bool isSigned =
        a.componentType == TINYGLTF_COMPONENT_TYPE_BYTE || a.componentType == TINYGLTF_COMPONENT_TYPE_SHORT;
    return isSmallInteger(a) && (a.normalized || format.plainIntegers) && !(isSigned && format.isUnsigned);
  }

  /// Empty if the attribute is absent, or left out because of its format.
  std::vector<float> attribute(const std::string& name, const Format& format) {
    std::vector<float> values = withoutMorphs(name, format);
    if (!values.empty()) morph(name, static_cast<int>(values.size() / count_), values);
    return values;
  }

  std::vector<float> withoutMorphs(const std::string& name, const Format& format) {
    const auto found = primitive_.attributes.find(name);
    if (found == primitive_.attributes.end()) return {};
    const tinygltf::Accessor& a = accessorAt(document_, found->second);
    if (a.count != count_) {
      document_.fail(fmt::format("{}: {} has {} elements for {} vertices", label_, name, a.count, count_));
    }
    if (!fits(a, format)) {
      notices_.warn(fmt::format("{}: the format of {} is not legal; it is left out", label_, name));
      return {};
    }
    return readFloats(document_, found->second);
  }

  /// Adds weight · delta for each target that has the attribute. Deltas of tangents have no w.
  void morph(const std::string& name, int components, std::vector<float>& values) {
    for (std::size_t t = 0; t < std::min(weights_.size(), primitive_.targets.size()); ++t) {
      const auto found = primitive_.targets[t].find(name);
      if (weights_[t] == 0.0 || found == primitive_.targets[t].end()) continue;
      const tinygltf::Accessor& a = accessorAt(document_, found->second);
      const int n = componentCount(a);
      const bool isLegal = a.count == count_ && (isFloat(a) || isSmallInteger(a)) &&
                           n >= std::min(components, 3) && n <= components;
      if (!isLegal) document_.fail(fmt::format("{}: {} of morph target {} does not fit", label_, name, t));
      const std::vector<float> deltas = readFloats(document_, found->second);
      for (std::size_t i = 0; i < count_; ++i) {
        for (int c = 0; c < n; ++c) {
          float& value = values[i * static_cast<std::size_t>(components) + static_cast<std::size_t>(c)];
          const double delta = deltas[i * static_cast<std::size_t>(n) + static_cast<std::size_t>(c)];
          value = static_cast<float>(value + weights_[t] * delta);
        }
      }
    }
  }

  template <class Vector>
  static void copyTo(std::vector<Vector>& out, const std::vector<float>& values) {
    out.resize(values.size() * sizeof(float) / sizeof(Vector));
    if (!out.empty()) std::memcpy(out.data(), values.data(), out.size() * sizeof(Vector));
  }

  Document& document_;
  const tinygltf::Primitive& primitive_;
  std::span<const double> weights_;
  Notices& notices_;
  std::string label_;
  std::size_t count_ = 0;
};

}  // namespace

Needs needsOf(const Material& material) {
  Needs needs;
  const auto read = [&](const TextureSlot& slot) {
    if (slot.used()) needs.uv[slot.uvSet] = true;
  };
  for (const auto slot : kTextureSlots) read(material.*slot);
  read(material.occlusionTexture);
  needs.tangents = material.normalTexture.used() || isLaidAlongTangents(material);
  return needs;
}

std::string primitiveLabel(const Document& document, int mesh, int primitive) {
  return fmt::format("meshes[{}]{} primitive {}", mesh, quotedName(document.model.meshes[at(mesh)].name),
                     primitive);
}

bool isDrawable(const tinygltf::Primitive& primitive) {
  return primitive.mode >= TINYGLTF_MODE_TRIANGLES && primitive.attributes.contains("POSITION");
}

LocalMesh readPrimitive(Document& document, int mesh, int primitive, const Material& material,
                        std::span<const double> morphWeights, bool isSkinned, Notices& notices) {
  return PrimitiveReader(document, mesh, primitive, morphWeights, notices).read(material, isSkinned);
}

std::uint32_t duplicateVertex(LocalMesh& mesh, std::uint32_t v) {
  const auto duplicate = [v](auto& array) {
    if (!array.empty()) array.push_back(array[v]);
  };
  duplicate(mesh.positions);
  duplicate(mesh.normals);
  duplicate(mesh.tangents);
  duplicate(mesh.uv[0]);
  duplicate(mesh.uv[1]);
  duplicate(mesh.colors);
  for (int k = 0; k < mesh.influences; ++k) {
    const std::size_t at =
        static_cast<std::size_t>(v) * static_cast<std::size_t>(mesh.influences) + static_cast<std::size_t>(k);
    mesh.joints.push_back(mesh.joints[at]);
    mesh.weights.push_back(mesh.weights[at]);
  }
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

}  // namespace whittle::gltf
