// whittle render: the OpenCL wavefront, from a glTF file to pictures and statistics.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <future>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>

#include "cl/device.h"
#include "cl/kernel_cache.h"
#include "cli/aovs.h"
#include "cli/application.h"
#include "cli/checkpoint.h"
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
#include "gltf/loader.h"
#include "reference/blockers.h"
#include "reference/reference.h"
#include "render/explanation.h"
#include "render/peak_memory.h"
#include "render/preparation.h"
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
  if (isStandardOutput(o.checkpoint.file)) throw InputError("--checkpoint: name a file, it is read again");
  check.text("--checkpoint", o.checkpoint.file);
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
  for (std::size_t i = 0; i < std::min(explanation.trees.size(), kToldSamples); ++i)
    findBlockers(scene, explanation.trees[i]);
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
  one.isLater = frame > frames.first;
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
      : cameras_(scene.cameras), lights_(scene.lights), origin_(scene.origin) {}

  void keepIn(Scene& scene) const {
    if (scene.hasStudioLights) scene.lights = lights_;  // directional: they have no place
    if (!scene.hasOurCamera) return;
    scene.cameras = cameras_;
    for (Camera& camera : scene.cameras)
      camera.position = glm::vec3(glm::dvec3(camera.position) + origin_ - scene.origin);
  }

 private:
  std::vector<Camera> cameras_;
  std::vector<Light> lights_;
  glm::dvec3 origin_;
};

/// What a scene keeps in memory for the next frame, though the device has it too.
std::uint64_t bytesKept(const Scene& scene) {
  std::uint64_t bytes = sizeof(glm::vec3) * scene.normals.size() + sizeof(glm::vec4) * scene.tangents.size() +
                        sizeof(glm::vec2) * (scene.uv0.size() + scene.uv1.size());
  for (const Image& image : scene.images)
    bytes += image.texels.size() + sizeof(std::uint16_t) * image.deepTexels.size();
  return bytes;
}

/// Settles what the settings leave to the scene, for all frames.
Scene loadFirstFrame(RenderOptions& o, const Frames& frames, OpenFile& file, OutputCheck& check) {
  RenderOptions one = optionsOf(o, frames, frames.first);
  Notices notices;
  notices.notes = uselessOptions(one.settings);
  MemoryBudget budget = budgetOf(one.scene);
  Scene scene = loadScene(one.scene, {kTriangleBytes, kRuntimeBytes + kCodecBytes, pictureBytes},
                          one.settings, budget, notices, &file);
  budget.hold(bytesKept(scene), "--frames: what the frames share");
  for (const auto& read : notices.files) check.reads(read);
  if (!file.moves() && frames.count() > 1)
    warn(fmt::format("--frames: no mesh, camera or light of the scene moves: the {} pictures are alike",
                     frames.count()));
  o.settings = one.settings;
  return scene;
}

/// One picture after the other of an open file on an open device: what does not move stays where it is. Each
/// has the bits of the picture at its --time, but for what is chosen to suit the scene (exposure, ambient
/// light, focus, studio, a camera that is not the file's), which is that of the first.
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
  OpenFile file;
  auto start = Clock::now();
  Scene scene = loadFirstFrame(o, frames, file, check);
  const FirstFrame first(scene);
  bool isComplete = true;
  for (int frame = frames.first; frame <= frames.last; ++frame, start = Clock::now()) {
    RenderOptions one = optionsOf(o, frames, frame);
    if (one.isLater) {
      file.moveTo(*one.scene.time, scene);
      first.keepIn(scene);
      if (scene.meshesMove) session.meshesMoved();
    }
    float stops = 0.0F;
    isComplete &= drawScene(one, scene, {}, nullptr, session, start, secondsSince(start), stops);
    o.settings.exposure = stops;
  }
  return isComplete ? 0 : 1;
}

/// While the scene is read. What goes wrong goes wrong again, and is said, when the picture is drawn.
void openAhead(RenderSession& session, const RenderOptions& o) {
  const LoggedWork work(o.scene.log, "open the device");
  RenderHooks hooks;
  hooks.timeStages = timesStages(o);
  try {
    session.open(o.settings, hooks);
  } catch (const std::exception&) {
    return;
  }
}

