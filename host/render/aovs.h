// The auxiliary outputs of a render, by name.
#pragma once

#include <string>
#include <vector>

#include "scene/settings.h"

namespace whittle {

/// As RenderResult::aovs has them.
inline const std::vector<std::string> kAovNames{"depth",   "normal", "albedo", "primitive",
                                                "samples", "error",  "bounce", "cost"};

/// Has the render keep this one; more may come with it. Throws std::invalid_argument for another name.
void askForAov(Settings& settings, const std::string& name);
/// All that the settings allow: the error takes two rays for each pixel.
void askForAllAovs(Settings& settings);

}  // namespace whittle
