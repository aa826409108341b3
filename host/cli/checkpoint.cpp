// See checkpoint.h.
#include "cli/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string_view>
#include <utility>

#include "cli/guard.h"
#include "cli/option_kinds.h"
#include "cli/speech.h"
#include "report/json_float.h"
#include "report/stats.h"
#include "report/text.h"
#include "scene/camera.h"
#include "scene/hash.h"
#include "scene/whole_file.h"

namespace whittle::cli {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr double kLeastEvery = 0.01, kMostEvery = 1e6;  // seconds
constexpr const char* kResume = "--resume";

/// Settings that change no sample: what is shown of the picture, where and how fast it is made, and when it
/// ends. raysPerPixel is looked at by itself.
constexpr std::array<std::string_view, 18> kFreeSettings{
    "exposure",  "toneMap",         "bloom",        "dither",      "raysPerPixel",        "search",
    "device",    "threads",         "lanes",        "wavefront",   "workGroup",           "bump",
    "timeLimit", "keepAllFeatures", "keepFeatures", "targetError", "targetErrorRelative", "focusDistance"};

/// Of a file's bytes; empty: it cannot be read.
std::string fingerprintOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::error_code error;
  const std::uint64_t size = fs::file_size(file, error);
  if (!in || error) return "";
  // Piece by piece: the file may be larger than what is free.
  constexpr std::uint64_t kPiece = std::uint64_t{1} << 24;
  std::vector<std::byte> piece(std::min(size, kPiece));
  std::uint64_t all = size;
  while (in.read(reinterpret_cast<char*>(piece.data()), static_cast<std::streamsize>(piece.size())),
         in.gcount() > 0) {
    const std::array<std::uint64_t, 2> sums{
        all, hashOf(std::span(piece).first(static_cast<std::size_t>(in.gcount())))};
    all = hashOf(std::as_bytes(std::span(sums)));
  }
  return fmt::format("{:016x}", all);
}

Json cameraToJson(const Camera& c) {
  const auto vector = [](const glm::vec3& v) { return Json{jsonFloat(v.x), jsonFloat(v.y), jsonFloat(v.z)}; };
  return {{"orthographic", c.orthographic}, {"position", vector(c.position)},
          {"right", vector(c.right)},       {"up", vector(c.up)},
          {"forward", vector(c.forward)},   {"yfov", jsonFloat(c.yfov)},
          {"ymag", jsonFloat(c.ymag)},      {"znear", jsonFloat(c.znear)}};
}

/// mirrorRoughness: --mirror-roughness.
std::string optionOf(const std::string& setting) {
  std::string option = "--";
  for (const char c : setting) {
    if (std::isupper(static_cast<unsigned char>(c)) != 0) option += '-';
    option += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return option;
}

std::string valueText(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// A pixel's only ray goes through its middle, and strata are as many as rays.
std::string raysDifference(const Json& began, const Json& now) {
  const auto before = began.at("raysPerPixel").get<int>(), after = now.at("raysPerPixel").get<int>();
  if (before == after) return "";
  if (before == 1 || after == 1)
    return "one ray for each pixel goes through its middle, several do not: they cannot be added up";
  if (now.at("sampler") == "stratified")
    return fmt::format(
        "--sampler stratified has divided the pixels for {} rays each; random and sobol take more", before);
  return "";
}

std::string fileDifference(const Json& began, const Json& now) {
  for (const auto& [name, fingerprint] : now.items()) {
    if (!began.contains(name)) return fmt::format("{} is another file", name);
    if (began.at(name) != fingerprint) return fmt::format("{} has changed since", name);
  }
  for (const auto& [name, fingerprint] : began.items())
    if (!now.contains(name)) return fmt::format("{} was read for it", name);
  return "";
}

/// The words of a command without --resume and its value.
std::vector<std::string> withoutResume(const std::vector<std::string>& arguments) {
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == kResume)
      ++i;
    else if (!arguments[i].starts_with(std::string(kResume) + "="))
      kept.push_back(arguments[i]);
  }
  return kept;
}

}  // namespace

void addCheckpointOptions(CLI::App& c, CheckpointOptions& o) {
  c.option_defaults()->group("Long renders");
  CLI::Option* const file = addFile(
      c, "--checkpoint", o.file, "FILE",
      "keep in this file what a later render needs to go on; Ctrl-C, SIGTERM and SIGHUP then end the "
      "render with the picture so far, and whatever else ends it loses what came after the last time");
  addReal(c, "--every", o.every, kLeastEvery, kMostEvery, "SECONDS", "write --checkpoint so often", "60")
      ->needs(file);
  c.add_flag("--partial,!--no-partial", o.partial,
             "what was asked for as output is written when a render is interrupted, too [on]")
      ->needs(file);
  CLI::Option* const scene = c.get_option("SCENE");
  addText(c, kResume,
          [&o, scene](const std::string& word) {
            if (word.empty()) throw InputError("--resume: the name is empty; it is a file of --checkpoint");
            o.resume = word;
            scene->required(false);
          },
          {"FILE",
           "go on with the picture that --checkpoint wrote there, to the bits of a render that was never "
           "interrupted; without SCENE with the options that it began with, and those that follow. A larger "
           "--rays-per-pixel adds to a finished picture (not to one ray, nor to strata)",
           ""});
}

