// `whittle info --json`: the same facts as the text, none abridged.
#include <algorithm>
#include <cmath>

#include "cli/info_report.h"
#include "render/peak_memory.h"
#include "report/json_float.h"
#include "scene/camera.h"
#include "wavefront/stages.h"

namespace whittle::cli {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const glm::vec3& v) { return {jsonFloat(v.x), jsonFloat(v.y), jsonFloat(v.z)}; }
/// A point of the scene in the file's coordinates; all that a double holds of it.
Json toJson(const glm::vec3& p, const glm::dvec3& origin) {
  if (origin == glm::dvec3(0.0)) return toJson(p);
  return {static_cast<double>(p.x) + origin.x, static_cast<double>(p.y) + origin.y,
          static_cast<double>(p.z) + origin.z};
}
/// Box of the triangles in the file's coordinates; null where there are none.
Json boundsJson(const Scene& scene) {
  if (scene.triangles.empty()) return nullptr;
  const Bounds box = boundsOf(scene);
  return {{"min", toJson(glm::vec3(box.lo), scene.origin)}, {"max", toJson(glm::vec3(box.hi), scene.origin)}};
}
/// JSON has no infinity: null for "no limit".
Json finiteOrNull(float value) { return std::isfinite(value) ? Json(jsonFloat(value)) : Json(nullptr); }

Json camerasJson(const Scene& scene) {
  Json cameras = Json::array();
  for (const auto& c : scene.cameras) {
    cameras.push_back({{"name", c.name},
                       {"orthographic", c.orthographic},
                       {"node", c.node},
                       {"position", toJson(c.position, scene.origin)},
                       {"forward", toJson(c.forward)},
                       {"up", toJson(c.up)}});
    cameras.back()[c.orthographic ? "ymag" : "yfov"] = jsonFloat(c.orthographic ? c.ymag : c.yfov);
  }
  return cameras;
}

Json lightsJson(const Scene& scene) {
  Json lights = Json::array();
  for (const auto& l : scene.lights) {
    const LightType& type = typeOf(l.kind);
    lights.push_back({{"name", l.name},
                      {"kind", type.word},
                      {"castsShadows", l.castsShadows},
                      {"intensity", toJson(l.intensity)}});
    Json& light = lights.back();
    if (type.isPlaced)
      light["position"] = toJson(l.position, scene.origin), light["range"] = finiteOrNull(l.range);
    if (type.isAimed) light["direction"] = toJson(l.direction);
    if (type.hasCone) {
      light["innerConeAngle"] = jsonFloat(l.innerConeAngle);
      light["outerConeAngle"] = jsonFloat(l.outerConeAngle);
    }
  }
  return lights;
}

Json animationsJson(const Scene& scene) {
  Json animations = Json::array();
  for (const auto& a : scene.animations)
    animations.push_back({{"name", a.name}, {"seconds", a.seconds}, {"pointers", a.pointers}});
  return animations;
}

Json unpackedJson(const Notices& notices) {
  Json json = Json::array();
  for (const auto& u : notices.unpacked)
    json.push_back(
        {{"extension", u.extension}, {"parts", u.parts}, {"packedBytes", u.packedBytes}, {"bytes", u.bytes}});
  return json;
}

Json featuresJson(const SceneFeatures& features, const PruningReport& pruning) {
  Json json{{"used", Json::array()}, {"kept", Json::array()}, {"leftOut", Json::array()}};
  for (const auto& line : features.lines()) {
    if (line.forced) json["kept"].push_back(line.text);
    if (line.used)
      json["used"].push_back(line.text);
    else
      json["leftOut"].push_back({{"name", line.text}, {"reason", line.reason}});
  }
  json["trimmed"] = pruningToJson(pruning);
  return json;
}

Json buffersJson(const RenderPlan& plan) {
  Json buffers = Json::array();
  for (const auto& b : plan.buffers)
    buffers.push_back({{"name", b.name}, {"group", b.group}, {"bytes", b.bytes}});
  return buffers;
}

/// The facts of the stages that will run, for scripts that draw or count them.
Json pipelineJson(const std::vector<std::string>& names) {
  Json pipeline = Json::array();
  for (const Stage& stage : allStages())
    if (std::find(names.begin(), names.end(), stage.facts.name) != names.end())
      pipeline.push_back(stageFactsToJson(stage.facts));
  return pipeline;
}

Json backgroundJson(const Background& b) {
  return {{"radiance", toJson(b.radiance)},
          {"mapWidth", b.width},
          {"mapHeight", b.height},
          {"rotation", b.rotation}};
}

Json skyJson(const std::optional<Sky>& sky) {
  if (!sky) return nullptr;
  return {{"elevation", sky->elevation}, {"azimuth", sky->azimuth}, {"turbidity", sky->turbidity}};
}

}  // namespace

Json infoJson(const InfoReport& r) {
  const Scene& scene = r.scene;
  Json json{{"file", scene.file},
            {"triangles", scene.triangles.size()},
            {"droppedTriangles", scene.droppedTriangles},
            {"vertices", scene.positions.size()},
            {"materials", scene.materials.size()},
            {"textures", scene.images.size()},
            {"bounds", boundsJson(scene)},
            {"lights", lightsJson(scene)},
            {"animations", animationsJson(scene)},
            {"variants", r.notices.variants},
            {"unpacked", unpackedJson(r.notices)},
            {"cameras", camerasJson(scene)},
            {"background", backgroundJson(scene.background)},
            {"sky", skyJson(scene.sky)},
            {"features", featuresJson(r.features, r.pruning)},
            {"stages", r.stages},
            {"pipeline", pipelineJson(r.stages)}};
  json["device"] = r.plan ? Json(r.plan->device.name) : Json(nullptr);
  json["deviceProblem"] = r.plan ? Json(nullptr) : Json(r.planProblem);
  json["buffers"] = r.plan ? buffersJson(*r.plan) : Json(nullptr);
  json["everythingBytes"] = r.plan ? Json(r.plan->everythingBytes) : Json(nullptr);
  json["peakBytes"] = r.plan ? Json(r.peakBytes) : Json(nullptr);
  json["programs"] = !r.plan
                         ? Json(nullptr)
                         : Json{{"start", r.plan->startsOnGeneral ? "general" : "specialised"},
                                {"general", r.plan->general.empty() ? Json(nullptr) : Json(r.plan->general)},
                                {"compiled", r.plan->isOwnCompiled}};
  json["compilerBytes"] = r.plan ? Json(kCompilerBytes) : Json(nullptr);
  json["warnings"] = r.notices.warnings;
  json["notes"] = r.notices.notes;
  return json;
}

}  // namespace whittle::cli
