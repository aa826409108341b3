// See light_groups.h.
#include "analysis/light_groups.h"

#include <algorithm>

namespace whittle {

std::vector<LightGroup> lightGroups(const Scene& scene, const PrunedScene& pruned,
                                    const SceneFeatures& features, std::uint32_t most) {
  std::vector<LightGroup> groups(1);
  for (const std::uint32_t light : pruned.lights) {
    const bool shadowed = features.has(Feature::SHADOWS) && scene.lights[light].castsShadows;
    if (const LightGroup last = groups.back();
        last.waiting == kLightsWaiting || last.end - last.first == most)
      groups.push_back({last.end, last.end, 0});
    LightGroup& own = groups.back();
    ++own.end;
    if (shadowed || own.waiting > 0) ++own.waiting;
  }
  return groups;
}

std::uint32_t mostWaiting(const std::vector<LightGroup>& groups) {
  std::uint32_t most = 0;
  for (const LightGroup& group : groups) most = std::max(most, group.waiting);
  return most;
}

bool hasLateLight(const Scene& scene, const PrunedScene& pruned, const std::vector<LightGroup>& groups) {
  for (const LightGroup& group : groups)
    for (std::uint32_t light = group.end - group.waiting; light < group.end; ++light)
      if (!scene.lights[pruned.lights[light]].castsShadows) return true;
  return false;
}

}  // namespace whittle
