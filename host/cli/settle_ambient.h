// How much light comes from all sides where nobody says.
#pragma once

#include "cli/options.h"
#include "scene/notices.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle::cli {

/// Settings::ambient where it is `auto`, or is not given and the lights are ours: a studio's walls send some
/// of its light back, and a sky lights what lies in the shade as far as it gets there, unless it does so by
/// rays (--sky-light). Noted.
void settleAmbient(const SceneOptions& options, const Scene& scene, Settings& settings, Notices& notices);

}  // namespace whittle::cli
