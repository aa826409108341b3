// whittle view: a scene in a window, with every setting and statistic of a render.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <mutex>
#include <sstream>
#include <thread>
#include <utility>

#include "cl/device.h"
#include "cl/kernel_cache.h"
#include "cli/commands.h"
#include "cli/error_options.h"
#include "cli/option_kinds.h"
#include "cli/options.h"
#include "cli/outputs.h"
#include "cli/setting_controls.h"
#include "cli/speech.h"
#include "gltf/edited_copy.h"
#include "image/image_io.h"
#include "render/peak_memory.h"
#include "scene/own_library.h"
#include "view/viewer.h"
#include "view/window/window_library.h"

namespace whittle::cli {
namespace {

namespace fs = std::filesystem;

/// Rays for each pixel where nobody says: a window has time.
constexpr int kRaysPerPixel = 64;

struct ViewOptions {
  SceneOptions scene;
  Settings settings;
  fs::path script, kernelFolder, reference;
  bool isLight = false;
  std::optional<float> uiScale;
};

view::Script readScript(const fs::path& file) {
  std::error_code error;
  std::ifstream in(file);
  std::ostringstream text;
  if (fs::is_directory(file, error) || !in || !(text << in.rdbuf()))
    throw InputError(fmt::format("--script: {} cannot be read", file.string()));
  return view::Script(text.str());
}

const view::WindowLibrary& loadWindow() {
  std::string problem = "this build has none: install libimgui-dev and libglfw3-dev, and build again";
  using Entry = decltype(&whittleWindowLibrary);
  if (const auto entry =
          reinterpret_cast<Entry>(loadOwnLibrary("libwhittle_window.so", "whittleWindowLibrary", problem)))
    return *entry();
  throw std::runtime_error(fmt::format("no window: libwhittle_window.so: {}", problem));
}

/// What is read, shared by the window's thread and the render's.
class Sources {
 public:
  explicit Sources(const SceneOptions& options) : options_(options) {}

  /// `file`: a scene, an environment, or empty: all as before.
  Scene load(const fs::path& file, Settings& settings, std::vector<std::string>& notes) {
    SceneOptions options = wantedOptions();  // the window asks about pictures while a scene is read
    if (isEnvironment(file))
      options.background = file.string();
    else if (!file.empty())
      options.file = file;
    options.quiet = true;  // the window shows them
    Notices notices;
    MemoryBudget budget = budgetOf(options);
    Scene scene = loadScene(options, kCosts, settings, budget, notices);
    options.crop.reset();  // from now on the window's
    const std::lock_guard lock(mutex_);
    options.quiet = options_.quiet;
    options_ = options;  // what could not be read is not asked for again
    allowedPicture_ = pictureBytes(settings);
    notes = notices.warnings;
    notes.insert(notes.end(), notices.notes.begin(), notices.notes.end());
    return scene;
  }

  /// Of sceneControls, for the next time that a scene is read. Throws InputError.
  void set(const std::string& id, const std::string& text) {
    const std::lock_guard lock(mutex_);
    SceneOptions wanted = wanted_.value_or(options_);
    setSceneOption(wanted, id, text);
    wanted_ = wanted;
  }
  std::string value(const std::string& id) const {
    const std::lock_guard lock(mutex_);
    return sceneText(wanted_.value_or(options_), id);
  }
  std::string optionsText() const {
    const std::lock_guard lock(mutex_);
    return sceneOptionsText(options_);
  }

  /// Throws InputError, as loading does, where a picture larger than those so far is more than memory allows.
  void checkPicture(const Settings& settings) {
    const std::lock_guard lock(mutex_);
    if (pictureBytes(settings) <= allowedPicture_) return;
    MemoryBudget budget = budgetOf(options_);
    budget.promiseProgram(kCosts.programBytes);
    promisePicture(budget, kCosts, settings);
    allowedPicture_ = pictureBytes(settings);
  }

  /// Says what was written.
  std::string save(const fs::path& copy, const Scene& scene, const Appearance& before, Appearance after) {
    bool ofSky = false;  // its sun comes with it whenever the copy is read
    for (std::size_t i = 0; scene.sky && i < before.lights.size(); ++i)
      if (before.lights[i].node < 0 && differs(before.lights[i], after.lights[i]))
        ofSky = true, after.lights[i] = before.lights[i];
    EditedScene edited{scene.file, {}, scene.origin, before, after};
    {
      const std::lock_guard lock(mutex_);
      if (!options_.scene.empty()) edited.sceneName = options_.scene;
    }
    const fs::path written = writeEditedCopy(edited, copy);
    bool ofStudio = false;  // one of its lights is of the file now
    for (std::size_t i = 0; scene.hasStudioLights && i < before.lights.size(); ++i)
      ofStudio |= differs(before.lights[i], after.lights[i]);
    return fmt::format("wrote {}{}", written.string(),
                       ofStudio ? ", without the studio's surroundings: glTF has none"
                       : ofSky  ? ", with the sun as the sky makes it"
                                : "");
  }

