// glTF 2.0 and GLB files to Scene. The only user of tinygltf.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "scene/camera.h"
#include "scene/memory_budget.h"
#include "scene/notices.h"
#include "scene/scene.h"
#include "scene/work_log.h"

namespace whittle {

struct LoadOptions {
  std::optional<std::string> sceneName;  ///< name or index; default: the file's default scene, else the first
  /// The studio's lights (studio.h) for a file without lights or background; unset: where a surface
  /// would be dark.
  std::optional<bool> defaultLights = {};
  bool defaultBackground = true;            ///< with them, its surroundings
  std::optional<SkyChoice> sky = {};        ///< in the place of the file's; then there is no studio
  std::string camera = "0";                 ///< which one lights are added for; see findCamera
  std::optional<Viewpoint> viewpoint = {};  ///< a camera by hand, in the place of the file's
  std::optional<double> time = {};  ///< seconds: nodes as an animation has them; unset: as the file rests
  std::optional<std::string> animation = {};  ///< its name or index; unset: the first
  std::optional<std::string> variant = {};    ///< of its materials: name or index; unset: none
  bool confined = false;                      ///< refuse a file that asks for others outside its folder
  /// Width over height of the picture that an added camera frames the scene for; 0: 16:9.
  double aspect = 0.0;
  MemoryBudget* memory = nullptr;  ///< what it may take; null: what the machine has
  /// What each triangle will cost whoever asked for the scene, beside its own arrays: a file is refused for
  /// that as well.
  std::uint64_t laterTriangleBytes = 0;
  bool laterTextureLevels = false;  ///< the same of smaller levels of its textures
  WorkLog log = {};                 ///< of reading, parsing, decoding, …
};

/// Reads `path`. Throws InputError with one line if it cannot be used; says in `notices` what was ignored or
/// chosen. Adds a camera, lights and a background where the file has none (see addDefaults).
Scene loadGltf(const std::filesystem::path& path, const LoadOptions& options, Notices& notices);

/// A file that stays open, for pictures of one scene at several times: it is read and its images are decoded
/// once.
class OpenFile {
 public:
  OpenFile();
  ~OpenFile();
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  /// As loadGltf, once.
  Scene load(const std::filesystem::path& path, const LoadOptions& options, Notices& notices);
  /// Makes cameras, lights, materials and meshes of that scene what the animation has at `seconds`, as `load`
  /// would with this time; all else of it stays as it is, what was added among it. Its arrays are whole, but
  /// where no mesh moves.
  void moveTo(double seconds, Scene& scene);
  /// Whether a mesh, a camera, a light or a material that is shown moves, for options with a time.
  bool moves() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A camera that frames the scene where it has none; the sky, where it has one, else a studio (studio.h)
/// around the camera that is chosen, where it has neither lights nor a background and something would be
/// dark: surfaces that glow light nothing. Both are noted.
void addDefaults(Scene& scene, Notices& notices, const LoadOptions& options = {});

}  // namespace whittle
