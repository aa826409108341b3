// glTF 2.0 and GLB files to Scene. The only user of tinygltf.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "scene/camera.h"
#include "scene/notices.h"
#include "scene/scene.h"

namespace whittle {

struct LoadOptions {
  std::optional<std::string> sceneName;  ///< name or index; default: the file's default scene, else the first
  bool defaultLights = false;            ///< add the default lights to a file that has emitters but no lights
  bool defaultBackground = true;         ///< with the default lights, add a dim background too
  std::string camera = "0";              ///< which one lights are added for; see findCamera
  std::optional<Viewpoint> viewpoint = {};  ///< a camera by hand, in the place of the file's
  /// Width over height of the picture that an added camera frames the scene for; 0: 16:9.
  double aspect = 0.0;
};

/// Reads `path`. Throws InputError with one line if it cannot be used; says in `notices` what was ignored or
/// chosen. Adds a camera, lights and a background where the file has none (see addDefaults).
Scene loadGltf(const std::filesystem::path& path, const LoadOptions& options, Notices& notices);

/// A camera that frames the scene where it has none; a sun with shadows plus a fill light without, and a dim
/// constant background, where it has neither lights nor emitters nor a background. Both are noted.
/// options.defaultLights: a file with emitters gets the lights too; without it a note says that emitters
/// alone light nothing.
void addDefaults(Scene& scene, Notices& notices, const LoadOptions& options = {});

}  // namespace whittle
