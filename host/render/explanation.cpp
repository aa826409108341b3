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
std::string place(const glm::dvec3& v, const glm::dvec3& origin = glm::dvec3(0)) {
  const glm::dvec3 p = v + origin;
  return fmt::format("({:.5g}, {:.5g}, {:.5g})", p.x, p.y, p.z);
}

std::string nameOf(const std::string& name, const char* kind, std::size_t index) {
  return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("\"{}\"", name);
}

std::string lightName(const Scene& scene, std::uint32_t light) {
  return nameOf(scene.lights[light].name, "light", light);
}

std::string materialName(const Scene& scene, std::uint32_t material) {
  return nameOf(scene.materials[material].name, "material", material);
}

std::string blockerText(const ShadowRecord& s, const Scene& scene) {
  if (!s.blocker) return {};
  return fmt::format(" by {}, triangle {}, {:.4g} m away",
                     materialName(scene, scene.triangles[s.blocker->primitive].material),
                     s.blocker->primitive, s.blocker->distance);
}

std::string shadowText(const ShadowRecord& s, const Scene& scene) {
  const std::string to = fmt::format("shadow ray to {}{}", lightName(scene, s.light),
                                     std::isfinite(s.length) ? fmt::format(", {:.4g} m", s.length) : "");
  if (s.arrived == glm::dvec3(0))
    return fmt::format("{}: blocked{}, {} missed", to, blockerText(s, scene), numbers(s.contribution));
  if (glm::all(glm::greaterThanEqual(s.arrived, 0.999 * s.contribution)))
    return fmt::format("{}: {} arrives", to, numbers(s.arrived));
  return fmt::format("{}: {} of {} arrives", to, numbers(s.arrived), numbers(s.contribution));
}

using Lines = std::vector<std::string>;

Lines hitLines(const RayRecord& ray, const Scene& scene) {
  if (!ray.hit) return {"leaves the scene"};
  const HitRecord& h = *ray.hit;
  return {fmt::format("meets {}, triangle {}, {:.5g} m away", materialName(scene, h.material), h.primitive,
                      glm::length(h.position - ray.origin)),
          fmt::format("  at {}, normal {}", place(h.position, scene.origin), place(h.normal))};
}

Lines endedLines(const RayRecord& ray) {
  Lines lines;
  for (const auto& e : ray.ended)
    lines.push_back(fmt::format("an impulse of throughput {:.4g} ends by {}", e.throughput,
                                e.byCutoff ? "--cutoff" : "a limit of depth"));
  return lines;
}

/// What there is to say of it; nothing of what is not worth a line.
Lines linesOf(Aspect aspect, const RayRecord& ray, const Scene& scene) {
  switch (aspect) {
    case Aspect::Path:
      return {fmt::format("from {} along {}", place(ray.origin, scene.origin), place(ray.direction))};
    case Aspect::Throughput:
      return ray.parent < 0 ? Lines{} : Lines{"throughput " + numbers(ray.throughput)};
    case Aspect::Hit:
      return hitLines(ray, scene);
    case Aspect::Local:
      return ray.local == glm::dvec3(0) ? Lines{} : Lines{"without shadow rays " + numbers(ray.local)};
    case Aspect::Ended:
      return endedLines(ray);
    case Aspect::Share:
      return shareOf(ray) == glm::dvec3(0) ? Lines{} : Lines{"adds " + numbers(shareOf(ray))};
  }
  return {};
}

/// The lines of one ray under way.
class Telling {
 public:
  Telling(const RayRecord& ray, const RayRecord* reference, const Scene& scene)
      : ray_(ray), reference_(reference), scene_(scene) {}

  void tell(Aspect aspect, const std::string& before = "  ") {
    for (const auto& line : linesOf(aspect, ray_, scene_)) say(before + line);
    if (!reference_ || agree(aspect, ray_, *reference_)) return;
    const Lines others = linesOf(aspect, *reference_, scene_);
    if (others.empty()) sayReference("nothing of that");
    for (const auto& line : others) sayReference(line);
  }

  void tellShadowRays() {
    for (const auto& s : ray_.shadows) {
      say("  " + shadowText(s, scene_));
      if (!reference_) continue;
      const ShadowRecord* const other = shadowTo(s.light, *reference_);
      if (!other)
        sayReference("no such shadow ray");
      else if (!agree(s, *other, ray_))
        sayReference(shadowText(*other, scene_));
    }
    if (!reference_) return;
    for (const auto& s : reference_->shadows)
      if (!shadowTo(s.light, ray_)) sayReference(shadowText(s, scene_));
  }

