// Lights whose light one launch finds: what is seen of a surface is evaluated once for all of a group. Groups
// follow the order of the lights, so that radiance is summed in it, whatever their size.
#pragma once

#include <cstdint>
#include <vector>

#include "analysis/pruned_scene.h"
#include "analysis/scene_features.h"

namespace whittle {

/// Lights whose candidates wait at a hit until it is their turn, so that memory does not grow with the
/// lights. Each more takes SHADOW_PLANES floats of each ray in flight.
inline constexpr std::uint32_t kLightsWaiting = 4;

/// Lights [first, end) of the pruned scene. The last `waiting` of them begin with one that casts shadows:
/// what they bring is added in their turn, when its shadow rays are traced. Those before them cast none, and
/// are added at once.
struct LightGroup {
  std::uint32_t first = 0;
  std::uint32_t end = 0;
  std::uint32_t waiting = 0;
};

/// All lights, at most kLightsWaiting in a group that wait and `most` in all; one group without a light where
/// there are none.
std::vector<LightGroup> lightGroups(const Scene& scene, const PrunedScene& pruned,
                                    const SceneFeatures& features, std::uint32_t most = 0xffffffffU);

/// The most that wait in any group: sets of candidates that the queues need.
std::uint32_t mostWaiting(const std::vector<LightGroup>& groups);

/// Whether a light without shadows waits for another's.
bool hasLateLight(const Scene& scene, const PrunedScene& pruned, const std::vector<LightGroup>& groups);

}  // namespace whittle
