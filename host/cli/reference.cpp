// whittle reference: the double-precision recursion that defines the right answer.
#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "cli/aovs.h"
#include "cli/commands.h"
#include "cli/guard.h"
#include "cli/option_kinds.h"
#include "cli/options.h"
#include "cli/output_writer.h"
#include "cli/outputs.h"
#include "cli/progress_bar.h"
#include "cli/speech.h"
#include "reference/reference.h"
#include "report/stats.h"
#include "report/text.h"

namespace whittle::cli {
namespace {

struct ReferenceOptions {
  SceneOptions scene;
  Settings settings;
  std::vector<std::filesystem::path> outputs;
  std::vector<std::string> aovTexts;
  std::filesystem::path stats;

  std::vector<AovOutput> aovs;  ///< aovTexts, parsed
};

OutputCheck checkOutputs(ReferenceOptions& o) {
  OutputCheck check(o.settings.width, o.settings.height);
  for (const auto& file : {o.scene.file, std::filesystem::path(o.scene.background)})
    if (!file.empty()) check.reads(file);
  for (const auto& text : o.aovTexts) o.aovs.push_back(parseAov(text, kReferenceAovs));
  for (const auto& file : o.outputs) check.picture("--output", file);
  for (const auto& aov : o.aovs) check.picture("--aov", aov.file);
  if (o.settings.alpha) check.alpha(o.outputs);
  check.text("--stats", o.stats);
  return check;
}

std::string statsText(const ReferenceOptions& o, const Scene& scene, const ReferenceResult& result,
                      double seconds) {
  const auto& rays = result.rays;
  const nlohmann::ordered_json json{{"scene",
                                     {{"file", scene.file},
                                      {"triangles", scene.triangles.size()},
                                      {"droppedTriangles", scene.droppedTriangles},
                                      {"materials", scene.materials.size()},
                                      {"lights", scene.lights.size()},
                                      {"textures", scene.images.size()}}},
                                    {"settings", settingsToJson(o.settings)},
                                    {"rays",
                                     {{"primary", rays.primary},
                                      {"impulse", rays.impulse},
                                      {"shadow", rays.shadow},
                                      {"total", rays.total()}}},
                                    {"time", {{"render", seconds}}},
                                    {"cutOffThroughput", rays.cutOff},
                                    {"bouncesThroughput", rays.bounces},
                                    {"transparentBouncesThroughput", rays.straight},
                                    {"nonFinite", result.nonFinite}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void writeResults(const ReferenceOptions& o, const Scene& scene, const ReferenceResult& result,
                  double seconds, OutputWriter& files) {
  const ImageMetadata metadata{{"whittle:settings", settingsToJson(o.settings).dump()},
                               {"whittle:scene", o.scene.file.filename().string()},
                               {"whittle:reference", "double precision"}};
  const Look look = lookOf(result.radiance, scene, o.settings, o.outputs, o.scene.quiet);
  nowDoing("writing pictures");
  for (const auto& file : o.outputs)
    files.add(file, "",
              [&](const auto& to) { writePicture(to, result.radiance, result.alpha, look, metadata); });
  if (!o.aovs.empty()) {
    const std::map<std::string, FloatImage> aovs{{"depth", result.depth}, {"primitive", result.primitive}};
    for (const auto& aov : o.aovs)
      files.add(aov.file, fmt::format(" ({})", aov.name), [&](const auto& to) {
        writeAov({aov.name, to}, result.radiance, result.alpha, aovs, metadata);
      });
  }
  nowDoing("");
  if (!o.stats.empty())
    files.add(o.stats, "", [&](const auto& to) { writeTextFile(to, statsText(o, scene, result, seconds)); });
}

/// Returns the exit status.
int runReference(ReferenceOptions& o) {
  OutputCheck check = checkOutputs(o);
  loadImageCodec();  // what fails, fails before the work
  Notices notices;
  MemoryBudget budget = budgetOf(o.scene);
  const Scene scene =
      loadScene(o.scene, {kReferenceTriangleBytes, 0, referencePictureBytes}, o.settings, budget, notices);
  for (const auto& file : notices.files) check.reads(file);
  ProgressBar bar(o.scene.quiet);
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const ReferenceResult result = renderReference(scene, o.settings, [&](int done, int of) {
    bar.update(static_cast<double>(done) / of, seconds(), "double precision");
  });
  bar.clear();
  const double elapsed = seconds();
  if (result.nonFinite > 0)
    warn(fmt::format("{} samples were not finite and count as black", formatInteger(result.nonFinite)));
  OutputWriter files;
  writeResults(o, scene, result, elapsed, files);
  const int status = files.isComplete() ? 0 : 1;
  if (o.scene.quiet || isStandardOutput(o.stats)) return status;
  const auto& rays = result.rays;
  tell(fmt::format("{} in double precision: {} rays in {}\n{} primary, {} impulse, {} shadow\n",
                   sizeText(o.settings), formatInteger(rays.total()), formatSeconds(elapsed),
                   formatInteger(rays.primary), formatInteger(rays.impulse), formatInteger(rays.shadow)));
  tell(files.summary());
  return status;
}

}  // namespace

void addReference(CLI::App& app, int& status) {
  auto o = std::make_shared<ReferenceOptions>();
  CLI::App* c = app.add_subcommand("reference", "render with the double-precision recursion (slow, right)");
  addSceneOptions(*c, o->scene);
  c->option_defaults()->group("Output");
  addSeveral(*c, "-o,--output", o->outputs, "FILE",
             ".exr: linear radiance; .png, .jpg: tone-mapped sRGB; may be given several times")
      ->required();
  addSeveral(
      *c, "--aov", o->aovTexts, "NAME=FILE",
      "depth|primitive of each pixel's first sample, as .exr (channels Z, primitive.V); all: these and "
      "the picture as layers of one file; may be given several times");
  addFile(*c, "--stats", o->stats, "FILE",
          "settings, ray counts and time as JSON; -: on standard output, instead of the summary");
  c->add_flag("--quiet", o->scene.quiet, "no progress, notes or summary");
  addPictureOptions(*c, o->settings, o->scene);
  c->footer("Example: whittle reference scene.glb -o right.exr --width 320 --height 180");
  c->callback([o, &status] { status = runReference(*o); });
}

}  // namespace whittle::cli