 private:
  static constexpr CommandCosts kCosts{kTriangleBytes, kRuntimeBytes + kCodecBytes, pictureBytes};

  SceneOptions wantedOptions() {
    const std::lock_guard lock(mutex_);
    return std::exchange(wanted_, std::nullopt).value_or(options_);
  }
  static bool isEnvironment(const fs::path& file) {
    return file.extension() == ".hdr" || file.extension() == ".exr";
  }
  mutable std::mutex mutex_;
  SceneOptions options_;                ///< of the scene that was read last
  std::optional<SceneOptions> wanted_;  ///< of the next one, where they differ
  std::uint64_t allowedPicture_ = 0;    ///< bytes
};

std::vector<std::uint8_t> codesOf(const FloatImage& radiance, const Scene& scene, const Settings& settings) {
  const Look look = lookOf(radiance, scene, settings, {"a.png"}, true);
  const std::vector<std::uint8_t> rgb = pictureCodes(radiance, {}, look);
  std::vector<std::uint8_t> rgba(rgb.size() / 3 * 4, 255);
  for (std::size_t i = 0; i < rgb.size() / 3; ++i)
    for (std::size_t c = 0; c < 3; ++c) rgba[4 * i + c] = rgb[3 * i + c];
  return rgba;
}

view::Reference referenceOf(const fs::path& file) {
  view::Reference reference{readFloatImage(file), !isToneMapped(file), file.filename().string()};
  if (reference.light.channels < 3) throw InputError(fmt::format("{}: it has no colours", file.string()));
  return reference;
}

/// Options of a camera, as `info` and the window print them.
Camera cameraWritten(const Scene& scene, double aspect, const std::string& text) {
  CLI::App app;
  ViewpointOptions options;
  addViewpointOptions(app, options, nullptr);
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.insert(words.begin(), word);  // CLI11 takes the last first
  try {
    app.parse(words);
  } catch (const CLI::ParseError&) {
    throw InputError(fmt::format("'{}' are no options of a camera", text.substr(0, 60)));
  }
  const auto viewpoint = chosenViewpoint(options);
  if (!viewpoint) throw InputError("what was pasted is no camera: --eye X,Y,Z --look-at X,Y,Z");
  return cameraAt(scene, *viewpoint, aspect);
}

/// Those of the scene before those of the device, which are seldom changed.
std::vector<view::Control> windowControls(const Settings& standard) {
  std::vector<view::Control> controls = settingControls(standard, listDevices());
  const auto device = std::find_if(controls.begin(), controls.end(),
                                   [](const view::Control& c) { return c.group == "Device"; });
  const auto ofScene = sceneControls();
  controls.insert(device, ofScene.begin(), ofScene.end());
  return controls;
}

/// Under the first free number.
std::string savePictures(const fs::path& stem, const RenderResult& result, const Scene& scene,
                         const Settings& settings) {
  fs::path png, exr;
  for (int i = 1;; ++i) {
    png = fmt::format("{}-{:03}.png", stem.string(), i);
    exr = fs::path(png).replace_extension(".exr");
    std::error_code error;
    if (!fs::exists(png, error) && !fs::exists(exr, error)) break;
  }
  const Look look = lookOf(result.radiance, scene, settings, {png}, true);
  const ImageMetadata metadata{{"whittle:settings", settingsToJson(result.stats.settings).dump()}};
  for (const auto& file : {png, exr}) writePicture(file, result.radiance, result.alpha, look, metadata);
  return fmt::format("wrote {} and {}", png.string(), exr.string());
}

int runView(ViewOptions& o) {
  const view::WindowLibrary& library = loadWindow();
  std::optional<view::Script> script;
  if (!o.script.empty()) script = readScript(o.script);
  warnIfAny(settleKernelCache());
  // As many as there are: the setting takes a part of them.
  prepareCpuThreads(std::max(o.settings.threads, static_cast<int>(std::thread::hardware_concurrency())),
                    o.settings.workGroup);
  loadImageCodec();

  auto sources = std::make_shared<Sources>(o.scene);
  view::Services services;
  Settings standard;
  standard.raysPerPixel = kRaysPerPixel;
  services.controls = windowControls(standard);
  services.standard = [standard](const Settings& settings, const std::string& id) {
    return isSceneControl(id) ? "auto" : standardText(standard, settings, id);
  };
  services.value = [sources](const Settings& settings, const std::string& id) {
    return isSceneControl(id) ? sources->value(id) : settingText(settings, id);
  };
  services.set = [sources](Settings& settings, const std::string& id, const std::string& text) {
    if (isSceneControl(id)) return sources->set(id, text);
    setSetting(settings, id, text);
    if (id == "target-error" || id == "time-limit") followTarget(settings, kRaysPerPixel);
  };
  services.load = [sources](const fs::path& file, Settings& settings, std::vector<std::string>& notes) {
    return sources->load(file, settings, notes);
  };
  services.checkPicture = [sources](const Settings& settings) { sources->checkPicture(settings); };
  services.codes = codesOf;
  services.stops = [](const FloatImage& radiance, const Scene& scene, const Settings& settings) {
    return lookOf(radiance, scene, settings, {"a.png"}, true).stops;
  };
  services.readReference = referenceOf;
  services.cameraText = viewpointText;
  services.camera = cameraWritten;
  services.save = savePictures;
  // A script leaves nothing behind but what it is told to write.
  services.recent = view::RecentFiles(script ? fs::path() : view::recentFilesStore());
  services.optionsText = [sources](const Settings& settings) {
    return optionsText(settings) + sources->optionsText();
  };
  services.saveScene = [sources](const fs::path& copy, const Scene& scene, const Appearance& before,
                                 const Appearance& after) {
    return sources->save(copy, scene, before, after);
  };
  services.wake = [&library] { library.wake(); };
  services.compiler = "/proc/self/exe";
  if (!o.kernelFolder.empty()) services.kernelFolder = o.kernelFolder;
  settleMirrorRoughness(o.scene, o.settings);
  view::Viewer viewer(std::move(services), o.settings, o.scene.file);

  if (!o.reference.empty()) viewer.set("reference", o.reference.string());

  view::WindowOptions window;
  window.title =
      o.scene.file.empty() ? "Whittle" : fmt::format("{} – Whittle", o.scene.file.filename().string());
  window.isLight = o.isLight;
  window.uiScale = o.uiScale;
  window.print = [](const std::string& line) {
    tell(line + "\n");
    finishOutput();  // whoever drives the script may wait for it
  };
  window.writeCodes = [](const fs::path& file, int width, int height,
                         const std::vector<std::uint8_t>& codes) {
    writeCodes(file, {width, height, 4, codes}, {});
  };
  window.fonts = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
                  "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"};
  if (script) window.script = [&](view::Stage& stage) { return script->step(stage); };
  library.run(viewer, window);
  return 0;
}

}  // namespace

