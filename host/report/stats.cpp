// Statistics as JSON; the names are a contract with scripts.
#include "report/stats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "analysis/feature.h"
#include "report/json_float.h"

namespace whittle {

namespace {

using Json = nlohmann::ordered_json;

template <typename T>
Json settingToJson(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    const auto& words = wordsOf(value);
    return std::find_if(std::begin(words), std::end(words), [&](const auto& w) { return w.value == value; })
        ->word;
  } else {
    return value;
  }
}
Json settingToJson(float value) { return jsonFloat(value); }
Json settingToJson(const std::optional<float>& value) { return value ? Json(jsonFloat(*value)) : Json(); }
Json settingToJson(const std::optional<Region>& r) {
  return r ? Json(fmt::format("{},{},{},{}", r->x, r->y, r->width, r->height)) : Json();
}
Json settingToJson(const Bloom& b) {
  return Json(b.strength > 0.0F ? fmt::format("{:g},{:g}", b.strength, b.radius) : "0");
}
Json settingToJson(const std::optional<SkyChoice>& c) {
  if (!c) return Json();
  return c->isNone
             ? Json("none")
             : Json(fmt::format("{:.9g},{:.9g},{:.9g}", c->sky.elevation, c->sky.azimuth, c->sky.turbidity));
}
/// Bits of features, by name.
Json settingToJson(std::uint64_t features) {
  Json names = Json::array();
  for (const Feature f : allFeatures())
    if (features & bitOf(f)) names.push_back(featureText(f));
  return names;
}

}  // namespace

double errorTarget(const Settings& s, const ErrorPoint& point) {
  return s.targetErrorRelative > 0.0 ? s.targetErrorRelative * point.mean : s.targetError;
}

bool meetsTarget(const Settings& s, const ErrorPoint& point) {
  return hasErrorTarget(s) && point.raysPerPixel >= 2 && std::isfinite(point.estimate) &&
         point.estimate <= errorTarget(s, point);
}

nlohmann::ordered_json settingsToJson(const Settings& s) {
  nlohmann::ordered_json json;
  eachSetting(s, [&](const char* name, const auto& value) { json[name] = settingToJson(value); });
  return json;
}

namespace {

nlohmann::ordered_json memoryToJson(const std::vector<BufferStats>& buffers) {
  nlohmann::ordered_json memory;
  std::uint64_t total = 0;
  for (const char* group : {"tree", "triangles", "queues", "textures", "film"}) {
    std::uint64_t sum = 0;
    for (const auto& b : buffers)
      if (b.group == group) sum += b.bytes;
    memory[group] = sum;
    total += sum;
  }
  memory["total"] = total;
  for (const auto& b : buffers) memory["buffers"].push_back({{"name", b.name}, {"bytes", b.bytes}});
  return memory;
}

/// What the host's clock has of a stage is no number of the device.
nlohmann::ordered_json stagesToJson(const std::vector<StageStats>& stages, bool givesTimes) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& stage : stages)
    list.push_back({{"name", stage.facts.name},
                    {"launches", stage.launches},
                    {"seconds", givesTimes ? nlohmann::ordered_json(stage.seconds) : nullptr},
                    {"items", stage.items},
                    {"bytes", stage.bytes},
                    {"perWorkItem", stage.perWorkItem}});
  return list;
}

nlohmann::ordered_json programsToJson(const std::vector<ProgramRun>& programs) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& p : programs)
    list.push_back({{"tier", p.isGeneral ? "general" : "specialised"},
                    {"firstBatch", p.firstBatch},
                    {"from", p.from},
                    {"seconds", p.seconds}});
  return list;
}

/// 4, not 4.0.
nlohmann::ordered_json wholeIfWhole(double x) {
  if (x == std::floor(x) && std::fabs(x) < 1e15) return static_cast<std::int64_t>(x);
  return x;
}