  void say(std::string text) { lines.push_back({std::move(text), false}); }
  void sayReference(const std::string& text) { lines.push_back({"    reference: " + text, true}); }

  std::vector<RayLine> lines;

 private:
  const RayRecord& ray_;
  const RayRecord* reference_;
  const Scene& scene_;
};

/// A ray that the reference alone has, and what comes of it.
std::string aloneText(const RayTree& reference, std::size_t index, const Scene& scene) {
  const RayRecord& ray = reference.rays[index];
  return fmt::format("{}, {}; adds {} itself", kindOf(reference, ray), hitLines(ray, scene).front(),
                     numbers(shareOf(ray)));
}

std::string partingText(const Parting& p, const Scene& scene) {
  using What = Parting::What;
  switch (p.what) {
    case What::Path:
      return "it goes another way";
    case What::Throughput:
      return "another throughput";
    case What::Hit:
      return "another hit";
    case What::Local:
      return "other radiance without shadow rays";
    case What::Shadow:
      return fmt::format("the shadow ray to {}", lightName(scene, p.light));
    case What::Ended:
      return "another impulse ends";
    case What::Missing:
      return "the reference has no such ray";
    case What::Additional:
      return "the reference has one more ray from there";
  }
  return "";
}

void tell(const RayTree& tree, std::size_t index, int depth, const Scene& scene, const Beside* beside,
          std::string& out) {
  const std::string indent(2 * static_cast<std::size_t>(std::min(depth, kDeepest)), ' ');
  for (const auto& line : rayLines(tree, index, scene, beside))
    out.append(indent).append(line.text).push_back('\n');
  for (std::size_t i = index + 1; i < tree.rays.size(); ++i)
    if (tree.rays[i].parent == static_cast<int>(index)) tell(tree, i, depth + 1, scene, beside, out);
}

nlohmann::ordered_json vectorJson(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

nlohmann::ordered_json rayJson(const RayTree& tree, const RayRecord& ray, const Scene& scene) {
  nlohmann::ordered_json json;
  json["parent"] = ray.parent;
  json["kind"] =
      ray.parent < 0 ? "eye" : wordOf(passageOf(ray, tree.rays[static_cast<std::size_t>(ray.parent)]));
  json["origin"] = vectorJson(ray.origin + scene.origin);
  json["direction"] = vectorJson(ray.direction);
  json["throughput"] = vectorJson(ray.throughput);
  if (ray.hit)
    json["hit"] = {{"primitive", ray.hit->primitive},
                   {"material", ray.hit->material},
                   {"position", vectorJson(ray.hit->position + scene.origin)},
                   {"normal", vectorJson(ray.hit->normal)}};
  else
    json["hit"] = nullptr;
  json["local"] = vectorJson(ray.local);
  json["radiance"] = vectorJson(ray.radiance);
  json["adds"] = vectorJson(shareOf(ray));
  json["shadowRays"] = nlohmann::ordered_json::array();
  for (const auto& s : ray.shadows) {
    nlohmann::ordered_json shadow{{"light", s.light},
                                  {"direction", vectorJson(s.direction)},
                                  {"contribution", vectorJson(s.contribution)},
                                  {"arrived", vectorJson(s.arrived)}};
    if (s.blocker)
      shadow["blocker"] = {{"primitive", s.blocker->primitive},
                           {"material", scene.triangles[s.blocker->primitive].material},
                           {"distance", s.blocker->distance}};
    json["shadowRays"].push_back(std::move(shadow));
  }
  json["ended"] = nlohmann::ordered_json::array();
  for (const auto& e : ray.ended)
    json["ended"].push_back({{"throughput", e.throughput}, {"by", e.byCutoff ? "cutoff" : "depth"}});
  return json;
}

nlohmann::ordered_json treeJson(const RayTree& tree, const Scene& scene) {
  nlohmann::ordered_json json{{"radiance", vectorJson(tree.radiance)}, {"sum", vectorJson(sumOf(tree))}};
  json["rays"] = nlohmann::ordered_json::array();
  for (const auto& ray : tree.rays) json["rays"].push_back(rayJson(tree, ray, scene));
  return json;
}

/// Samples from `first` on in which the two part.
std::size_t partedBeyond(std::size_t first, const Explanation& e) {
  std::size_t count = 0;
  for (std::size_t i = first; i < e.trees.size(); ++i)
    count += compareTrees(e.trees[i], e.reference[i]).parting.has_value();
  return count;
}

/// The reference's tree, which of its rays each of the kernels' is, and where they part.
nlohmann::ordered_json referenceJson(const RayTree& kernels, const RayTree& reference, const Scene& scene) {
  const TreeComparison c = compareTrees(kernels, reference);
  nlohmann::ordered_json json = treeJson(reference, scene);
  json["partners"] = c.partner;
  json["parting"] = nullptr;
  if (c.parting) json["parting"] = {{"ray", c.parting->ray}, {"what", partingText(*c.parting, scene)}};
  return json;
}

}  // namespace

