// Options that several sub-commands share, and what they do with the scene.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/crop.h"
#include "cli/viewpoint.h"
#include "scene/memory_budget.h"
#include "scene/notices.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "scene/work_log.h"

namespace whittle {
class OpenFile;
}

namespace whittle::cli {

/// Where the scene comes from and what surrounds it.
struct SceneOptions {
  std::filesystem::path file;
  std::string scene;                  ///< name or index of a scene in the file; empty: the file's default
  std::string background;             ///< "R,G,B" or an equirectangular image; empty: as the file says
  std::optional<bool> defaultLights;  ///< see LoadOptions
  bool defaultBackground = true;
  bool confined = false;  ///< see LoadOptions
  bool quiet = false;
  std::optional<double> time;         ///< seconds, see LoadOptions
  std::string animation;              ///< name or index; empty: the first
  std::string variant;                ///< of the materials: name or index; empty: none
  std::optional<MemoryLimit> memory;  ///< unset: what the machine has
  WorkLog log = {};                   ///< see LoadOptions
  ViewpointOptions view;
  std::optional<glm::ivec2> focus;  ///< a pixel to focus on
  std::optional<Crop> crop;         ///< becomes Settings::crop when the picture's size is known
  /// Null where the command draws no picture.
  CLI::Option *width = nullptr, *height = nullptr, *ambient = nullptr, *focusPixel = nullptr,
              *mirrorRoughness = nullptr;
};

void addSceneOptions(CLI::App& command, SceneOptions& options);
/// Settings that change the picture, for render, reference and info.
void addPictureOptions(CLI::App& command, Settings& settings, SceneOptions& scene);
/// Settings of the device path alone.
void addDeviceOptions(CLI::App& command, Settings& settings);

/// The default of --mirror-roughness: rough surfaces that reflect by themselves need no mirrors in their
/// place.
float standardMirrorRoughness(const Settings& settings);
/// Takes that default, unless the command line has the option.
void settleMirrorRoughness(const SceneOptions& options, Settings& settings);

/// A line for each option that changes nothing, with the reason.
std::vector<std::string> uselessOptions(const Settings& settings);

/// What a command will take beside the scene.
struct CommandCosts {
  std::uint64_t triangleBytes = 0;  ///< see LoadOptions::laterTriangleBytes
  std::uint64_t programBytes = 0;   ///< whatever is loaded
  std::uint64_t (*picture)(const Settings&) = [](const Settings&) { return std::uint64_t{0}; };
};

/// Held against --memory-limit.
MemoryBudget budgetOf(const SceneOptions& options);
/// What a picture of these settings takes. Throws InputError where that is too much.
void promisePicture(MemoryBudget& budget, const CommandCosts& costs, const Settings& settings);

/// Loads, applies the background, prints notices to standard error (quiet: warnings only). Settles what the
/// settings leave to the scene: one side of the picture where the other alone was given, and the camera.
/// Throws InputError before it takes what `budget` does not allow. `file`: stays open for other times.
Scene loadScene(const SceneOptions& options, const CommandCosts& costs, Settings& settings,
                MemoryBudget& budget, Notices& notices, OpenFile* file = nullptr);

}  // namespace whittle::cli