/// Starts count from the first.
nlohmann::ordered_json phasesToJson(const std::vector<PhaseStats>& phases) {
  double origin = std::numeric_limits<double>::infinity();
  for (const auto& p : phases) origin = std::min(origin, p.start);
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& p : phases)
    list.push_back({{"name", p.name}, {"start", p.start - origin}, {"seconds", p.seconds}});
  return list;
}

}  // namespace

nlohmann::ordered_json stageFactsToJson(const StageFacts& facts) {
  return {{"name", facts.name}, {"label", facts.label}, {"job", facts.job},    {"program", facts.program},
          {"file", facts.file}, {"unit", facts.unit},   {"queue", facts.queue}};
}

nlohmann::ordered_json statsToJson(const Stats& s) {
  nlohmann::ordered_json json;
  json["scene"] = {{"file", s.scene.file},
                   {"triangles", s.scene.triangles},
                   {"droppedTriangles", s.scene.droppedTriangles},
                   {"materials", s.scene.materials},
                   {"lights", s.scene.lights},
                   {"textures", s.scene.textures}};
  json["settings"] = settingsToJson(s.settings);
  json["settings"]["searchUsed"] = s.searchUsed;
  json["device"] = {{"platform", s.device.platform},         {"name", s.device.name},
                    {"version", s.device.version},           {"driver", s.device.driver},
                    {"computeUnits", s.device.computeUnits}, {"threads", s.device.threads},
                    {"givesTimes", s.device.givesTimes}};
  json["features"]["used"] = s.featuresUsed;
  json["features"]["kept"] = s.featuresForced;
  json["features"]["leftOut"] = nlohmann::ordered_json::array();
  for (const auto& [name, reason] : s.featuresLeftOut)
    json["features"]["leftOut"].push_back({{"name", name}, {"reason", reason}});
  json["features"]["trimmed"] = pruningToJson(s.pruning);
  json["rays"] = {{"primary", s.rays.primary},
                  {"impulse", s.rays.impulse},
                  {"shadow", s.rays.shadow},
                  {"total", s.rays.total()}};
  json["time"] = {{"load", s.time.load},     {"build", s.time.build},   {"compile", s.time.compile},
                  {"upload", s.time.upload}, {"render", s.time.render}, {"write", s.time.write},
                  {"total", s.time.total}};
  json["phases"] = phasesToJson(s.phases);
  json["programs"] = programsToJson(s.programs);
  json["stages"] = stagesToJson(s.stages, s.device.givesTimes);
  for (std::size_t i = 0; i < s.stages.size(); ++i)
    json["stages"][i].update(stageFactsToJson(s.stages[i].facts));
  json["bounces"] = nlohmann::ordered_json::array();
  for (const auto& b : s.bounces)
    json["bounces"].push_back(
        {{"bounce", b.bounce}, {"stages", stagesToJson(b.stages, s.device.givesTimes)}});
  json["memory"] = memoryToJson(s.buffers);
  json["error"] = nlohmann::ordered_json::array();
  for (const auto& e : s.error)
    json["error"].push_back(
        {{"seconds", e.seconds},
         {"raysPerPixel", wholeIfWhole(e.raysPerPixel)},
         {"estimate",
          e.raysPerPixel >= 2 ? nlohmann::ordered_json(e.estimate) : nlohmann::ordered_json(nullptr)},
         {"rmse", e.rmse ? nlohmann::ordered_json(*e.rmse) : nlohmann::ordered_json(nullptr)},
         {"mean", e.mean}});
  json["samples"] = {
      {"least", s.samples.least}, {"mean", wholeIfWhole(s.samples.mean)}, {"most", s.samples.most}};
  json["cutOffThroughput"] = s.ended.cutOff;
  json["bouncesThroughput"] = s.ended.bounces;
  json["transparentBouncesThroughput"] = s.ended.straight;
  json["biasBound"] =
      std::isfinite(s.biasBound) ? nlohmann::ordered_json(s.biasBound) : nlohmann::ordered_json(nullptr);
  json["meanRadiance"] = s.meanRadiance;
  json["nonFinite"] = s.nonFinite;
  json["dropped"] = s.dropped;
  return json;
}

}  // namespace whittle
