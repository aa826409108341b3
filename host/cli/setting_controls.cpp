// See setting_controls.h.
#include "cli/setting_controls.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cli/error_options.h"
#include "cli/options.h"
#include "report/stats.h"
#include "scene/input_error.h"

namespace whittle::cli {
namespace {

using Kind = view::Control::Kind;

struct Row {
  const char *id, *group, *label;
  Kind kind;
  const char* remark = "";
};

constexpr std::array kRows{
    Row{"rays-per-pixel", "Picture", "rays per pixel", Kind::Whole},
    Row{"target-error", "Picture", "until the error is", Kind::Text},
    Row{"time-limit", "Picture", "for at most, s", Kind::Real},
    Row{"adaptive", "Picture", "adaptive", Kind::Switch},
    Row{"width", "Picture", "width", Kind::Whole},
    Row{"height", "Picture", "height", Kind::Whole},
    Row{"crop", "Picture", "region", Kind::Text},
    Row{"exposure", "Picture", "exposure, stops", Kind::Real},
    Row{"tone-map", "Picture", "tone map", Kind::Choice},
    Row{"bloom", "Picture", "bloom", Kind::Text},
    Row{"dither", "Picture", "dither", Kind::Switch},
    Row{"aperture", "Picture", "aperture, m", Kind::Real},
    Row{"focus-distance", "Picture", "focus, m", Kind::Text},
    Row{"texture-filter", "Picture", "texture filter", Kind::Choice},
    Row{"sampler", "Picture", "sampler", Kind::Choice},
    Row{"seed", "Picture", "seed", Kind::Whole},
    Row{"shadows", "Light", "shadows", Kind::Switch},
    Row{"area-lights", "Light", "area lights", Kind::Switch},
    Row{"sky-light", "Light", "sky light", Kind::Switch},
    Row{"smooth-terminator", "Light", "terminator", Kind::Switch},
    Row{"glossy", "Light", "glossy", Kind::Switch},
    Row{"light-radius", "Light", "lamps, radius m", Kind::Real},
    Row{"sun-angle", "Light", "sun, °", Kind::Real},
    Row{"bounces", "Light", "bounces", Kind::Whole},
    Row{"transparent-bounces", "Light", "straight on", Kind::Whole},
    Row{"impulses", "Light", "impulses", Kind::Choice},
    Row{"cutoff", "Light", "cut-off", Kind::Real},
    Row{"ambient", "Light", "ambient", Kind::Real},
    Row{"mirror-roughness", "Light", "mirrors up to", Kind::Real},
    Row{"back-faces", "Light", "back faces", Kind::Choice},
    Row{"sky", "Light", "sky", Kind::Text},
    Row{"background-rotation", "Light", "background, °", Kind::Real},
    Row{"background-strength", "Light", "background ×", Kind::Real},
    Row{"search", "Device", "search", Kind::Choice},
    Row{"lanes", "Device", "lanes", Kind::Choice},
    Row{"wavefront", "Device", "wavefront, rays", Kind::Whole},
    Row{"work-group", "Device", "work-group", Kind::Whole},
    Row{"device", "Device", "device", Kind::Choice},
    Row{"threads", "Device", "threads", Kind::Whole, "more than cores: from the next start"},
};

struct SceneRow {
  const char *id, *label;
};
constexpr std::array kSceneRows{SceneRow{"time", "time, s"}, SceneRow{"animation", "animation"},
                                SceneRow{"background", "background"}};
constexpr const char* kNotGiven = "auto";

/// The command line with nothing but these options, bound to settings of its own.
struct Options {
  Settings settings;
  SceneOptions scene;
  CLI::App app;

