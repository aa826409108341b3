// whittle render: the OpenCL wavefront, from a glTF file to pictures and statistics.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <future>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>

#include "cl/device.h"
#include "cl/kernel_cache.h"
#include "cli/aovs.h"
#include "cli/build_failure.h"
#include "cli/commands.h"
#include "cli/crop.h"
#include "cli/error_options.h"
#include "cli/guard.h"
#include "cli/option_kinds.h"
#include "cli/options.h"
#include "cli/output_writer.h"
#include "cli/outputs.h"
#include "cli/progress_bar.h"
#include "cli/speech.h"
#include "reference/reference.h"
#include "render/explanation.h"
#include "render/peak_memory.h"
#include "render/render_session.h"
#include "render/renderer.h"
#include "report/profile_table.h"
#include "report/text.h"
#include "scene/byte_counts.h"
#include "scene/machine_memory.h"

namespace whittle::cli {
namespace {

using Clock = std::chrono::steady_clock;
double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct RenderOptions {
  SceneOptions scene;
  Settings settings;
  std::vector<std::filesystem::path> outputs;
  std::vector<std::string> aovTexts;
  std::filesystem::path stats, trace, reference, kernelFolder;
  std::optional<glm::ivec2> explain;  ///< a pixel
  bool withReference = false;         ///< --explain beside the reference
  bool json = false;
  bool profile = false;

  std::vector<AovOutput> aovs;  ///< aovTexts, parsed
};

/// Fills in the default output and refuses, before anything is loaded, what could not be written at the end.
OutputCheck checkOutputs(RenderOptions& o) {
  if (o.outputs.empty() && o.stats.empty() && o.trace.empty() && o.aovTexts.empty() && !o.profile &&
      !o.explain)
    o.outputs.emplace_back(o.scene.file.stem().string() + ".png");
  OutputCheck check(o.settings.width, o.settings.height);
  for (const auto& file : {o.scene.file, std::filesystem::path(o.scene.background), o.reference})
    if (!file.empty()) check.reads(file);
  for (const auto& text : o.aovTexts) o.aovs.push_back(parseAov(text, renderAovs()));
  for (const auto& file : o.outputs) check.picture("--output", file);
  for (const auto& aov : o.aovs) check.picture("--aov", aov.file);
  if (o.settings.alpha) check.alpha(o.outputs);
  check.text("--stats", o.stats);
  check.text("--trace", o.trace);
  if (!o.kernelFolder.empty() && !std::filesystem::is_directory(o.kernelFolder))
    throw InputError(fmt::format("--kernels: {} is no folder", o.kernelFolder.string()));
  return check;
}

FloatImage readReference(const RenderOptions& o) {
  if (o.reference.empty()) return {};
  if (isToneMapped(o.reference))
    throw InputError(fmt::format("--reference: {} holds tone-mapped colours, not radiance; give an .exr",
                                 o.reference.string()));
  FloatImage image;
  try {
    image = readFloatImage(o.reference);
  } catch (const InputError& e) {
    throw InputError(fmt::format("--reference: {}", e.what()));
  }
  if (image.width != o.settings.width || image.height != o.settings.height)
    throw InputError(
        fmt::format("--reference: {} is {}×{} but the picture is {}×{}; set --width and --height",
                    o.reference.string(), image.width, image.height, o.settings.width, o.settings.height));
  if (image.channels < 3)
    throw InputError(fmt::format("--reference: {} has no colours", o.reference.string()));
  return image;
}

/// What `work` returns; errors of kernels and devices in words that help.
template <typename Work>
auto explainingErrors(const RenderOptions& o, const Work& work) {
  try {
    return work();
  } catch (const BuildError& e) {
    explainBuildFailure(e, o.kernelFolder);
  } catch (const std::invalid_argument& e) {
    // With nothing asked for, a machine without a device is no wrong usage.
    if (!o.settings.device.empty()) throw;
    const auto limit = addressLimit();
    throw std::runtime_error(
        limit ? fmt::format(
                    "{}; PoCL needs 1.1 GB of addresses, more with many threads, and ulimit -v leaves {}",
                    e.what(), formatBytes(*limit))
              : fmt::format("{}; a CPU device needs only pocl-opencl-icd or your system's PoCL package",
                            e.what()));
  }
}

/// The pixel's ray trees, on standard output.
void tellExplanation(const Scene& scene, const RenderOptions& o) {
  const int x = o.explain->x, y = o.explain->y;
  if (x >= o.settings.width || y >= o.settings.height)
    throw InputError(fmt::format("--explain: {},{} lies outside the picture of {}×{}", x, y, o.settings.width,
                                 o.settings.height));
  RenderHooks hooks;
  if (!o.kernelFolder.empty()) hooks.kernelFolder = o.kernelFolder;
  hooks.compiler = "/proc/self/exe";
  ProgressBar bar(o.scene.quiet);
  hooks.phase = [&](const std::string& text) { bar.phase(text); };
  Explanation explanation{
      x, y, explainingErrors(o, [&] { return RenderSession().explain(scene, o.settings, x, y, hooks); }), {}};
  if (o.withReference) {
    bar.phase("tracing in double precision");
    explanation.reference = referenceTrees(scene, o.settings, x, y);
  }
  bar.clear();
  if (o.json)
    tellJson(explanationToJson(explanation, scene)
                 .dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
             "\n");
  else
    tell(explanationText(explanation, scene, o.settings));
}

RenderResult renderWithProgress(Scene& scene, const RenderOptions& o, const FloatImage& reference,
                                Trace* trace) {
  ProgressBar bar(o.scene.quiet);
  RenderHooks hooks;
  if (!o.kernelFolder.empty()) hooks.kernelFolder = o.kernelFolder;
  if (!o.reference.empty()) hooks.reference = &reference;
  hooks.timeStages = o.profile || trace || !o.stats.empty();
  hooks.trace = trace;
  hooks.compiler = "/proc/self/exe";
  hooks.consumed = &scene;
  std::future<void> codec;  // loaded while kernels are compiled
  hooks.phase = [&](const std::string& text) {
    bar.phase(text);
    const bool writes = !o.outputs.empty() || !o.aovs.empty();
    if (writes && text == kFirstPhase) codec = std::async(std::launch::async, loadImageCodec);
    if (codec.valid() && text == kLastPhase) codec.get();
  };
  hooks.progress = [&](const RenderProgress& p) {
    bar.update(p.samplesDone / p.samplesTotal, p.seconds,
               formatRate(p.seconds > 0.0 ? static_cast<double>(p.rays) / p.seconds : 0.0));
  };
  hooks.note = [&](const std::string& text) {
    if (o.scene.quiet) return;
    bar.clear();
    note(text);
  };
  return explainingErrors(o, [&] { return render(scene, o.settings, hooks); });
}

ImageMetadata pictureMetadata(const RenderOptions& o, const Stats& stats) {
  return {{"whittle:settings", settingsToJson(stats.settings).dump()},
          {"whittle:scene", o.scene.file.filename().string()},
          {"whittle:rays", fmt::format("primary {} impulse {} shadow {}", stats.rays.primary,
                                       stats.rays.impulse, stats.rays.shadow)},
          {"whittle:raysPerPixel", fmt::format("least {} mean {:g} most {}", stats.samples.least,
                                               stats.samples.mean, stats.samples.most)},
          {"whittle:renderSeconds", fmt::format("{:.6f}", stats.time.render)}};
}

/// The statistics with the options that only this command knows.
std::string statsText(const RenderOptions& o, const Stats& stats) {
  nlohmann::ordered_json json = statsToJson(stats);
  auto& s = json["settings"];
  const auto path = [](const std::filesystem::path& p) {
    return p.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(p.string());
  };
  s["scene"] = path(o.scene.scene);
  s["background"] = path(o.scene.background);
  s["defaultLights"] = o.scene.defaultLights.value_or(false);
  s["output"] = nlohmann::ordered_json::array();
  for (const auto& file : o.outputs) s["output"].push_back(file.string());
  s["aov"] = o.aovTexts;
  s["stats"] = path(o.stats);
  s["profile"] = o.profile;
  s["trace"] = path(o.trace);
  s["reference"] = path(o.reference);
  s["kernels"] = path(o.kernelFolder);
  s["quiet"] = o.scene.quiet;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void writeResults(const RenderOptions& o, const Scene& scene, RenderResult& result, Clock::time_point start,
                  Trace* trace, OutputWriter& files) {
  const auto writing = Clock::now();
  const Look look = lookOf(result.radiance, scene, o.settings, o.outputs, o.scene.quiet);
  result.stats.settings.exposure = look.stops;
  const ImageMetadata metadata = pictureMetadata(o, result.stats);
  nowDoing("writing pictures");
  for (const auto& file : o.outputs)
    files.add(file, "",
              [&](const auto& to) { writePicture(to, result.radiance, result.alpha, look, metadata); });
  for (const auto& aov : o.aovs)
    files.add(aov.file, fmt::format(" ({})", aov.name), [&](const auto& to) {
      writeAov({aov.name, to}, result.radiance, result.alpha, result.aovs, metadata);
    });
  nowDoing("");
  result.stats.time.write = since(writing);
  result.stats.phases.push_back({"write", steadySeconds(writing), result.stats.time.write});
  if (trace) {
    trace->phase("write", writing);
    files.add(o.trace, " (open it in https://ui.perfetto.dev)",
              [&](const auto& to) { writeTextFile(to, trace->toText()); });
  }
  result.stats.time.total = since(start);
  if (!o.stats.empty())
    files.add(o.stats, "", [&](const auto& to) { writeTextFile(to, statsText(o, result.stats)); });
}

void report(const RenderOptions& o, const Stats& stats, const OutputWriter& files) {
  const bool taken = isStandardOutput(o.stats) || isStandardOutput(o.trace);
  if (o.profile) taken ? tellError(profileTable(stats)) : tell(profileTable(stats));
  if (o.scene.quiet || taken) return;
  tell(fmt::format("{}{}{}", o.profile ? "\n" : "", renderSummary(stats), files.summary()));
}

/// Returns the exit status.
int runRender(RenderOptions& o) {
  const auto start = Clock::now();
  OutputCheck check = checkOutputs(o);
  for (const auto& aov : o.aovs) askForAovs(o.settings, {aov.name});
  FloatImage reference = readReference(o);
  if (!o.reference.empty() && reference.hadAlpha != o.settings.alpha)
    warn(fmt::format(
        "--reference: {} has {} alpha channel, but the picture has {}: where the background shows, "
        "their difference is no error",
        o.reference.string(), reference.hadAlpha ? "an" : "no", o.settings.alpha ? "one" : "none"));
  std::unique_ptr<Trace> trace;
  if (!o.trace.empty()) trace = std::make_unique<Trace>();
  warnIfAny(settleKernelCache());
  prepareCpuThreads(o.settings.threads, o.settings.workGroup);

  Notices notices;
  notices.notes = uselessOptions(o.settings);
  MemoryBudget budget = budgetOf(o.scene);
  // The reference's tree comes when the device has let go of the other.
  const std::uint64_t triangle =
      o.withReference ? std::max(kTriangleBytes, kReferenceTriangleBytes) : kTriangleBytes;
  Scene scene = loadScene(o.scene, {triangle, kRuntimeBytes, pictureBytes}, o.settings, budget, notices);
  for (const auto& file : notices.files) check.reads(file);
  if (o.settings.crop && !o.reference.empty()) reference = cutOut(reference, *o.settings.crop);
  if (trace) trace->phase("load", start);
  const double load = since(start);
  if (o.explain) {
    tellExplanation(scene, o);
    if (o.outputs.empty() && o.aovs.empty() && o.stats.empty() && o.trace.empty() && !o.profile) return 0;
  }
  RenderResult result = renderWithProgress(scene, o, reference, trace.get());
  result.stats.time.load = load;
  result.stats.phases.insert(result.stats.phases.begin(), {"load", steadySeconds(start), load});
  if (result.stats.nonFinite > 0)
    warn(fmt::format("{} samples were not finite and count as black", formatInteger(result.stats.nonFinite)));
  if (result.stats.ended.cutOff > 0.0 && !std::isfinite(result.stats.biasBound))
    warn(
        "no bound on what --cutoff left out: a light lies on a surface that scatters it, a "
        "mirror glows, or a factor of a material is outside its range");
  if (!o.scene.quiet)
    for (const std::string& text : limitNotes(result.stats)) note(text);
  OutputWriter files;
  writeResults(o, scene, result, start, trace.get(), files);
  report(o, result.stats, files);
  return files.isComplete() ? 0 : 1;
}

}  // namespace

void addRender(CLI::App& app, int& status) {
  auto o = std::make_shared<RenderOptions>();
  CLI::App* c = app.add_subcommand("render", "render a scene on an OpenCL device");
  addSceneOptions(*c, o->scene);
  c->option_defaults()->group("Output");
  addSeveral(
      *c, "-o,--output", o->outputs, "FILE",
      ".exr: linear radiance; .png, .jpg: tone-mapped sRGB; may be given several times [SCENE's name .png; "
      "none with --profile, --stats, --trace or --aov]");
  addSeveral(*c, "--aov", o->aovTexts, "NAME=FILE",
             "of each pixel's first sample depth|normal|albedo|primitive, at which bounce its light came "
             "(bounce), nodes and triangles that searches for its hits visited (cost); how many samples the "
             "pixel has (samples) and their standard error (error); as .exr (channels Z, normal.X, albedo.R, "
             "primitive.V, …); all: these and the picture as layers of one file; may be given several times");
  addFile(*c, "--stats", o->stats, "FILE",
          "statistics as JSON; -: on standard output, instead of the summary");
  c->add_flag("--profile", o->profile, "print time and rate of each stage");
  addFile(*c, "--trace", o->trace, "FILE",
          "every kernel launch as Chrome/Perfetto JSON; -: on standard output");
  c->add_flag("--quiet", o->scene.quiet,
              "no progress, notes or summary; warnings, errors and --profile only");
  addText(*c, "--explain",
          [&pixel = o->explain](const std::string& word) { pixel = parsePixel("--explain", word); },
          {"X,Y",
           "say why a pixel (from the top left) is as it is: its rays, what each met, carried and brought, "
           "which shadow rays were blocked; no picture then unless one is asked for",
           ""});
  c->add_flag("--with-reference", o->withReference,
              "--explain traces the pixel in double precision too, and says below each line what differs by "
              "more than rounding")
      ->needs("--explain");
  c->add_flag("--json", o->json, "--explain as JSON");
  addPictureOptions(*c, o->settings, o->scene);
  addErrorOptions(*c, o->settings);
  addFile(*c, "--reference", o->reference, "FILE",
          "measure the true RMSE against this .exr after each pass; the summary has the last, --stats all");
  addDeviceOptions(*c, o->settings);
  addFile(*c, "--kernels", o->kernelFolder, "FOLDER",
          "read kernels from here, not from the program (for developers)");
  c->footer("Example: whittle render scene.glb -o a.png -o a.exr --stats stats.json");
  c->callback([o, c, &status] {
    settleRaysPerPixel(*c, o->settings);
    status = runRender(*o);
  });
}

}  // namespace whittle::cli
