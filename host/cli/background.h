// What surrounds the scene: --sky, --background, --background-rotation, --background-strength.
#pragma once

#include <optional>
#include <string>

#include "scene/memory_budget.h"
#include "scene/notices.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle::cli {

/// "ELEVATION,AZIMUTH", with ",TURBIDITY" behind it or not, "none", or "auto": as the file says. Throws
/// InputError that names the option.
std::optional<SkyChoice> parseSky(const std::string& option, const std::string& text);

/// Puts `text` ("R,G,B", one number, or an equirectangular picture; empty: the scene's background stays) into
/// the scene, then turns and scales it as the settings say. Texels that no sky can have are mended, with one
/// warning: NaN and negative values count as 0, infinite ones as the largest that half floats have. Throws
/// InputError that names the option.
void applyBackground(Scene& scene, const std::string& text, const Settings& settings, MemoryBudget& budget,
                     Notices& notices);

}  // namespace whittle::cli