std::vector<std::string> resumedArguments(const CheckpointOptions& o, const SceneOptions& scene) {
  if (o.resume.empty() || !scene.file.empty()) return {};
  const Checkpoint began = readCheckpoint(o.resume);
  std::error_code error;
  if (fs::current_path(error) != fs::path(began.folder))
    throw InputError(fmt::format("--resume: {} began in {}; go there, or name SCENE and its options again",
                                 o.resume.string(), began.folder));
  std::vector<std::string> arguments = withoutResume(began.arguments);
  arguments.insert(arguments.end(), o.arguments.begin() + 1, o.arguments.end());
  return arguments;
}

Json identityOf(const SceneOptions& o, const Scene& scene, const Settings& settings,
                const std::vector<fs::path>& files) {
  Json identity{{"program", WHITTLE_VERSION}};
  identity["settings"] = settingsToJson(settings);
  if (settings.aperture > 0.0F) identity["focus"] = identity["settings"]["focusDistance"];
  identity["camera"] = cameraToJson(scene.cameras[findCamera(scene, settings.camera)]);
  identity["scene"] = o.scene;
  identity["animation"] = o.animation;
  identity["variant"] = o.variant;
  identity["time"] = o.time ? Json(*o.time) : Json();
  identity["background"] = o.background;
  identity["default background"] = o.defaultBackground;
  identity["lights"] = scene.lights.size();
  identity["auxiliary outputs"] = settings.aovs;
  Json& read = identity["files"] = Json::object();
  read[o.file.filename().string()] = fingerprintOf(o.file);
  for (const fs::path& file : files) read[file.filename().string()] = fingerprintOf(file);
  return identity;
}

std::string differenceOf(const Json& began, const Json& now) {
  // The cause of other differences, as a rule.
  if (std::string text = fileDifference(began.at("files"), now.at("files")); !text.empty()) return text;
  for (const auto& [key, value] : now.items()) {
    const Json before = began.contains(key) ? began.at(key) : Json();
    if (key == "settings" || key == "files" || before == value) continue;
    if (key == "camera") return "the camera stands or looks elsewhere";
    return fmt::format("{} was {} and is {}", key, valueText(before), valueText(value));
  }
  for (const auto& [key, value] : now.at("settings").items()) {
    if (std::find(kFreeSettings.begin(), kFreeSettings.end(), key) != kFreeSettings.end()) continue;
    const Json before = began.at("settings").contains(key) ? began.at("settings").at(key) : Json();
    if (before != value)
      return fmt::format("{} was {} and is {}", optionOf(key), valueText(before), valueText(value));
  }
  return raysDifference(began.at("settings"), now.at("settings"));
}

Checkpointing::Checkpointing(const CheckpointOptions& options, Json identity) : options_(options) {
  if (!options.resume.empty()) {
    checkpoint_ = readCheckpoint(options.resume);
    isResumed_ = true;
    std::string difference;
    try {
      difference = differenceOf(checkpoint_.identity, identity);
    } catch (const Json::exception& e) {
      difference = e.what();
    }
    if (!difference.empty())
      throw InputError(
          fmt::format("--resume: {} is of another picture: {}", options.resume.string(), difference));
  }
  checkpoint_.identity = std::move(identity);
  checkpoint_.arguments = withoutResume(options.arguments);
  std::error_code error;
  checkpoint_.folder = fs::current_path(error).string();
}

void Checkpointing::hookInto(RenderHooks& hooks) {
  if (isResumed_) hooks.resumed = &checkpoint_.state;
  if (options_.file.empty()) return;
  hooks.checkpointSeconds = options_.every;
  hooks.checkpoint = [this](RenderState state) {
    checkpoint_.state = std::move(state);
    try {
      writeCheckpoint(options_.file, checkpoint_);
      haveWritten(options_.file.string());
      hasFailed_ = false;
    } catch (const UnwritableFile& e) {
      if (!std::exchange(hasFailed_, true))
        warn(fmt::format("--checkpoint: {}; the last one stays", e.what()));
    }
  };
  hooks.keepGoing = [goesOn = hooks.keepGoing] { return !endIsWanted() && (!goesOn || goesOn()); };
  hooks.phase = [said = hooks.phase](const std::string& phase) {
    if (said) said(phase);
    if (phase == kLastPhase) answerSignals();
  };
}

bool Checkpointing::wasInterrupted() const { return !options_.file.empty() && endIsWanted(); }

void Checkpointing::sayHowToGoOn(const Stats& stats) const {
  if (!wasInterrupted()) return;
  note(fmt::format("interrupted with {} rays for each pixel{}; to go on: whittle render --resume {}",
                   formatReal(stats.samples.mean),
                   stats.samples.least == 0 ? ", and none yet for some, which are black" : "",
                   options_.file.string()));
}

}  // namespace whittle::cli
