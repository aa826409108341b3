// Shared options; see the header.
#include "cli/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "analysis/feature_needs.h"
#include "analysis/focus.h"
#include "cli/background.h"
#include "cli/error_options.h"
#include "cli/feature_names.h"
#include "cli/guard.h"
#include "cli/option_kinds.h"
#include "cli/settle_ambient.h"
#include "cli/speech.h"
#include "gltf/loader.h"
#include "report/text.h"
#include "scene/byte_counts.h"
#include "scene/camera.h"
#include "scene/emitters.h"
#include "scene/input_error.h"
#include "scene/machine_memory.h"
#include "scene/sky_light.h"

namespace whittle::cli {
namespace {

/// Of --memory-limit: whoever asks for less has left out the unit.
constexpr std::uint64_t kLeastLimit = 1'000'000;
constexpr double kLongestTime = 1e6;  // seconds
constexpr double kLeastBloomRadius = 1e-3;
/// Surfaces smoother than this look like mirrors, glossy or not.
constexpr float kGlossyMirrorRoughness = 0.03F;

}  // namespace

void addSceneOptions(CLI::App& c, SceneOptions& o) {
  c.option_defaults()->group("Scene");
  const auto setFile = [&o](const std::string& word) {
    if (word.empty()) throw InputError("SCENE: the name is empty; it is a .gltf or .glb file");
    o.file = word;
  };
  c.add_option_function<std::string>("SCENE", setFile, "glTF 2.0 file, .gltf or .glb")
      ->required()
      ->type_name("");
  addText(c, "--scene", [&o](const std::string& v) { o.scene = v; },
          {"NAME|INDEX", "which scene of the file", "the file's default"});
  addText(c, "--animation", [&o](const std::string& v) { o.animation = v; },
          {"NAME|INDEX", "which animation of the file is shown at --time; without that, its beginning",
           "the first"});
  addText(c, "--variant", [&o](const std::string& v) { o.variant = v; },
          {"NAME|INDEX", "which variant of the materials (KHR_materials_variants); info lists them", "none"});
  addText(
      c, "--time", [&o](const std::string& v) { o.time = parseReal("--time", v, 0, kLongestTime); },
      {"SECONDS",
       "show the scene as the animation has it then: nodes, skins, morph targets and properties by pointer",
       "as the file rests"});
  addText(c, "--background", [&o](const std::string& v) { o.background = v; },
          {"R,G,B|FILE",
           "what rays that leave the scene see: a radiance in W/(m² sr), or an equirectangular .hdr or .exr "
           "(R, G and B of the file, or of its only layer); it lights what is matte with --sky-light",
           "as the file says"});
  c.add_flag_callback(
      "--default-lights", [&o] { o.defaultLights = true; },
      "light a file that has neither lights nor a background like a studio [where something would be dark]");
  c.add_flag_callback(
      "--no-default-lights", [&o] { o.defaultLights = false; }, "never do so");
  c.add_flag("--default-background,!--no-default-background", o.defaultBackground,
             "with those lights, surroundings of a studio for smooth surfaces to mirror [on]");
  c.add_flag(
      "--confine", o.confined,
      "refuse a file that reads buffers or images outside its own folder; otherwise a note says so [off]");
  addText(c, "--memory-limit",
          [&o](const std::string& word) {
            const auto bytes = parseBytes(word);
            if (!bytes)
              throw InputError(fmt::format("--memory-limit: '{}' is not a size such as 500M or 4G", word));
            if (*bytes < kLeastLimit)
              throw InputError(
                  fmt::format("--memory-limit: '{}' is {}, less than anything takes; sizes have units: "
                              "500M, 4G",
                              word, formatBytes(*bytes)));
            o.memory = MemoryLimit{*bytes, true};
          },
          {"SIZE",
           "refuse what would take more memory than this, before it is taken: 500M, 4G, 2GiB; what compiling "
           "kernels takes the first time is not counted",
           "four fifths of what is free, and for the file at most 4 GB and 256 bytes for each of its own"});
}

void addPictureOptions(CLI::App& c, Settings& s, SceneOptions& o) {
  c.option_defaults()->group("Picture");
  o.width = addWhole(c, "--width", s.width, 1, 65535, "PIXELS", "width of the picture");
  o.height = addWhole(c, "--height", s.height, 1, 65535, "PIXELS", "height of the picture");
  addText(c, "--crop",
          [&s, &o](const std::string& word) {
            s.crop.reset();
            o.crop = word == "none" ? std::nullopt : std::optional(parseCrop("--crop", word));
          },
          {"X,Y,W,H",
           "trace only this region, from the picture's top left, in pixels, or in shares of its width and "
           "height with a decimal point or %: 25%,25%,50%,50%. Its pixels have the bits of the whole "
           "picture; files have its size, an .exr its place; error, statistics and memory are its own",
           "none"});
  addText(c, "--pixel",
          [&o](const std::string& word) {
            const glm::ivec2 at = parsePixel("--pixel", word);
            o.crop = Crop{{static_cast<double>(at.x), static_cast<double>(at.y), 1, 1}};
          },
          {"X,Y", "trace only this pixel: --crop X,Y,1,1", ""});
  CLI::Option* camera = addText(c, "--camera", [&s](const std::string& v) { s.camera = v; },
                                {"NAME|INDEX", "camera of the scene, or the node that has it", s.camera});
  addViewpointOptions(c, o.view, camera);
  addText(c, "--exposure",
          [&s](const std::string& word) { s.exposure = parseRealOrAuto("--exposure", word, -60, 60); },
          {"auto|STOPS", "brightness of .png and .jpg; auto changes it only where the picture does not fit",
           "auto"});
  addChoice(c, "--tone-map", s.toneMap,
            "of .png and .jpg: roll highlights off, or cut them; auto: none where all materials are unlit");
  addText(
      c, "--bloom",
      [&s](const std::string& word) {
        const auto numbers = parseNumbers("--bloom", word, 1, 2);
        const double radius = numbers.size() == 2 ? numbers[1] : kLeastBloomRadius;
        if (!(numbers[0] >= 0.0 && numbers[0] <= 1.0 && radius >= kLeastBloomRadius && radius <= 1.0))
          throw InputError(fmt::format(
              "--bloom: '{}': the strength is a share of the light, 0 to 1, the radius one of the "
              "picture's height, {} to 1",
              word, kLeastBloomRadius));
        s.bloom = Bloom{static_cast<float>(numbers[0])};
        if (numbers.size() == 2) s.bloom.radius = static_cast<float>(numbers[1]);
      },
      {"STRENGTH[,RADIUS]",
       "of .png and .jpg: spread this share of the light (0 to 1; 0.05 is much) about where it is, as lenses "
       "and eyes do, as far as RADIUS times the picture's height (0.001 to 1) [0.1]; a region's comes from "
       "the region alone",
       "0"});
  c.add_flag(
      "--dither,!--no-dither", s.dither,
      "of .png and .jpg: round codes up or down by a fine pattern, so that slow gradients show no bands "
      "[off]");

  c.option_defaults()->group("Light");
  constexpr double kLargest = std::numeric_limits<double>::max();
  addText(c, "--sky", [&s](const std::string& word) { s.sky = parseSky("--sky", word); },
          {"ELEVATION,AZIMUTH[,TURBIDITY]",
           "a clear sky and its sun around the scene: degrees above the horizon (-6 to 90; below 0 is dusk), "
           "degrees from +Z towards +X, haze from 1.7 to 10 [3]; in W/(m² sr), which --exposure auto makes "
           "fit; none: leave out the file's",
           "auto: as the file says"});
  addReal(
      c, "--background-rotation", s.backgroundRotation, -kLargest, kLargest, "DEGREES",
      "turn what surrounds the scene about +Y, counter-clockwise seen from above: 90 brings what was at +X "
      "to -Z",
      "0");
  addReal(c, "--background-strength", s.backgroundStrength, 0, 1e6, "FACTOR",
          "times the radiance of what surrounds the scene", "1");
  addWhole(c, "--bounces", s.bounces, 1, 4096, "N",
           "backward tracing steps; 1 = direct light only. A note says if much ends there, --stats how much");
  addWhole(c, "--transparent-bounces", s.transparentBounces, 0, 4096, "N",
           "surfaces that a ray may pass straight on, besides its bounces: blended or clear ones");
  addChoice(c, "--texture-filter", s.textureFilter,
            "what a ray sees of a texture that is finer than its pixel: the texels that it hits, the mean of "
            "a circle, or "
            "of a strip as long as the pixel is on the surface");
  addChoice(c, "--back-faces", s.backFaces,
            "backs of single-sided surfaces that light does not pass; shadow rays meet them in any case");
  c.add_flag(
      "--alpha", s.alpha,
      "give .png (colours not multiplied by it), .exr (multiplied) and --aov all an alpha channel: the "
      "background is left out where it is seen straight on, and out of what --exposure auto looks at; "
      "mirrors and solid glass still show it [off]");
  c.add_flag("--clip-far", s.clipFar,
             "show nothing beyond the camera's zfar; many tools write one that means nothing [off]");
  o.ambient = addText(
      c, "--ambient",
      [&s](const std::string& word) { s.ambient = parseRealOrAuto("--ambient", word, 0, kLargestAmbient); },
      {"auto|X",
       "Whitted's ambient term: radiance in W/(m² sr) that surfaces receive from all sides, unshadowed; "
       "auto: a tenth of the scene's light; with --sky as much of it as what is seen gets of the sky",
       "0; auto with the studio's lights or a sky"});
  addReal(c, "--cutoff", s.cutoff, 0, kLargestCutoff, "T",
          "trace no mirror or glass ray whose share of the picture (throughput) is at most this in every "
          "colour; --stats says what that and the limits of depth can cost (biasBound beside meanRadiance)",
          "0: trace them all");
  addWhole(c, "--rays-per-pixel", s.raysPerPixel, 1, 1 << 24, "N",
           "primary rays; 1 = through the pixel's centre");
  addReal(c, "--aperture", s.aperture, 0, 1e18, "METRES",
          "diameter of the camera's lens: what is nearer or farther than the focus is blurred",
          "0: a pinhole");
  o.focusPixel = addText(c, "--focus-pixel",
                         [&o](const std::string& word) { o.focus = parsePixel("--focus-pixel", word); },
                         {"X,Y", "focus on what is seen there, in pixels from the top left", "the middle"});
  addText(c, "--focus-distance",
          [&s](const std::string& word) {
            s.focusDistance = parseRealOrAuto("--focus-distance", word, 1e-6, 1e18);
          },
          {"auto|METRES", "focus on this distance along the camera's axis", "auto: what the middle shows"})
      ->excludes(o.focusPixel);
  c.add_flag("--glossy,!--no-glossy", s.glossy,
             "rough surfaces reflect and refract what is around them, blurred, from several rays per pixel "
             "on [off]");
  c.add_flag(
      "--area-lights,!--no-area-lights", s.areaLights,
      "surfaces that glow light others, from several rays per pixel on; the scene gets no lights of ours "
      "then [off]");
  c.add_flag("--sky-light,!--no-sky-light", s.skyLight,
             "what surrounds the scene (--background) lights it, with shadows, from several rays per pixel "
             "on; in the "
             "place of --ambient, and the scene gets no lights of ours then [off]");
  c.add_flag("--smooth-terminator,!--no-smooth-terminator", s.smoothTerminator,
             "shadows begin without facets where coarse triangles have smooth normals [on]");
  addReal(c, "--light-radius", s.lightRadius, 0, 1e18, "METRES",
          "of every point and spot light: shadows get soft edges, from several rays per pixel on", "0");
  addReal(c, "--sun-angle", s.sunAngle, 0, 180, "DEGREES",
          "that every directional light fills, likewise; the sun fills 0.53", "0");
  c.add_flag("--shadows,!--no-shadows", s.shadows, "trace shadow rays [on]");
  addChoice(c, "--sampler", s.sampler, "where in the pixel its rays start");
  addWhole(c, "--seed", s.seed, 0, std::numeric_limits<std::uint32_t>::max(), "N", "of every random number");
  addChoice(c, "--impulses", s.impulses, "follow both branches of a surface, or one chosen at random");
  addReal(c, "--ray-offset,--bump", s.rayOffset, 0, 1e30, "METRES",
          "distance of a ray's origin from its surface", "from the rounding error of each hit");
  o.mirrorRoughness = addReal(c, "--mirror-roughness", s.mirrorRoughness, 0, 1, "R",
                              "surfaces smoother than this are mirrors",
                              fmt::format("{}; {} with --glossy", s.mirrorRoughness, kGlossyMirrorRoughness));
}

void addDeviceOptions(CLI::App& c, Settings& s) {
  c.option_defaults()->group("Device");
  addText(c, "--device", [&s](const std::string& v) { s.device = v; },
          {"SELECTOR", "index from `whittle devices`, part of a name, or cpu|gpu",
           "the first CPU, else the first"});
  addWhole(c, "--threads", s.threads, 0, 4096, "N", "threads of a CPU device and of the tree builder",
           "0: all");
  addWhole(c, "--wavefront", s.wavefront, 1, 1 << 28, "N",
           "rays in flight; raised to 512 and lowered to what the picture needs");
  addWhole(c, "--work-group", s.workGroup, 0, 65536, "N", "work items of a group",
           "0: chosen for the device");
  addChoice(c, "--search", s.search, "how the nearest triangle is found");
  addChoice(c, "--lanes", s.lanes, "rays that one work item searches for");
  c.add_flag("--relaxed-arithmetic", s.relaxedArithmetic,
             "shade with -cl-fast-relaxed-math; watertight surfaces, exact textures and the count of samples "
             "that are not finite are not promised then [off]");
  c.add_flag("--keep-all-features", s.keepAllFeatures,
             "compile and run everything that no other option decides, needed or not");
  addText(c, "--keep-features",
          [&s](const std::string& v) { s.keepFeatures = parseFeatureNames("--keep-features", v); },
          {"LIST",
           "compile and run these and what they need, whatever the scene needs: names as `whittle info` has "
           "them, with commas",
           ""});
}

float standardMirrorRoughness(const Settings& settings) {
  return settings.glossy ? kGlossyMirrorRoughness : Settings{}.mirrorRoughness;
}

void settleMirrorRoughness(const SceneOptions& options, Settings& settings) {
  if (!given(options.mirrorRoughness)) settings.mirrorRoughness = standardMirrorRoughness(settings);
}

std::vector<std::string> uselessOptions(const Settings& settings) {
  std::vector<std::string> lines = uselessKeeps(settings);
  for (auto& line : uselessAdaptive(settings)) lines.push_back(std::move(line));
  return lines;
}

namespace {

double aspectOf(const Settings& settings) { return static_cast<double>(settings.width) / settings.height; }
const Camera& cameraOf(const Scene& scene, const Settings& settings) {
  return scene.cameras[findCamera(scene, settings.camera)];
}

/// The side of the picture that was not given.
void settleSize(const SceneOptions& options, const Scene& scene, Settings& settings) {
  if (given(options.width) == given(options.height)) return;
  const Camera& camera = cameraOf(scene, settings);
  const double aspect = camera.aspect > 0.0F ? static_cast<double>(camera.aspect) : kUsualAspect;
  const auto side = [](double pixels) {
    return static_cast<int>(std::clamp(std::round(pixels), 1.0, 65535.0));
  };
  if (given(options.width))
    settings.height = side(settings.width / aspect);
  else
    settings.width = side(settings.height * aspect);
}

}  // namespace

MemoryBudget budgetOf(const SceneOptions& options) {
  return MemoryBudget(options.memory.value_or(memoryLimitOfMachine()));
}

void promisePicture(MemoryBudget& budget, const CommandCosts& costs, const Settings& settings) {
  budget.promise(costs.picture(settings), fmt::format("a picture of {}", sizeText(settings)),
                 MemoryBudget::Cause::CommandLine);
}

namespace {

/// What a lens is focused on, where nobody gives a distance.
void settleFocus(const SceneOptions& options, const Scene& scene, Settings& settings, Notices& notices) {
  if (!(settings.aperture > 0.0F) || settings.focusDistance) return;
  const auto place = [](int pixel, int size) { return (pixel + 0.5) / size; };
  double x = 0.5, y = 0.5;
  if (options.focus) {
    const int column = options.focus->x, row = options.focus->y;
    if (column >= settings.width || row >= settings.height)
      throw InputError(fmt::format("--focus-pixel: {},{} is outside the picture of {}×{}", column, row,
                                   settings.width, settings.height));
    x = place(column, settings.width), y = place(row, settings.height);
  }
  settings.focusDistance = focusOn(scene, cameraOf(scene, settings), aspectOf(settings), x, y);
  notices.note(fmt::format("focused on {:.4g} m", *settings.focusDistance));
}

/// --sky-light.
void lightByBackground(Scene& scene, const Settings& settings, MemoryBudget& budget, Notices& notices) {
  budget.hold(sizeof(float) * scene.background.map.size() / 3,
              "--sky-light: the chances of the background's texels");
  if (!addSkyLight(scene))
    notices.warn("--sky-light: what surrounds the scene is black; --background 1 makes it white");
  else if (settings.ambient.value_or(1.0F) > 0.0F)
    notices.note("--ambient adds nothing: --sky-light takes its place");
}

}  // namespace

Scene loadScene(const SceneOptions& options, const CommandCosts& costs, Settings& settings,
                MemoryBudget& budget, Notices& notices, OpenFile* file) {
  nowDoing("reading the scene");
  const bool hasSize = given(options.width) == given(options.height);
  budget.promiseProgram(costs.programBytes);
  const auto holdPicture = [&] {
    if (options.crop) settings.crop = regionOf(*options.crop, settings.width, settings.height);
    promisePicture(budget, costs, settings);
  };
  if (hasSize) holdPicture();
  LoadOptions load;
  load.memory = &budget;
  load.laterTriangleBytes = costs.triangleBytes;
  load.laterTextureLevels = settings.textureFilter != TextureFilter::None;
  load.camera = settings.camera;
  load.viewpoint = chosenViewpoint(options.view);
  if (hasSize) load.aspect = aspectOf(settings);
  if (!options.scene.empty()) load.sceneName = options.scene;
  load.time = options.time;
  if (!options.animation.empty()) load.animation = options.animation;
  if (!options.variant.empty()) load.variant = options.variant;
  load.defaultLights = options.defaultLights;
  if ((settings.areaLights || settings.skyLight) && !load.defaultLights) load.defaultLights = false;
  load.confined = options.confined;
  load.log = options.log;
  load.defaultBackground = options.defaultBackground && options.background.empty();
  load.sky = settings.sky;
  if (!options.background.empty()) {
    if (settings.sky && !settings.sky->isNone)
      throw InputError("--background and --sky: give one of the two");
    load.sky = SkyChoice{true, {}};
  }
  Scene scene = file ? file->load(options.file, load, notices) : loadGltf(options.file, load, notices);
  if (settings.areaLights && !addSurfaceLight(scene))
    notices.warn("--area-lights: no surface of the scene glows");
  settleSize(options, scene, settings);
  if (!hasSize) holdPicture();
  if (!settings.clipFar && liesBeyondFarPlane(scene, cameraOf(scene, settings)))
    notices.note("something lies beyond the camera's zfar; --clip-far leaves it out");
  applyBackground(scene, options.background, settings, budget, notices);
  if (settings.skyLight) lightByBackground(scene, settings, budget, notices);
  settleAmbient(options, scene, settings, notices);
  settleFocus(options, scene, settings, notices);
  settleMirrorRoughness(options, settings);
  nowDoing("");
  for (const auto& text : notices.warnings) warn(text);
  if (!options.quiet)
    for (const auto& text : notices.notes) note(text);
  return scene;
}

}  // namespace whittle::cli
