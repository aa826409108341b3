// The options of a render as widgets: each value is text and goes through the option's own check, so that the
// window takes and refuses what the command line does, in the same words.
#pragma once

#include <string>
#include <vector>

#include "cl/device.h"
#include "cli/options.h"
#include "scene/settings.h"
#include "view/view_model.h"

namespace whittle::cli {

/// In the order in which a window shows them. Labels and groups are the window's, tips the options' help.
/// `standard`: the defaults; `devices`: what there is to choose from.
std::vector<view::Control> settingControls(const Settings& standard, const DeviceList& devices);

/// As the command line would have it: "on" and "off", "auto", numbers. Throws std::invalid_argument for an id
/// that is no control.
std::string settingText(const Settings& settings, const std::string& id);

/// The default of a control beside these settings, which decide some: --glossy that of --mirror-roughness.
/// `standard`: the others.
std::string standardText(const Settings& standard, const Settings& settings, const std::string& id);

/// Throws InputError, with the settings as they were.
void setSetting(Settings& settings, const std::string& id, const std::string& text);

/// Those controls that are not the defaults of `whittle render`, as its options.
std::string optionsText(const Settings& settings);

/// Options that say how the scene's file is read: --time, --animation, --background; "auto" where none is
/// given.
std::vector<view::Control> sceneControls();
bool isSceneControl(const std::string& id);
std::string sceneText(const SceneOptions& options, const std::string& id);
/// Throws InputError, with the options as they were.
void setSceneOption(SceneOptions& options, const std::string& id, const std::string& text);
std::string sceneOptionsText(const SceneOptions& options);

}  // namespace whittle::cli