void addView(CLI::App& app, int& status) {
  auto o = std::make_shared<ViewOptions>();
  o->settings.raysPerPixel = kRaysPerPixel;
  CLI::App* c = app.add_subcommand("view", "look at a scene in a window, with every setting and statistic");
  addSceneOptions(*c, o->scene);
  c->get_option("SCENE")->required(false);
  addPictureOptions(*c, o->settings, o->scene);
  addErrorOptions(*c, o->settings);
  addDeviceOptions(*c, o->settings);
  c->option_defaults()->group("Window");
  c->add_flag("--light", o->isLight, "dark letters on a light ground [off]");
  addText(*c, "--ui-scale",
          [&scale = o->uiScale](const std::string& word) {
            scale = parseRealOrAuto("--ui-scale", word, view::kLeastUiScale, view::kLargestUiScale);
          },
          {"auto|S",
           "size of letters and panels, 0.5 to 4: 2 is twice as large; in the window Ctrl and +, - or 0",
           "auto: as the monitor is set, else larger from 1200 rows on"});
  addFile(*c, "--script", o->script, "FILE",
          "keys, mouse, settings, screenshots and expectations, a command a line: host/view/README.md");
  addFile(*c, "--compare", o->reference, "FILE",
          "show a reference of the picture's size beside it, split by a line: an .exr or .hdr (radiance), or "
          "a .png or .jpg (codes)");
  addFile(*c, "--kernels", o->kernelFolder, "FOLDER",
          "read kernels from here, not from the program (for developers)");
  c->footer("Example: whittle view scenes/cornell_box.glb\nH in the window shows its keys.");
  c->callback([o, c, &status] {
    settleRaysPerPixel(*c, o->settings);
    status = runView(*o);
  });
}

}  // namespace whittle::cli
