// See draw.h.
#include "cli/draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <future>

#include "cl/device.h"
#include "cli/build_failure.h"
#include "cli/guard.h"
#include "cli/output_writer.h"
#include "cli/outputs.h"
#include "cli/progress_bar.h"
#include "cli/speech.h"
#include "render/renderer.h"
#include "report/profile_table.h"
#include "report/text.h"
#include "scene/byte_counts.h"
#include "scene/machine_memory.h"

namespace whittle::cli {
namespace {

using Clock = std::chrono::steady_clock;
using Files = std::vector<std::filesystem::path>;

RenderResult renderWithProgress(Scene& scene, const RenderOptions& o, const FloatImage& reference,
                                Trace* trace, RenderSession& session) {
  ProgressBar bar(o.scene.quiet, o.what);
  RenderHooks hooks;
  if (!o.kernelFolder.empty()) hooks.kernelFolder = o.kernelFolder;
  if (!o.reference.empty()) hooks.reference = &reference;
  hooks.timeStages = timesStages(o);
  hooks.trace = trace;
  hooks.compiler = "/proc/self/exe";
  hooks.tier = o.tier;
  hooks.picturesToCome = o.picturesToCome;
  if (!o.frames.frames) hooks.consumed = &scene;
  std::future<void> codec;  // loaded while kernels are compiled
  hooks.phase = [&](const std::string& text) {
    bar.phase(text);
    const bool writes = !o.aovs.empty() || std::any_of(o.outputs.begin(), o.outputs.end(), needsImageCodec);
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
  if (o.checkpointing) o.checkpointing->hookInto(hooks);
  RenderResult result;
  explainingErrors(o, [&] {
    result = session.render(scene, o.settings, hooks);
    if (!o.frames.frames) session.close();  // what follows may need the room
  });
  return result;
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
  s["time"] = o.scene.time ? nlohmann::ordered_json(*o.scene.time) : nlohmann::ordered_json(nullptr);
  s["animation"] = path(o.scene.animation);
  s["variant"] = path(o.scene.variant);
  s["defaultLights"] = o.scene.defaultLights.value_or(false);
  s["output"] = nlohmann::ordered_json::array();
  for (const auto& file : o.outputs) s["output"].push_back(file.string());
  s["aov"] = o.aovTexts;
  s["stats"] = path(o.stats);
  s["profile"] = o.profile;
  s["trace"] = path(o.trace);
  s["reference"] = path(o.reference);
  s["kernels"] = path(o.kernelFolder);
  for (const auto& [word, tier] : kTierWords)
    if (tier == o.tier) s["tier"] = word;
  s["quiet"] = o.scene.quiet;
  s["checkpoint"] = path(o.checkpoint.file);
  s["every"] = o.checkpoint.every;
  s["partial"] = o.checkpoint.partial;
  s["resume"] = path(o.checkpoint.resume);
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void writeResults(const RenderOptions& o, const Scene& scene, RenderResult& result, Clock::time_point start,
                  Trace* trace, OutputWriter& files) {
  const auto writing = Clock::now();
  const Look look = lookOf(result.radiance, scene, o.settings, o.outputs, o.scene.quiet);
  result.stats.settings.exposure = look.stops;
  const ImageMetadata metadata = pictureMetadata(o, result.stats);
  nowDoing("writing pictures");
  const bool draws = !o.checkpointing || !o.checkpointing->keepsPictureBack();
  for (const auto& file : draws ? o.outputs : Files{})
    files.add(file, "",
              [&](const auto& to) { writePicture(to, result.radiance, result.alpha, look, metadata); });
  for (const auto& aov : draws ? o.aovs : std::vector<AovOutput>{})
    files.add(aov.file, fmt::format(" ({})", aov.name), [&](const auto& to) {
      writeAov({aov.name, to}, result.radiance, result.alpha, result.aovs, metadata);
    });
  nowDoing("");
  result.stats.time.write = secondsSince(writing);
  result.stats.phases.push_back({"write", steadySeconds(writing), result.stats.time.write});
  if (trace) {
    trace->phase("write", writing);
    files.add(o.trace, " (open it in https://ui.perfetto.dev)",
              [&](const auto& to) { writeTextFile(to, trace->toText()); });
  }
  result.stats.time.total = secondsSince(start);
  if (!o.stats.empty())
    files.add(o.stats, "", [&](const auto& to) { writeTextFile(to, statsText(o, result.stats)); });
}

void report(const RenderOptions& o, const Stats& stats, const OutputWriter& files) {
  const bool taken = isStandardOutput(o.stats) || isStandardOutput(o.trace);
  if (o.profile) taken ? tellError(profileTable(stats)) : tell(profileTable(stats));
  if (o.scene.quiet || taken) return;
  tell(fmt::format("{}{}{}", o.profile ? "\n" : "", renderSummary(stats), files.summary()));
}

void warnOfResult(const RenderOptions& o, const Stats& stats) {
  if (stats.nonFinite > 0)
    warn(fmt::format("{} samples were not finite and count as black", formatInteger(stats.nonFinite)));
  if (o.isLater) return;  // said of the first
  if (stats.ended.cutOff > 0.0 && !std::isfinite(stats.biasBound))
    warn(
        "no bound on what --cutoff left out: a light lies on a surface that scatters it, a "
        "mirror glows, or a factor of a material is outside its range");
  if (!o.scene.quiet)
    for (const std::string& text : limitNotes(stats)) note(text);
}

}  // namespace

void explainingErrors(const RenderOptions& o, const std::function<void()>& work) {
  try {
    work();
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

bool timesStages(const RenderOptions& o) { return o.profile || !o.trace.empty() || !o.stats.empty(); }

bool drawScene(RenderOptions& o, Scene& scene, const FloatImage& reference, Trace* trace,
               RenderSession& session, Clock::time_point start, double load, float& stops) {
  RenderResult result = renderWithProgress(scene, o, reference, trace, session);
  result.stats.time.load = load;
  result.stats.phases.insert(result.stats.phases.begin(), {"load", steadySeconds(start), load});
  warnOfResult(o, result.stats);
  OutputWriter files;
  writeResults(o, scene, result, start, trace, files);
  report(o, result.stats, files);
  if (o.checkpointing) o.checkpointing->sayHowToGoOn(result.stats);
  stops = *result.stats.settings.exposure;
  return files.isComplete();
}

}  // namespace whittle::cli
