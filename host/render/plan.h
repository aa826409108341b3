// What a render would launch and allocate, without tracing a ray: for `whittle info`.
#pragma once

#include <string>
#include <vector>

#include "analysis/scene_features.h"
#include "cl/device.h"
#include "report/stats.h"
#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

struct RenderPlan {
  SceneFeatures features;
  PrunedScene pruned;                 ///< what goes to the device
  std::vector<std::string> stages;    ///< kernels, in the order of their first launch
  std::vector<BufferStats> buffers;   ///< as allocated: real sizes
  std::uint64_t treeNodes = 0;        ///< of the two-wide tree
  std::uint64_t everythingBytes = 0;  ///< of all buffers with settings.keepAllFeatures
  std::string general;  ///< the general program that could draw it (analysis/general_features.h), or empty
  bool startsOnGeneral = false;  ///< with Tier::Auto, now
  bool isOwnCompiled = false;    ///< before, so that nothing has to be
  DeviceInfo device;
  Settings settings;  ///< as a render would use them
};

/// Builds the tree, opens the device and allocates what a render would. Throws what render throws.
RenderPlan planRender(const Scene& scene, const Settings& settings);

}  // namespace whittle