std::string rayTitle(const RayTree& tree, std::size_t index, const Scene& scene) {
  const RayRecord& ray = tree.rays[index];
  return fmt::format("[{}] {}: {}", index, kindOf(tree, ray),
                     ray.hit ? materialName(scene, ray.hit->material) : "leaves the scene");
}

std::vector<RayLine> rayLines(const RayTree& tree, std::size_t index, const Scene& scene,
                              const Beside* beside) {
  const RayRecord& ray = tree.rays[index];
  const int partner = beside ? beside->comparison.partner[index] : -1;
  Telling telling(ray, partner < 0 ? nullptr : &beside->reference.rays[static_cast<std::size_t>(partner)],
                  scene);
  telling.tell(Aspect::Path, fmt::format("[{}] {} ", index, kindOf(tree, ray)));
  const bool isNew = partner < 0 && ray.parent >= 0 && beside &&
                     beside->comparison.partner[static_cast<std::size_t>(ray.parent)] >= 0;
  if (isNew) telling.sayReference("no such ray");
  telling.tell(Aspect::Throughput);
  telling.tell(Aspect::Hit);
  telling.tell(Aspect::Local);
  telling.tellShadowRays();
  telling.tell(Aspect::Ended);
  if (partner >= 0)
    for (const std::size_t i : beside->comparison.alone)
      if (beside->reference.rays[i].parent == partner)
        telling.sayReference(aloneText(beside->reference, i, scene));
  telling.tell(Aspect::Share);
  return std::move(telling.lines);
}

std::string verdict(const RayTree& tree, const Beside& beside, const Scene& scene) {
  const auto& parting = beside.comparison.parting;
  return fmt::format(
      "reference: {}; the kernels {}; {}", numbers(beside.reference.radiance), numbers(tree.radiance),
      parting ? fmt::format("parted at ray [{}]: {}", parting->ray, partingText(*parting, scene))
              : "no difference beyond rounding");
}

std::string explanationText(const Explanation& e, const Scene& scene, const Settings& settings) {
  const auto mean = [](const std::vector<RayTree>& trees) {
    glm::dvec3 sum(0);
    for (const auto& tree : trees) sum += tree.radiance;
    return sum / static_cast<double>(trees.size());
  };
  std::string out = fmt::format("pixel {},{} of {}×{}: radiance {} W/(m² sr)\n", e.x, e.y, settings.width,
                                settings.height, numbers(mean(e.trees)));
  for (std::size_t i = 0; i < std::min(e.trees.size(), kToldSamples); ++i) {
    const RayTree& tree = e.trees[i];
    if (e.trees.size() > 1)
      out += fmt::format("\nsample {} of {}: {}\n", i + 1, e.trees.size(), numbers(tree.radiance));
    const std::string sum = fmt::format("sum of {} rays: {}\n", tree.rays.size(), numbers(sumOf(tree)));
    if (e.reference.empty()) {
      tell(tree, 0, 0, scene, nullptr, out);
      out += sum;
      continue;
    }
    const TreeComparison comparison = compareTrees(tree, e.reference[i]);
    const Beside beside{e.reference[i], comparison};
    tell(tree, 0, 0, scene, &beside, out);
    out += sum + verdict(tree, beside, scene) + "\n";
  }
  if (e.trees.size() > kToldSamples)
    out += fmt::format(
        "\n{} further samples{}: --json has them\n", e.trees.size() - kToldSamples,
        e.reference.empty() ? "" : fmt::format(", of which {} part", partedBeyond(kToldSamples, e)));
  return out;
}

nlohmann::ordered_json explanationToJson(const Explanation& e, const Scene& scene) {
  nlohmann::ordered_json json{{"x", e.x}, {"y", e.y}, {"samples", nlohmann::ordered_json::array()}};
  for (std::size_t i = 0; i < e.trees.size(); ++i) {
    nlohmann::ordered_json sample = treeJson(e.trees[i], scene);
    if (!e.reference.empty()) sample["reference"] = referenceJson(e.trees[i], e.reference[i], scene);
    json["samples"].push_back(std::move(sample));
  }
  return json;
}

}  // namespace whittle
