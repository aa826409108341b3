// A copy of a glTF file with edited lights and materials. Its JSON changes in these values alone; buffers,
// images and extensions that Whittle does not read stay as they are.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "scene/appearance.h"

namespace whittle {

struct EditedScene {
  std::filesystem::path file;            ///< that `before` was read from
  std::optional<std::string> sceneName;  ///< see LoadOptions
  glm::dvec3 origin{0.0};                ///< Scene::origin
  const Appearance& before;
  const Appearance& after;
};

/// Read again, the copy has the lights and materials of `after` bit for bit, but for a direction's 0
/// below a turned parent, which may become 1e-16. Lights that are not of the file
/// are added to it, all of them, once one of them was edited. `copy`: empty for a name beside the file. A
/// name that is taken gets a number; .glb and .gltf stay what they are. Returns the name. Throws InputError,
/// also where nothing was edited, and UnwritableFile; then nothing is left behind.
std::filesystem::path writeEditedCopy(const EditedScene& scene, const std::filesystem::path& copy);

}  // namespace whittle
