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
  bool reloads = false;
  const char* remark = "";
};

constexpr std::array kRows{
    Row{"rays-per-pixel", "Picture", "rays per pixel", Kind::Whole},
    Row{"target-error", "Picture", "until the error is", Kind::Text},
    Row{"width", "Picture", "width", Kind::Whole},
    Row{"height", "Picture", "height", Kind::Whole},
    Row{"crop", "Picture", "region", Kind::Text},
    Row{"exposure", "Picture", "exposure, stops", Kind::Real},
    Row{"tone-map", "Picture", "tone map", Kind::Choice},
    Row{"sampler", "Picture", "sampler", Kind::Choice},
    Row{"seed", "Picture", "seed", Kind::Whole},
    Row{"shadows", "Light", "shadows", Kind::Switch},
    Row{"bounces", "Light", "bounces", Kind::Whole},
    Row{"transparent-bounces", "Light", "straight on", Kind::Whole},
    Row{"impulses", "Light", "impulses", Kind::Choice},
    Row{"cutoff", "Light", "cut-off", Kind::Real},
    Row{"ambient", "Light", "ambient", Kind::Real},
    Row{"mirror-roughness", "Light", "mirrors up to", Kind::Real},
    Row{"back-faces", "Light", "back faces", Kind::Choice},
    Row{"background-rotation", "Light", "background, °", Kind::Real, true},
    Row{"background-strength", "Light", "background ×", Kind::Real, true},
    Row{"search", "Device", "search", Kind::Choice},
    Row{"lanes", "Device", "lanes", Kind::Choice},
    Row{"wavefront", "Device", "wavefront, rays", Kind::Whole},
    Row{"work-group", "Device", "work-group", Kind::Whole},
    Row{"device", "Device", "device", Kind::Text},
    Row{"threads", "Device", "threads", Kind::Whole, false, "threads: of PoCL from the next start"},
};

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
    // CLI11 takes the words from the last to the first.
    options.app.parse(std::vector<std::string>{fmt::format("--{}={}", id, text)});
  }
  if (options.scene.crop)
    options.settings.crop = regionOf(*options.scene.crop, options.settings.width, options.settings.height);
  settings = options.settings;
}

std::vector<view::Control> settingControls(const Settings& standard) {
  Options options;
  std::vector<view::Control> controls;
  for (const Row& row : kRows) {
    view::Control c;
    c.id = row.id;
    c.group = row.group;
    c.label = row.label;
    c.kind = row.kind;
    c.reloads = row.reloads;
    c.remark = row.remark;
    const CLI::Option* const option = options.app.get_option(fmt::format("--{}", row.id));
    c.tip = fmt::format("--{} {}: {}", row.id, option->get_type_name(), option->get_description());
    c.standard = settingText(standard, row.id);
    std::string words = option->get_type_name();
    if (row.kind == Kind::Choice)
      for (std::size_t at = 0; at <= words.size();) {
        const std::size_t end = std::min(words.find('|', at), words.size());
        c.words.push_back(words.substr(at, end - at));
        at = end + 1;
      }
    controls.push_back(std::move(c));
  }
  return controls;
}

}  // namespace whittle::cli
