// whittle render: the OpenCL wavefront, from a glTF file to pictures and statistics.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>

#include "cl/device.h"
#include "cl/kernel_cache.h"
#include "cli/aovs.h"
#include "cli/commands.h"
#include "cli/crop.h"
#include "cli/draw.h"
#include "cli/error_options.h"
#include "cli/frames.h"
#include "cli/guard.h"
#include "cli/option_kinds.h"
#include "cli/options.h"
#include "cli/outputs.h"
#include "cli/progress_bar.h"
#include "cli/speech.h"
#include "reference/reference.h"
#include "render/explanation.h"
#include "render/peak_memory.h"
#include "render/render_session.h"
#include "scene/byte_counts.h"
#include "scene/machine_memory.h"

namespace whittle::cli {
namespace {

using Clock = std::chrono::steady_clock;

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
  Explanation explanation{x, y, {}, {}};
  explainingErrors(o, [&] { explanation.trees = RenderSession().explain(scene, o.settings, x, y, hooks); });
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

/// Of one frame: its files, its time, and how far everything is.
RenderOptions optionsOf(const RenderOptions& o, const Frames& frames, int frame) {
  RenderOptions one = o;
  one.scene.time = frames.secondsOf(frame);
  one.scene.isAgain = frame > frames.first;
  one.picturesToCome = frames.last - frame;
  one.what = fmt::format("frame {} of {}", frame - frames.first + 1, frames.count());
  for (auto& file : one.outputs) file = frameFile(file, frame);
  for (auto& aov : one.aovs) aov.file = frameFile(aov.file, frame);
  if (!one.stats.empty()) one.stats = frameFile(one.stats, frame);
  return one;
}

/// What makes no sense for many pictures, or would have each in the place of the one before.
void checkFrameOptions(const RenderOptions& o) {
  if (o.scene.time) throw InputError("--time and --frames: give one of the two");
  for (const auto& [isAsked, name] :
       {std::pair(o.explain.has_value(), "--explain"), std::pair(o.profile, "--profile"),
        std::pair(!o.trace.empty(), "--trace"), std::pair(!o.reference.empty(), "--reference")})
    if (isAsked) throw InputError(fmt::format("{}: is for one picture, --frames draws several", name));
  if (isStandardOutput(o.stats)) throw InputError("--stats: name a file, --frames writes one for each frame");
}

/// What was set up around the first frame stays, or a film would jump.
class FirstFrame {
 public:
  explicit FirstFrame(const Scene& scene)
      : cameras_(scene.cameras),
        lights_(scene.lights),
        background_(scene.background),
        origin_(scene.origin) {}

  void keepIn(Scene& scene) const {
    scene.background = background_;
    if (scene.hasStudioLights) scene.lights = lights_;  // directional: they have no place
    if (!scene.hasOurCamera) return;
    scene.cameras = cameras_;
    for (Camera& camera : scene.cameras)
      camera.position = glm::vec3(glm::dvec3(camera.position) + origin_ - scene.origin);
  }

 private:
  std::vector<Camera> cameras_;
  std::vector<Light> lights_;
  Background background_;
  glm::dvec3 origin_;
};

/// One picture after the other on an open device: what does not move stays there. Each has the bits of the
/// picture at its --time, but for what is chosen to suit the scene (exposure, ambient light, focus, studio, a
/// camera that is not the file's), which is that of the first.
int runFrames(RenderOptions& o) {
  Frames frames = *o.frames.frames;
  frames.perSecond = o.frames.perSecond;
  checkFrameOptions(o);
  checkOutputs(o);
  RenderOptions last = optionsOf(o, frames, frames.last);
  last.aovTexts.clear();
  OutputCheck check = checkOutputs(last);
  for (const auto& aov : o.aovs) askForAovs(o.settings, {aov.name});
  warnIfAny(settleKernelCache());
  prepareCpuThreads(o.settings.threads, o.settings.workGroup);
  RenderSession session;
  std::optional<FirstFrame> first;
  bool isComplete = true;
  for (int frame = frames.first; frame <= frames.last; ++frame) {
    const auto start = Clock::now();
    RenderOptions one = optionsOf(o, frames, frame);
    Notices notices;
    notices.notes = uselessOptions(one.settings);
    MemoryBudget budget = budgetOf(one.scene);
    Scene scene =
        loadScene(one.scene, {kTriangleBytes, kRuntimeBytes, pictureBytes}, one.settings, budget, notices);
    for (const auto& file : notices.files) check.reads(file);
    if (first)
      first->keepIn(scene);
    else
      first.emplace(scene);
    if (scene.meshesMove) session.sceneChanged();
    float stops = 0.0F;
    isComplete &= drawScene(one, scene, {}, nullptr, &session, start, secondsSince(start), stops);
    o.settings.exposure = stops;
    o.settings.ambient = one.settings.ambient;
    o.settings.focusDistance = one.settings.focusDistance;
  }
  return isComplete ? 0 : 1;
}

/// Returns the exit status.
int runRender(RenderOptions& o) {
  if (o.frames.frames) return runFrames(o);
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
  const double load = secondsSince(start);
  if (o.explain) {
    tellExplanation(scene, o);
    if (o.outputs.empty() && o.aovs.empty() && o.stats.empty() && o.trace.empty() && !o.profile) return 0;
  }
  float stops = 0.0F;
  return drawScene(o, scene, reference, trace.get(), nullptr, start, load, stops) ? 0 : 1;
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
  addFrameOptions(*c, o->frames);
  addPictureOptions(*c, o->settings, o->scene);
  addErrorOptions(*c, o->settings);
  addFile(*c, "--reference", o->reference, "FILE",
          "measure the true RMSE against this .exr after each pass; the summary has the last, --stats all");
  addDeviceOptions(*c, o->settings);
  addChoice(*c, "--tier", o->tier,
            "which programs draw: general ones from the cache (`whittle cache`), those cut to the scene, or "
            "general ones until its own are compiled; the picture has the same bits");
  addFile(*c, "--kernels", o->kernelFolder, "FOLDER",
          "read kernels from here, not from the program (for developers)");
  c->footer("Example: whittle render scene.glb -o a.png -o a.exr --stats stats.json");
  c->callback([o, c, &status] {
    settleRaysPerPixel(*c, o->settings);
    status = runRender(*o);
  });
}

}  // namespace whittle::cli
