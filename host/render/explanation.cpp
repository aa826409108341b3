// See explanation.h.
#include "render/explanation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace whittle {
namespace {

/// Of a long tree's indentation.
constexpr int kDeepest = 12;
/// Samples that are told ray by ray.
constexpr std::size_t kTold = 4;

const char* wordOf(Passage passage) {
  switch (passage) {
    case Passage::Reflected:
      return "reflected";
    case Passage::Refracted:
      return "refracted";
    case Passage::Straight:
      return "straight on";
  }
  return "";
}

const char* kindOf(const RayTree& tree, const RayRecord& ray) {
  return ray.parent < 0 ? "eye ray" : wordOf(passageOf(ray, tree.rays[static_cast<std::size_t>(ray.parent)]));
}

std::string numbers(const glm::dvec3& v) { return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z); }
std::string place(const glm::vec3& v, const glm::dvec3& origin = glm::dvec3(0)) {
  const glm::dvec3 p = glm::dvec3(v) + origin;
  return fmt::format("({:.5g}, {:.5g}, {:.5g})", p.x, p.y, p.z);
}

std::string nameOf(const std::string& name, const char* kind, std::size_t index) {
  return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("\"{}\"", name);
}

std::string lightName(const Scene& scene, std::uint32_t light) {
  return nameOf(scene.lights[light].name, "light", light);
}

std::string shadowText(const ShadowRecord& s, const Scene& scene) {
  const std::string to = fmt::format("shadow ray to {}{}", lightName(scene, s.light),
                                     std::isfinite(s.length) ? fmt::format(", {:.4g} m", s.length) : "");
  if (s.arrived == glm::vec3(0)) return fmt::format("{}: blocked, {} missed", to, numbers(s.contribution));
  if (glm::all(glm::greaterThan(s.arrived, 0.999F * s.contribution)))
    return fmt::format("{}: {} arrives", to, numbers(s.arrived));
  return fmt::format("{}: {} of {} arrives", to, numbers(s.arrived), numbers(s.contribution));
}

void tell(const RayTree& tree, std::size_t index, int depth, const Scene& scene, std::string& out) {
  const std::string indent(2 * static_cast<std::size_t>(std::min(depth, kDeepest)), ' ');
  for (const auto& line : rayLines(tree, index, scene)) out.append(indent).append(line).push_back('\n');
  for (std::size_t i = index + 1; i < tree.rays.size(); ++i)
    if (tree.rays[i].parent == static_cast<int>(index)) tell(tree, i, depth + 1, scene, out);
}

nlohmann::ordered_json vectorJson(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

nlohmann::ordered_json rayJson(const RayTree& tree, const RayRecord& ray, const Scene& scene) {
  nlohmann::ordered_json json;
  json["parent"] = ray.parent;
  json["kind"] =
      ray.parent < 0 ? "eye" : wordOf(passageOf(ray, tree.rays[static_cast<std::size_t>(ray.parent)]));
  json["origin"] = vectorJson(glm::dvec3(ray.origin) + scene.origin);
  json["direction"] = vectorJson(ray.direction);
  json["throughput"] = vectorJson(ray.throughput);
  if (ray.hit)
    json["hit"] = {{"primitive", ray.hit->primitive},
                   {"material", ray.hit->material},
                   {"position", vectorJson(glm::dvec3(ray.hit->position) + scene.origin)},
                   {"normal", vectorJson(ray.hit->normal)}};
  else
    json["hit"] = nullptr;
  json["local"] = vectorJson(ray.local);
  json["radiance"] = vectorJson(ray.radiance);
  json["adds"] = vectorJson(shareOf(ray));
  json["shadowRays"] = nlohmann::ordered_json::array();
  for (const auto& s : ray.shadows)
    json["shadowRays"].push_back({{"light", s.light},
                                  {"direction", vectorJson(s.direction)},
                                  {"contribution", vectorJson(s.contribution)},
                                  {"arrived", vectorJson(s.arrived)}});
  json["ended"] = nlohmann::ordered_json::array();
  for (const auto& e : ray.ended)
    json["ended"].push_back({{"throughput", e.throughput}, {"by", e.byCutoff ? "cutoff" : "depth"}});
  return json;
}

}  // namespace

