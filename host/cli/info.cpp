// whittle info: what is in a scene, what it needs, and what will be left out and why.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/options.h"
#include "render/scene_features.h"

namespace whittle::cli {
namespace {

struct InfoOptions {
  SceneOptions scene;
  Settings settings;
  bool json = false;
};

const char* kindName(LightKind kind) {
  return kind == LightKind::Point ? "point" : (kind == LightKind::Spot ? "spot" : "directional");
}

nlohmann::ordered_json toJson(const Scene& scene, const SceneFeatures& features, const Notices& notices) {
  nlohmann::ordered_json json;
  json["file"] = scene.file;
  json["triangles"] = scene.triangles.size();
  json["droppedTriangles"] = scene.droppedTriangles;
  json["vertices"] = scene.positions.size();
  json["materials"] = scene.materials.size();
  json["textures"] = scene.images.size();
  json["lights"] = nlohmann::ordered_json::array();
  for (const auto& l : scene.lights) json["lights"].push_back({{"name", l.name}, {"kind", kindName(l.kind)}, {"castsShadows", l.castsShadows}});
  json["cameras"] = nlohmann::ordered_json::array();
  for (const auto& c : scene.cameras) json["cameras"].push_back({{"name", c.name}, {"orthographic", c.orthographic}});
  json["features"] = {{"used", nlohmann::ordered_json::array()}, {"leftOut", nlohmann::ordered_json::array()}};
  for (const auto& line : features.lines()) {
    if (line.used)
      json["features"]["used"].push_back(line.text);
    else
      json["features"]["leftOut"].push_back({{"name", line.text}, {"reason", line.reason}});
  }
  json["warnings"] = notices.warnings;
  json["notes"] = notices.notes;
  return json;
}

void print(const Scene& scene, const SceneFeatures& features) {
  fmt::print("{}: {} triangles ({} dropped), {} vertices, {} materials, {} images\n", scene.file, scene.triangles.size(),
             scene.droppedTriangles, scene.positions.size(), scene.materials.size(), scene.images.size());
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    fmt::print("camera {} '{}', {}\n", i, scene.cameras[i].name, scene.cameras[i].orthographic ? "orthographic" : "perspective");
  for (const auto& l : scene.lights)
    fmt::print("light '{}', {}{}\n", l.name, kindName(l.kind), l.castsShadows ? "" : ", casts no shadows");
  fmt::print("\nneeded\n");
  for (const auto& line : features.lines())
    if (line.used) fmt::print("  {}\n", line.text);
  fmt::print("\nleft out\n");
  for (const auto& line : features.lines())
    if (!line.used) fmt::print("  {:<36} {}\n", line.text, line.reason);
}

}  // namespace

void addInfo(CLI::App& app, int& status) {
  auto o = std::make_shared<InfoOptions>();
  CLI::App* c = app.add_subcommand("info", "what is in a scene, what it needs, what will be left out");
  addSceneOptions(*c, o->scene);
  addPictureOptions(*c, o->settings);
  addDeviceOptions(*c, o->settings);
  c->add_flag("--json", o->json, "as JSON");
  c->callback([o, &status] {
    Notices notices;
    const Scene scene = loadScene(o->scene, notices);
    const SceneFeatures features = SceneFeatures::analyse(scene, o->settings, {});
    if (o->json)
      fmt::print("{}\n", toJson(scene, features, notices).dump(2));
    else
      print(scene, features);
    status = 0;
  });
}

}  // namespace whittle::cli
