// Shared options; see the header.
#include "cli/options.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>

#include "scene/gltf_loader.h"
#include "scene/image_io.h"
#include "scene/input_error.h"

namespace whittle::cli {
namespace {

const std::map<std::string, Search> kSearches{{"auto", Search::Auto}, {"tree", Search::Tree}, {"array", Search::Array}};
const std::map<std::string, Sampler> kSamplers{
    {"random", Sampler::Random}, {"stratified", Sampler::Stratified}, {"sobol", Sampler::Sobol}};
const std::map<std::string, ImpulseMode> kImpulses{{"all", ImpulseMode::All}, {"one", ImpulseMode::One}};
const std::map<std::string, Lanes> kLanes{{"auto", Lanes::Auto}, {"1", Lanes::One}, {"8", Lanes::Eight}};

/// An option that takes one of a few words.
template <typename T>
void addChoice(CLI::App& command, const std::string& name, T& value, const std::map<std::string, T>& choices,
               const std::string& text, const std::string& fallback) {
  std::vector<std::string> words;
  for (const auto& [word, unused] : choices) words.push_back(word);
  auto* option = command.add_option_function<std::string>(
      name, [&value, &choices](const std::string& word) { value = choices.at(word); }, text);
  option->check(CLI::IsMember(words))->default_str(fallback)->type_name("");
}

bool parseRadiance(const std::string& text, glm::vec3& out) {
  std::istringstream in(text);
  char comma1 = 0, comma2 = 0;
  glm::vec3 v;
  if (!(in >> v.r)) return false;
  if (in.eof()) {
    out = glm::vec3(v.r);
    return true;
  }
  if (!(in >> comma1 >> v.g >> comma2 >> v.b) || comma1 != ',' || comma2 != ',' || !(in >> std::ws).eof()) return false;
  out = v;
  return true;
}

void applyBackground(Scene& scene, const std::string& text) {
  if (text.empty()) return;
  glm::vec3 radiance;
  if (parseRadiance(text, radiance)) {
    if (!(radiance.r >= 0.0F && radiance.g >= 0.0F && radiance.b >= 0.0F) || !std::isfinite(radiance.r + radiance.g + radiance.b))
      throw InputError("--background: radiance must be finite and not negative");
    scene.background = {};
    scene.background.radiance = radiance;
    return;
  }
  FloatImage image = readFloatImage(text);
  Background background{glm::vec3(1.0F), image.width, image.height, {}};
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t p = 0; p < image.pixels.size() / channels; ++p)
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = image.pixels[p * channels + (channels >= 3 ? c : 0)];
      background.map.push_back(value > 0.0F && std::isfinite(value) ? value : 0.0F);
    }
  scene.background = std::move(background);
}

}  // namespace

void addSceneOptions(CLI::App& command, SceneOptions& options) {
  command.add_option("SCENE", options.file, "glTF 2.0 file, .gltf or .glb")->required();
  command.add_option("--scene", options.scene, "scene of the file, by name or index")->type_name("NAME|INDEX");
  command.add_option("--background", options.background, "radiance seen by rays that leave the scene: R,G,B in W/(m² sr), or an equirectangular .hdr/.exr")
      ->type_name("R,G,B|FILE");
  command.add_flag("--quiet", options.quiet, "no progress, no notes; warnings and errors only");
}

void addPictureOptions(CLI::App& c, Settings& s) {
  c.add_option("--width", s.width, "picture width, pixels")->capture_default_str()->check(CLI::Range(1, 65535));
  c.add_option("--height", s.height, "picture height, pixels")->capture_default_str()->check(CLI::Range(1, 65535));
  c.add_option("--camera", s.camera, "camera by name or index")->capture_default_str()->type_name("NAME|INDEX");
  c.add_option("--exposure", s.exposure, "for .png and .jpg, stops")->capture_default_str()->check(CLI::Range(-60.0F, 60.0F));
  c.add_option("--bounces", s.bounces, "backward tracing steps; 1 = direct light only")->capture_default_str()->check(CLI::Range(1, 4096));
  c.add_option("--rays-per-pixel", s.raysPerPixel, "primary rays; 1 = through the pixel's centre")->capture_default_str()->check(CLI::Range(1, 1 << 24));
  c.add_flag("--shadows,!--no-shadows", s.shadows, "shadow rays (on)");
  addChoice(c, "--sampler", s.sampler, kSamplers, "random|stratified|sobol positions in the pixel", "random");
  c.add_option("--seed", s.seed, "of every random number")->capture_default_str();
  addChoice(c, "--impulses", s.impulses, kImpulses, "all|one: both branches of a surface, or one chosen at random", "all");
  c.add_option_function<float>("--bump", [&s](float v) { s.bump = v; }, "ray origin offset, metres (default: from each hit's rounding error)")
      ->check(CLI::NonNegativeNumber);
  c.add_option("--mirror-roughness", s.mirrorRoughness, "surfaces smoother than this reflect as mirrors")->capture_default_str()->check(CLI::Range(0.0F, 1.0F));
}

void addDeviceOptions(CLI::App& c, Settings& s) {
  addChoice(c, "--search", s.search, kSearches, "auto|tree|array: how the nearest triangle is found", "auto");
  c.add_option("--device", s.device, "index from `whittle devices`, part of a name, or cpu|gpu")->type_name("SELECTOR");
  c.add_option("--threads", s.threads, "threads of a CPU device; 0: all")->capture_default_str()->check(CLI::Range(0, 4096));
  c.add_option("--wavefront", s.wavefront, "rays in flight, at least 512")->capture_default_str()->check(CLI::Range(1, 1 << 28));
  c.add_option("--work-group", s.workGroup, "work items in a group; 0: chosen for the device")->capture_default_str()->check(CLI::Range(0, 65536));
  addChoice(c, "--lanes", s.lanes, kLanes, "auto|1|8: rays for each work item of the searches", "auto");
  c.add_flag("--keep-all-features", s.keepAllFeatures, "compile and run everything, needed or not");
}

Scene loadScene(const SceneOptions& options, Notices& notices) {
  LoadOptions load;
  if (!options.scene.empty()) load.sceneName = options.scene;
  Scene scene = loadGltf(options.file, load, notices);
  applyBackground(scene, options.background);
  for (const auto& text : notices.warnings) fmt::print(stderr, "warning: {}\n", text);
  if (!options.quiet)
    for (const auto& text : notices.notes) fmt::print(stderr, "note: {}\n", text);
  return scene;
}

Scene loadScene(const SceneOptions& options) {
  Notices notices;
  return loadScene(options, notices);
}

std::string formatCount(double count) {
  if (count >= 1e9) return fmt::format("{:.2f} G", count * 1e-9);
  if (count >= 1e6) return fmt::format("{:.2f} M", count * 1e-6);
  if (count >= 1e4) return fmt::format("{:.1f} k", count * 1e-3);
  return fmt::format("{:.0f}", count);
}

std::string formatSeconds(double seconds) {
  if (seconds < 60.0) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long>(seconds);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

}  // namespace whittle::cli
