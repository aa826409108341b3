// A node of the hierarchy as the loader keeps it: files have many, so that one takes a hundred bytes.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace whittle::gltf {

struct Node {
  std::string name;
  int mesh = -1, skin = -1, camera = -1;
  int light = -1;                     ///< KHR_lights_punctual
  std::vector<int> children;          ///< in file order
  bool isVisible = true;              ///< KHR_node_visibility; false: nor is what hangs on it
  bool comesAndGoes = false;          ///< an animation decides when it is visible
  std::unique_ptr<glm::dmat4> local;  ///< to the parent; null: the identity

  /// What animations move one by one.
  struct Parts {
    glm::dvec3 translation{0.0};
    glm::dvec4 rotation{0, 0, 0, 1};  ///< x, y, z, w
    glm::dvec3 scale{1.0};
    bool isMatrix = false;  ///< the file has a matrix instead
  };

  /// What few nodes have.
  struct Rare {
    std::vector<double> weights;  ///< of morph targets, in the place of the mesh's
    /// EXT_mesh_gpu_instancing: attributes and their accessors; unset: the mesh is there once.
    std::optional<std::vector<std::pair<std::string, int>>> instancing;
    bool castsShadows = true;    ///< its light, as far as the node says
    std::optional<Parts> parts;  ///< of `local`; where an animation is to be played
  };
  std::unique_ptr<Rare> rare;  ///< null: as Rare is made

  const std::vector<double>& weights() const;
  bool castsShadows() const { return !rare || rare->castsShadows; }
};

/// From a checked node of the file (check.h). `keepParts`: see Rare.
Node nodeFrom(const nlohmann::json& checked, bool keepParts);

/// T · R · S; the quaternion (x, y, z, w) is normalised first, and one of length 0 turns nothing.
glm::dmat4 composed(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale);

/// Whether the extras of a light or its node leave its shadows on.
bool leavesShadows(const nlohmann::json& extras);

}  // namespace whittle::gltf