/// Of what is recorded of each pixel's first rays nothing outlasts the process.
void checkResumable(const RenderOptions& o) {
  if (!o.checkpoint.areAsked()) return;
  const char* const name = o.checkpoint.file.empty() ? "--resume" : "--checkpoint";
  if (o.frames.frames) throw InputError(fmt::format("{}: is for one picture, --frames draws several", name));
  if (o.settings.bounceAov || o.settings.costAov)
    throw InputError(fmt::format("{}: not with --aov bounce, cost or all", name));
}

/// The render that --resume names, without a scene: as if somebody had typed its command again.
int runAgain(const std::vector<std::string>& arguments) {
  std::vector<const char*> words{"whittle"};
  for (const std::string& word : arguments) words.push_back(word.c_str());
  return runApplication(static_cast<int>(words.size()), words.data());
}

/// Returns the exit status.
int runRender(RenderOptions& o) {
  if (const auto again = resumedArguments(o.checkpoint, o.scene); !again.empty()) return runAgain(again);
  if (o.frames.frames) {
    checkResumable(o);
    return runFrames(o);
  }
  const auto start = Clock::now();
  OutputCheck check = checkOutputs(o);
  for (const auto& aov : o.aovs) askForAovs(o.settings, {aov.name});
  checkResumable(o);
  o.settings.resumable = o.checkpoint.areAsked();
  FloatImage reference = readReference(o);
  if (!o.reference.empty() && reference.hadAlpha != o.settings.alpha)
    warn(fmt::format(
        "--reference: {} has {} alpha channel, but the picture has {}: where the background shows, "
        "their difference is no error",
        o.reference.string(), reference.hadAlpha ? "an" : "no", o.settings.alpha ? "one" : "none"));
  std::unique_ptr<Trace> trace;
  if (!o.trace.empty()) trace = std::make_unique<Trace>();
  if (trace)
    o.scene.log = [&](const std::string& what, Clock::time_point began) { trace->work(what, began); };
  warnIfAny(settleKernelCache());
  prepareCpuThreads(o.settings.threads, o.settings.workGroup);
  const auto threads = limitThreads(o.settings.threads);
  RenderSession session;
  std::future<void> opening;
  if (!o.explain) opening = std::async(std::launch::async, [&] { openAhead(session, o); });

  Notices notices;
  notices.notes = uselessOptions(o.settings);
  MemoryBudget budget = budgetOf(o.scene);
  // The reference's tree comes when the device has let go of the other.
  const std::uint64_t triangle =
      o.withReference ? std::max(kTriangleBytes, kReferenceTriangleBytes) : kTriangleBytes;
  Scene scene =
      loadScene(o.scene, {triangle, kRuntimeBytes + kCodecBytes, pictureBytes}, o.settings, budget, notices);
  for (const auto& file : notices.files) check.reads(file);
  if (o.settings.crop && !o.reference.empty()) reference = cutOut(reference, *o.settings.crop);
  if (trace) trace->phase("load", start);
  if (o.checkpoint.areAsked())
    o.checkpointing =
        std::make_shared<Checkpointing>(o.checkpoint, identityOf(o.scene, scene, o.settings, notices.files));
  const double load = secondsSince(start);
  if (o.explain) {
    tellExplanation(scene, o);
    if (o.outputs.empty() && o.aovs.empty() && o.stats.empty() && o.trace.empty() && !o.profile) return 0;
  }
  float stops = 0.0F;
  if (opening.valid()) opening.wait();
  return drawScene(o, scene, reference, trace.get(), session, start, load, stops) ? 0 : 1;
}

}  // namespace

void addRender(CLI::App& app, int& status, const std::vector<std::string>& arguments) {
  auto o = std::make_shared<RenderOptions>();
  o->checkpoint.arguments = arguments;
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
  addCheckpointOptions(*c, o->checkpoint);
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
