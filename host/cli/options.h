// Options that several sub-commands share, and what they do with the scene.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/notices.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle::cli {

/// Where the scene comes from and what surrounds it.
struct SceneOptions {
  std::filesystem::path file;
  std::string scene;           ///< name or index of a scene in the file; empty: the file's default
  std::string background;      ///< "R,G,B" or an equirectangular image; empty: as the file says
  bool defaultLights = false;  ///< also where emitters are all that gives light
  bool quiet = false;
};

void addSceneOptions(CLI::App& command, SceneOptions& options);
/// Settings that change the picture, for render, reference and info.
void addPictureOptions(CLI::App& command, Settings& settings);
/// Settings of the device path alone.
void addDeviceOptions(CLI::App& command, Settings& settings);

/// A line for each option that changes nothing, with the reason.
std::vector<std::string> uselessOptions(const Settings& settings);

/// Loads, applies the background, prints notices to standard error (quiet: warnings only).
Scene loadScene(const SceneOptions& options, Notices& notices);

}  // namespace whittle::cli