Passage passageOf(const RayRecord& ray, const RayRecord& parent) {
  if (ray.goesStraight || !parent.hit) return Passage::Straight;
  return glm::dot(ray.direction, parent.hit->normal) > 0.0F ? Passage::Reflected : Passage::Refracted;
}

glm::dvec3 shareOf(const RayRecord& ray) { return glm::dvec3(ray.throughput) * glm::dvec3(ray.radiance); }

glm::dvec3 sumOf(const RayTree& tree) {
  glm::dvec3 sum(0);
  for (const auto& ray : tree.rays) sum += shareOf(ray);
  return sum;
}

std::string rayTitle(const RayTree& tree, std::size_t index, const Scene& scene) {
  const RayRecord& ray = tree.rays[index];
  return fmt::format("{}: {}", kindOf(tree, ray),
                     ray.hit ? nameOf(scene.materials[ray.hit->material].name, "material", ray.hit->material)
                             : "leaves the scene");
}

std::vector<std::string> rayLines(const RayTree& tree, std::size_t index, const Scene& scene) {
  const RayRecord& ray = tree.rays[index];
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{} from {} along {}", kindOf(tree, ray), place(ray.origin, scene.origin),
                              place(ray.direction)));
  if (ray.parent >= 0) lines.push_back("  throughput " + numbers(glm::dvec3(ray.throughput)));
  if (ray.hit) {
    const HitRecord& h = *ray.hit;
    lines.push_back(fmt::format("  meets {}, triangle {}, {:.5g} m away",
                                nameOf(scene.materials[h.material].name, "material", h.material), h.primitive,
                                glm::length(glm::dvec3(h.position) - glm::dvec3(ray.origin))));
    lines.push_back(fmt::format("    at {}, normal {}", place(h.position, scene.origin), place(h.normal)));
  } else {
    lines.push_back("  leaves the scene");
  }
  if (ray.local != glm::vec3(0)) lines.push_back("  without shadow rays " + numbers(glm::dvec3(ray.local)));
  for (const auto& s : ray.shadows) lines.push_back("  " + shadowText(s, scene));
  for (const auto& e : ray.ended)
    lines.push_back(fmt::format("  an impulse of throughput {:.4g} ends by {}", e.throughput,
                                e.byCutoff ? "--cutoff" : "a limit of depth"));
  if (shareOf(ray) != glm::dvec3(0)) lines.push_back("  adds " + numbers(shareOf(ray)));
  return lines;
}

std::string explanationText(const Explanation& e, const Scene& scene, const Settings& settings) {
  glm::dvec3 mean(0);
  for (const auto& tree : e.trees) mean += glm::dvec3(tree.radiance) / static_cast<double>(e.trees.size());
  std::string out = fmt::format("pixel {},{} of {}×{}: radiance {} W/(m² sr)\n", e.x, e.y, settings.width,
                                settings.height, numbers(mean));
  for (std::size_t i = 0; i < std::min(e.trees.size(), kTold); ++i) {
    const RayTree& tree = e.trees[i];
    if (e.trees.size() > 1)
      out +=
          fmt::format("\nsample {} of {}: {}\n", i + 1, e.trees.size(), numbers(glm::dvec3(tree.radiance)));
    tell(tree, 0, 0, scene, out);
    out += fmt::format("sum of {} rays: {}\n", tree.rays.size(), numbers(sumOf(tree)));
  }
  if (e.trees.size() > kTold)
    out += fmt::format("\n{} further samples: --json has them\n", e.trees.size() - kTold);
  return out;
}

nlohmann::ordered_json explanationToJson(const Explanation& e, const Scene& scene) {
  nlohmann::ordered_json json{{"x", e.x}, {"y", e.y}, {"samples", nlohmann::ordered_json::array()}};
  for (const auto& tree : e.trees) {
    nlohmann::ordered_json sample{{"radiance", vectorJson(tree.radiance)}, {"sum", vectorJson(sumOf(tree))}};
    sample["rays"] = nlohmann::ordered_json::array();
    for (const auto& ray : tree.rays) sample["rays"].push_back(rayJson(tree, ray, scene));
    json["samples"].push_back(std::move(sample));
  }
  return json;
}

}  // namespace whittle
