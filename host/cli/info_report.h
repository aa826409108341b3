// What `whittle info` says, as text and as JSON, from one gathering.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "render/plan.h"
#include "scene/notices.h"
#include "scene/scene.h"

namespace whittle::cli {

struct InfoReport {
  const Scene& scene;
  const Notices& notices;
  const SceneFeatures& features;
  const PruningReport& pruning;  ///< what of the scene stays on the host
  std::vector<std::string> stages;
  std::optional<RenderPlan> plan;  ///< unset: no device
  std::string planProblem;         ///< why
  std::uint64_t peakBytes = 0;     ///< of a render's process; 0 without a plan
};

std::string infoText(const InfoReport& report);
nlohmann::ordered_json infoJson(const InfoReport& report);

}  // namespace whittle::cli
