// A camera by hand: --eye, --look-at, --up, --fov or --ortho-height, and --orbit.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "scene/camera.h"

namespace whittle::cli {

/// What was asked for, and the options, so that one that needs another can be told apart from a default.
struct ViewpointOptions {
  Viewpoint viewpoint;
  CLI::Option *camera = nullptr, *eye = nullptr, *lookAt = nullptr, *up = nullptr, *fov = nullptr,
              *orthoHeight = nullptr, *orbit = nullptr;
};

/// Adds the options. `camera`: the one that chooses among the file's cameras.
void addViewpointOptions(CLI::App& command, ViewpointOptions& options, CLI::Option* camera);

/// The viewpoint, where one was asked for. Throws InputError for options that need or exclude another.
std::optional<Viewpoint> chosenViewpoint(const ViewpointOptions& options);

/// The options that make this camera again, for `info` and the window.
std::string viewpointText(const Camera& camera, const glm::dvec3& origin);

}  // namespace whittle::cli
