// whittle render: the OpenCL wavefront, from a glTF file to pictures and statistics.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "cli/options.h"
#include "cli/outputs.h"
#include "cli/progress_bar.h"
#include "render/renderer.h"

namespace whittle::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct RenderOptions {
  SceneOptions scene;
  Settings settings;
  std::vector<std::filesystem::path> outputs;
  std::vector<std::string> aovTexts;
  std::filesystem::path stats;
  std::filesystem::path kernelFolder;
  bool profile = false;
};

/// Rays that a stage's items stand for, or 0 where "rays/s" makes no sense.
bool tracesRays(const std::string& stage) { return stage == "intersect" || stage == "occlude"; }

void printProfile(const Stats& stats) {
  double sum = 0.0;
  for (const auto& s : stats.stages) sum += s.seconds;
  fmt::print("{:<22} {:>9} {:>12} {:>10} {:>7}  {}\n", "stage", "launches", "items", "ms", "share", "rate");
  for (const auto& s : stats.stages) {
    const double rate = s.seconds > 0.0 ? static_cast<double>(s.items) / s.seconds * 1e-6 : 0.0;
    fmt::print("{:<22} {:>9} {:>12} {:>10.3f} {:>6.1f} %  {:.1f} {}\n", s.name, s.launches, s.items, s.seconds * 1e3,
               100.0 * s.seconds / sum, rate, tracesRays(s.name) ? "Mrays/s" : "Mitems/s");
  }
  fmt::print("{:<22} {:>9} {:>12} {:>10.3f}\n", "all stages", "", "", sum * 1e3);
  fmt::print("{:<22} {:>9} {:>12} {:>10.3f}\n", "render, wall", "", "", stats.time.render * 1e3);
  fmt::print("load {:.3f} s, tree {:.3f} s, compile {:.3f} s, upload {:.3f} s, write {:.3f} s, total {:.3f} s\n", stats.time.load,
             stats.time.build, stats.time.compile, stats.time.upload, stats.time.write, stats.time.total);
}

void printSummary(const RenderOptions& o, const Stats& stats) {
  const double total = static_cast<double>(stats.rays.total());
  fmt::print("{}×{}, {} triangles, {} rays ({} primary, {} impulse, {} shadow) in {:.3f} s: {:.2f} Mrays/s\n", stats.settings.width,
             stats.settings.height, stats.scene.triangles, stats.rays.total(), stats.rays.primary, stats.rays.impulse,
             stats.rays.shadow, stats.time.render, total / stats.time.render * 1e-6);
  for (const auto& file : o.outputs) fmt::print("wrote {}\n", file.string());
  for (const auto& text : o.aovTexts) fmt::print("wrote {}\n", text);
}

RenderResult renderWithProgress(const Scene& scene, const RenderOptions& o) {
  ProgressBar bar(o.scene.quiet);
  RenderHooks hooks;
  if (!o.kernelFolder.empty()) hooks.kernelFolder = o.kernelFolder;
  hooks.phase = [&](const std::string& text) { bar.phase(text); };
  hooks.progress = [&](const RenderProgress& p) {
    bar.update(static_cast<double>(p.samplesDone) / static_cast<double>(p.samplesTotal), p.seconds,
               fmt::format("{:.1f} Mrays/s", static_cast<double>(p.rays) / p.seconds * 1e-6));
  };
  return render(scene, o.settings, hooks);
}

void runRender(RenderOptions& o) {
  const auto start = Clock::now();
  const auto since = [](Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); };
  if (o.outputs.empty() && o.stats.empty() && o.aovTexts.empty() && !o.profile) o.outputs.push_back(o.scene.file.stem().string() + ".png");
  std::vector<AovOutput> aovs;
  for (const auto& text : o.aovTexts) aovs.push_back(parseAov(text));
  for (const auto& file : o.outputs) checkWritable(file);
  for (const auto& aov : aovs) checkWritable(aov.file);
  if (!o.stats.empty()) checkTextFile(o.stats, "--stats");
  o.settings.aovs = !aovs.empty();

  const Scene scene = loadScene(o.scene);
  const double load = since(start);
  RenderResult result = renderWithProgress(scene, o);
  result.stats.time.load = load;
  if (result.stats.nonFinite > 0)
    fmt::print(stderr, "warning: {} samples were not finite and count as black\n", result.stats.nonFinite);

  const auto writing = Clock::now();
  const ImageMetadata metadata{{"whittle:settings", settingsToJson(result.stats.settings).dump()},
                               {"whittle:scene", o.scene.file.filename().string()},
                               {"whittle:rays", fmt::format("primary {} impulse {} shadow {}", result.stats.rays.primary,
                                                            result.stats.rays.impulse, result.stats.rays.shadow)},
                               {"whittle:renderSeconds", fmt::format("{:.6f}", result.stats.time.render)}};
  for (const auto& file : o.outputs) writePicture(file, result.radiance, o.settings.exposure, metadata);
  for (const auto& aov : aovs) writeExr(aov.file, result.aovs.at(aov.name), metadata);
  result.stats.time.write = since(writing);
  result.stats.time.total = since(start);
  if (!o.stats.empty()) writeTextFile(o.stats, statsToJson(result.stats).dump(2) + "\n");
  if (o.profile) printProfile(result.stats);
  if (!o.scene.quiet) printSummary(o, result.stats);
}

}  // namespace

void addRender(CLI::App& app, int& status) {
  auto o = std::make_shared<RenderOptions>();
  CLI::App* c = app.add_subcommand("render", "render a scene on an OpenCL device");
  addSceneOptions(*c, o->scene);
  c->add_option("-o,--output", o->outputs, "picture(s): .exr linear radiance, .png/.jpg tone-mapped sRGB (default: SCENE's name .png)")
      ->type_name("FILE")
      ->allow_extra_args(false);
  addPictureOptions(*c, o->settings);
  addDeviceOptions(*c, o->settings);
  c->add_option("--aov", o->aovTexts, "depth|normal|albedo|primitive of each pixel's first sample, .exr")->type_name("NAME=FILE")->allow_extra_args(false);
  c->add_option("--stats", o->stats, "statistics as JSON")->type_name("FILE");
  c->add_flag("--profile", o->profile, "print a table by stage");
  c->add_option("--target-error", o->settings.targetError, "stop once the estimated RMSE, W/(m² sr), is below")->check(CLI::NonNegativeNumber);
  c->add_option("--time-limit", o->settings.timeLimit, "start no further pass after this many seconds of rendering")->check(CLI::NonNegativeNumber);
  c->add_option("--kernels", o->kernelFolder, "read kernels from this folder instead of the binary (for developers)")->type_name("FOLDER");
  c->callback([o, &status] {
    runRender(*o);
    status = 0;
  });
}

}  // namespace whittle::cli
