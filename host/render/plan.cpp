// The stages of Wavefront as a list; tests/cli compares it with the statistics of real renders.
#include "render/plan.h"

namespace whittle {

std::vector<std::string> plannedStages(const SceneFeatures& features, std::size_t lights, int bounces) {
  std::vector<std::string> stages{"raygen", "intersect", "shade"};
  const auto add = [&](std::initializer_list<const char*> names) {
    stages.insert(stages.end(), names.begin(), names.end());
  };
  const bool shadows = features.has(Feature::SHADOWS), impulses = features.has(Feature::IMPULSES);
  if (shadows || impulses) add({"compact_count", "scan_chunks"});
  if (shadows) add({"compact_shadow", "occlude"});
  if (lights > 1) add({"shade_light"});
  if (impulses) add({"compact_impulse", "accumulate"});
  if (features.has(Feature::BOTH_BRANCHES) && bounces >= 10) add({"find_long_runs"});
  add({"film"});
  return stages;
}

}  // namespace whittle
