// whittle info: what is in a scene, what it needs, and what will be left out and why.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "analysis/light_groups.h"
#include "cl/error.h"
#include "cl/kernel_cache.h"
#include "cli/aovs.h"
#include "cli/commands.h"
#include "cli/error_options.h"
#include "cli/info_report.h"
#include "cli/option_kinds.h"
#include "cli/options.h"
#include "cli/speech.h"
#include "render/peak_memory.h"
#include "render/renderer.h"
#include "scene/camera.h"
#include "wavefront/camera_to_device.h"
#include "wavefront/stages.h"

namespace whittle::cli {
namespace {

struct InfoOptions {
  SceneOptions scene;
  Settings settings;
  std::vector<std::string> aovTexts;
  bool json = false;
};

/// As `whittle render` takes them, or without files: none is written.
void checkAovs(InfoOptions& o) {
  const auto& known = renderAovs();
  for (auto& text : o.aovTexts)
    askForAovs(
        o.settings,
        {std::find(known.begin(), known.end(), text) == known.end() ? parseAov(text, known).name : text});
}

/// The render's own set-up where there is a device for it, so that sizes are real; else what a CPU device
/// would do.
void runInfo(InfoOptions& o) {
  Notices notices;
  notices.notes = uselessOptions(o.settings);
  MemoryBudget budget = budgetOf(o.scene);
  const Scene scene = loadScene(o.scene, {kTriangleBytes}, o.settings, budget, notices);
  findCamera(scene, o.settings.camera);
  warnIfAny(settleKernelCache());
  prepareCpuThreads(o.settings.threads, o.settings.workGroup);
  std::optional<RenderPlan> plan;
  std::string problem;
  try {
    plan = planRender(scene, o.settings);
  } catch (const ClError& e) {
    problem = e.what();
  } catch (const std::invalid_argument& e) {
    if (!o.settings.device.empty()) throw;
    problem = e.what();
  }
  const std::uint64_t peak = plan ? peakBytes(scene, *plan, budget.peak()) : 0;
  const PrunedScene pruned = plan ? std::move(plan->pruned) : pruneScene(scene, o.settings);
  const SceneFeatures features =
      plan ? plan->features : SceneFeatures::analyse(scene, pruned, o.settings, {});
  const auto lights = lightGroups(scene, pruned, features);
  const auto stages = plan ? plan->stages
                           : plannedStages({features, lights.size(), mostHits(features, o.settings),
                                            hasLateLight(scene, pruned, lights)});
  const InfoReport report{scene, notices, features, pruned.pruning, stages, plan, problem, peak};
  if (o.json)
    tell(fmt::format("{}\n",
                     infoJson(report).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)));
  else
    tell(infoText(report));
}

}  // namespace

void addInfo(CLI::App& app, int& status) {
  auto o = std::make_shared<InfoOptions>();
  CLI::App* c = app.add_subcommand("info", "what is in a scene, what it needs, what is left out and why");
  addSceneOptions(*c, o->scene);
  c->option_defaults()->group("Output");
  c->add_flag("--json", o->json, "as JSON");
  c->add_flag("--quiet", o->scene.quiet, "no notes on standard error; warnings only");
  addSeveral(
      *c, "--aov", o->aovTexts, "NAME",
      "plan with the buffers of this auxiliary output; NAME=FILE.exr, as render takes it, writes nothing");
  addPictureOptions(*c, o->settings, o->scene);
  addErrorOptions(*c, o->settings);
  addDeviceOptions(*c, o->settings);
  c->footer("Example: whittle info scene.glb --bounces 1");
  c->callback([o, c, &status] {
    settleRaysPerPixel(*c, o->settings);
    checkAovs(*o);
    runInfo(*o);
    status = 0;
  });
}

}  // namespace whittle::cli
