// See settle_ambient.h.
#include "cli/settle_ambient.h"

#include <fmt/format.h>

#include "analysis/ambient.h"
#include "analysis/open_sky.h"
#include "cli/option_kinds.h"
#include "scene/camera.h"
#include "scene/sky_light.h"

namespace whittle::cli {

void settleAmbient(const SceneOptions& options, const Scene& scene, Settings& settings, Notices& notices) {
  const bool isUnset = options.ambient && !given(options.ambient);
  const bool isStudio = isUnset && scene.hasStudioLights, isSky = isUnset && scene.sky;
  if (hasSkyLight(scene) || !(isStudio || isSky || !settings.ambient)) return;
  const double open = scene.sky ? openSky(scene, scene.cameras[findCamera(scene, settings.camera)],
                                          static_cast<double>(settings.width) / settings.height)
                                : 1.0;
  settings.ambient = static_cast<float>(static_cast<double>(automaticAmbient(scene)) * open);
  notices.note(fmt::format(
      "--ambient auto{}{}: {} W/(m² sr)",
      isStudio ? ", with the studio's lights"
      : isSky  ? ", with the sky"
               : "",
      open < 1.0 ? fmt::format(", {:.0f} % of it since little of the sky is seen here", 100.0 * open) : "",
      *settings.ambient));
}

}  // namespace whittle::cli