  Options() {
    addPictureOptions(app, settings, scene);
    addErrorOptions(app, settings);
    addDeviceOptions(app, settings);
  }
};

/// rays-per-pixel → raysPerPixel
std::string keyOf(const std::string& id) {
  std::string key;
  for (std::size_t i = 0; i < id.size(); ++i)
    key += id[i] == '-' ? static_cast<char>(std::toupper(static_cast<unsigned char>(id[++i]))) : id[i];
  return key;
}

/// random|stratified|sobol
std::vector<std::string> wordsOf(const std::string& typeName) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= typeName.size();) {
    const std::size_t end = std::min(typeName.find('|', at), typeName.size());
    words.push_back(typeName.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

/// With a blank before it.
std::string optionText(const std::string& id, const std::string& value) {
  const char* const quote = value.find(' ') != std::string::npos ? "'" : "";
  return fmt::format(" --{} {}{}{}", id, quote, value, quote);
}

/// By number: names may be alike.
void offerDevices(const DeviceList& devices, view::Control& c) {
  c.words = {""};
  c.captions = {"the first"};
  for (const DeviceInfo& d : devices.devices) {
    if (!d.usable) continue;
    c.words.push_back(std::to_string(d.index));
    c.captions.push_back(fmt::format("{}  {}, {}", d.index, d.name, d.platform));
  }
}

}  // namespace

std::string settingText(const Settings& settings, const std::string& id) {
  if (id == "target-error") {
    if (settings.targetErrorRelative > 0.0) return fmt::format("{:g}%", settings.targetErrorRelative * 100.0);
    return fmt::format("{:g}", settings.targetError);
  }
  const auto json = settingsToJson(settings);
  const auto found = json.find(keyOf(id));
  if (found == json.end()) throw std::invalid_argument(fmt::format("'{}' is no setting", id));
  if (found->is_boolean()) return found->get<bool>() ? "on" : "off";
  if (found->is_null()) return id == "crop" ? "none" : "auto";
  if (found->is_string()) return found->get<std::string>();
  if (found->is_number_float()) return fmt::format("{:.7g}", found->get<double>());
  return found->dump();
}

void setSetting(Settings& settings, const std::string& id, const std::string& text) {
  const auto row = std::find_if(kRows.begin(), kRows.end(), [&](const Row& r) { return r.id == id; });
  if (row == kRows.end()) throw InputError(fmt::format("'{}' is no setting of the window", id));
  Options options;
  options.settings = settings;
  if (row->kind == Kind::Switch) {
    if (text != "on" && text != "off")
      throw InputError(fmt::format("--{}: '{}' is not one of on|off", id, text));
    options.app.parse(std::vector<std::string>{(text == "on" ? "--" : "--no-") + id});
  } else {
    // CLI11 takes the words from the last to the first, and nothing behind "=" for nothing at all.
    options.app.parse(text.empty() ? std::vector<std::string>{text, fmt::format("--{}", id)}
                                   : std::vector<std::string>{fmt::format("--{}={}", id, text)});
  }
  if (options.scene.crop)
    options.settings.crop = regionOf(*options.scene.crop, options.settings.width, options.settings.height);
  // A default follows what decides it; a value by hand stays.
  if (id == "glossy" && settings.mirrorRoughness == standardMirrorRoughness(settings))
    options.settings.mirrorRoughness = standardMirrorRoughness(options.settings);
  settings = options.settings;
}

std::string standardText(const Settings& standard, const Settings& settings, const std::string& id) {
  Settings now = standard;
  if (id == "mirror-roughness") now.mirrorRoughness = standardMirrorRoughness(settings);
  return settingText(now, id);
}

std::string optionsText(const Settings& settings) {
  std::string text;
  for (const Row& row : kRows) {
    const std::string value = settingText(settings, row.id);
    if (value == standardText({}, settings, row.id)) continue;
    if (row.kind == Kind::Switch)
      text += fmt::format(" --{}{}", value == "on" ? "" : "no-", row.id);
    else
      text += optionText(row.id, value);
  }
  return text.empty() ? text : text.substr(1);
}

namespace {

/// A command line of options for the scene.
struct SceneCommand {
  SceneOptions options;
  CLI::App app;

  SceneCommand() {
    addSceneOptions(app, options);
    app.get_option("SCENE")->required(false);
  }
};

}  // namespace

std::vector<view::Control> sceneControls() {
  const SceneCommand command;
  std::vector<view::Control> controls;
  for (const SceneRow& row : kSceneRows) {
    view::Control c;
    c.id = row.id;
    c.group = "Scene";
    c.label = row.label;
    c.words = {kNotGiven};
    c.standard = kNotGiven;
    const CLI::Option* const option = command.app.get_option(fmt::format("--{}", row.id));
    c.tip = fmt::format("--{} {}: {}", row.id, option->get_type_name(), option->get_description());
    controls.push_back(std::move(c));
  }
  return controls;
}

bool isSceneControl(const std::string& id) {
  return std::any_of(kSceneRows.begin(), kSceneRows.end(), [&](const SceneRow& r) { return r.id == id; });
}

std::string sceneText(const SceneOptions& options, const std::string& id) {
  if (id == "time") return options.time ? fmt::format("{:.7g}", *options.time) : kNotGiven;
  const std::string& text = id == "animation" ? options.animation : options.background;
  return text.empty() ? kNotGiven : text;
}

void setSceneOption(SceneOptions& options, const std::string& id, const std::string& text) {
  SceneCommand command;
  if (text != kNotGiven && !text.empty())
    command.app.parse(std::vector<std::string>{fmt::format("--{}={}", id, text)});
  if (id == "time") options.time = command.options.time;
  if (id == "animation") options.animation = command.options.animation;
  if (id == "background") options.background = command.options.background;
}

std::string sceneOptionsText(const SceneOptions& options) {
  std::string text;
  for (const SceneRow& row : kSceneRows)
    if (const std::string value = sceneText(options, row.id); value != kNotGiven)
      text += optionText(row.id, value);
  return text;
}

std::vector<view::Control> settingControls(const Settings& standard, const DeviceList& devices) {
  Options options;
  std::vector<view::Control> controls;
  for (const Row& row : kRows) {
    view::Control c;
    c.id = row.id;
    c.group = row.group;
    c.label = row.label;
    c.kind = row.kind;
    c.remark = row.remark;
    const CLI::Option* const option = options.app.get_option(fmt::format("--{}", row.id));
    c.tip = fmt::format("--{} {}: {}", row.id, option->get_type_name(), option->get_description());
    c.standard = settingText(standard, row.id);
    if (c.id == "device")
      offerDevices(devices, c);
    else if (row.kind == Kind::Choice)
      c.words = wordsOf(option->get_type_name());
    controls.push_back(std::move(c));
  }
  return controls;
}

}  // namespace whittle::cli
