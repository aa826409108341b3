// whittle reference: the double-precision recursion that defines the right answer.
#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "cli/commands.h"
#include "cli/options.h"
#include "cli/outputs.h"
#include "cli/progress_bar.h"
#include "reference/reference.h"
#include "render/stats.h"
#include "scene/input_error.h"

namespace whittle::cli {
namespace {

struct ReferenceOptions {
  SceneOptions scene;
  Settings settings;
  std::vector<std::filesystem::path> outputs;
  std::vector<std::string> aovTexts;
  std::filesystem::path stats;
};

void runReference(const ReferenceOptions& o) {
  std::vector<AovOutput> aovs;
  for (const auto& text : o.aovTexts) {
    aovs.push_back(parseAov(text));
    if (aovs.back().name != "depth" && aovs.back().name != "primitive")
      throw InputError("--aov: the reference knows depth and primitive");
    checkWritable(aovs.back().file);
  }
  for (const auto& file : o.outputs) checkWritable(file);
  if (!o.stats.empty()) checkTextFile(o.stats, "--stats");
  const Scene scene = loadScene(o.scene);

  ProgressBar bar(o.scene.quiet);
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  const ReferenceResult result = renderReference(scene, o.settings, [&](int done, int of) {
    bar.update(static_cast<double>(done) / of, seconds(), "double precision");
  });
  bar.clear();
  const double elapsed = seconds();

  const ImageMetadata metadata{{"whittle:settings", settingsToJson(o.settings).dump()}, {"whittle:reference", "double precision"}};
  for (const auto& file : o.outputs) writePicture(file, result.radiance, o.settings.exposure, metadata);
  for (const auto& aov : aovs) writeExr(aov.file, aov.name == "depth" ? result.depth : result.primitive, metadata);
  if (!o.stats.empty()) {
    const nlohmann::ordered_json json{{"settings", settingsToJson(o.settings)},
                                      {"rays",
                                       {{"primary", result.rays.primary},
                                        {"impulse", result.rays.impulse},
                                        {"shadow", result.rays.shadow},
                                        {"total", result.rays.total()}}},
                                      {"time", {{"render", elapsed}}}};
    writeTextFile(o.stats, json.dump(2) + "\n");
  }
  if (o.scene.quiet) return;
  fmt::print("reference: {} rays ({} primary, {} impulse, {} shadow) in {}\n", result.rays.total(), result.rays.primary,
             result.rays.impulse, result.rays.shadow, formatSeconds(elapsed));
  for (const auto& file : o.outputs) fmt::print("wrote {}\n", file.string());
}

}  // namespace

void addReference(CLI::App& app, int& status) {
  auto o = std::make_shared<ReferenceOptions>();
  CLI::App* c = app.add_subcommand("reference", "render with the double-precision recursion (slow, right)");
  addSceneOptions(*c, o->scene);
  c->add_option("-o,--output", o->outputs, "picture(s): .exr, .png or .jpg")->required()->type_name("FILE")->allow_extra_args(false);
  addPictureOptions(*c, o->settings);
  c->add_option("--aov", o->aovTexts, "depth|primitive of each pixel's first sample, .exr")->type_name("NAME=FILE")->allow_extra_args(false);
  c->add_option("--stats", o->stats, "settings, ray counts and time as JSON")->type_name("FILE");
  c->callback([o, &status] {
    runReference(*o);
    status = 0;
  });
}

}  // namespace whittle::cli
