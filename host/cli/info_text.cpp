// The text of `whittle info`, 80 columns.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "cli/info_features.h"
#include "cli/info_report.h"
#include "cli/viewpoint.h"
#include "render/peak_memory.h"
#include "report/printable.h"
#include "report/text.h"
#include "scene/byte_counts.h"
#include "scene/camera.h"

namespace whittle::cli {
namespace {

constexpr double kDegrees = 57.29577951308232;

std::string vectorText(const glm::vec3& v) {
  // A coordinate far below the largest one is rounding of the file's transformations.
  const float tiny = 1e-6F * std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const auto number = [&](float c) { return formatReal(std::abs(c) < tiny ? 0.0 : static_cast<double>(c)); };
  return fmt::format("({}, {}, {})", number(v.x), number(v.y), number(v.z));
}

/// Shows places in the file's coordinates, told apart as finely as the scene's size asks for.
class Places {
 public:
  explicit Places(const Scene& scene) : box_(boundsOf(scene)), origin_(scene.origin) {}

  glm::dvec3 size() const { return box_.hi - box_.lo; }
  const glm::dvec3& origin() const { return origin_; }
  std::string operator()(const glm::dvec3& place) const {
    const glm::dvec3 p = place + origin_;
    const double across = glm::length(size());
    return fmt::format("({}, {}, {})", formatCoordinate(p.x, across), formatCoordinate(p.y, across),
                       formatCoordinate(p.z, across));
  }
  std::string bounds() const { return fmt::format("from {} to {}", (*this)(box_.lo), (*this)(box_.hi)); }

 private:
  Bounds box_;
  glm::dvec3 origin_;
};

/// A name of the file's, on one line.
std::string shownName(const std::string& name) {
  constexpr std::size_t kLongest = 60;
  return printableLine(name, kLongest);
}

std::string entry(std::size_t index, const std::string& name, std::size_t nameColumns,
                  const std::string& text) {
  const std::string head = fmt::format("    {:>2}  {}  ", index, padded(shownName(name), nameColumns));
  return head + wrapped(text, 80 - std::min<std::size_t>(40, columnsOf(head)), columnsOf(head)) + "\n";
}

template <typename Items>
std::size_t widestName(const Items& items) {
  std::size_t widest = 0;
  for (const auto& item : items) widest = std::max(widest, columnsOf(shownName(item.name)));
  return std::min<std::size_t>(widest, 24);
}

std::string cameraText(const Camera& c, const Places& places) {
  const std::string lens =
      c.orthographic ? fmt::format("orthographic, {} m high", formatReal(2.0 * static_cast<double>(c.ymag)))
                     : fmt::format("perspective, {:.1f}° high", static_cast<double>(c.yfov) * kDegrees);
  return fmt::format("{}, at {} m, looking {}; {}", lens, places(c.position), vectorText(c.forward),
                     viewpointText(c, places.origin()));
}

std::string lightText(const Light& l, const Places& places) {
  const LightType& type = typeOf(l.kind);
  std::string text = fmt::format("{}, {} {}", type.word, vectorText(l.intensity), type.unit);
  if (type.isPlaced) text += fmt::format(", at {} m", places(l.position));
  if (type.isAimed) text += fmt::format(", shining {}", vectorText(l.direction));
  if (type.hasCone)
    text += fmt::format(", half angle {:.1f}° to {:.1f}°", static_cast<double>(l.innerConeAngle) * kDegrees,
                        static_cast<double>(l.outerConeAngle) * kDegrees);
  if (std::isfinite(l.range)) text += fmt::format(", range {} m", formatReal(static_cast<double>(l.range)));
  return text + (l.castsShadows ? "" : ", casts no shadows");
}

std::string boundsText(const Places& places) {
  const glm::dvec3 size = places.size();
  const std::string text = fmt::format("{} × {} × {} m, {}", formatReal(size.x), formatReal(size.y),
                                       formatReal(size.z), places.bounds());
  return "  " + wrapped(text, 78, 4) + "\n";
}

/// What the file offers to choose, and what of it was compressed.
std::string fileText(const Notices& n) {
  constexpr std::size_t kShown = 20;
  std::string out;
  if (!n.variants.empty())
    out +=
        fmt::format("  {}, --variant NAME shows one\n",
                    formatSome(n.variants.size(), "variant of the materials", "variants of the materials"));
  for (std::size_t i = 0; i < std::min(n.variants.size(), kShown); ++i)
    out += fmt::format("    {:>2}  {}\n", i, shownName(n.variants[i]));
  if (n.variants.size() > kShown)
    out +=
        fmt::format("    … and {} more (--json has them all)\n", formatInteger(n.variants.size() - kShown));
  for (const auto& u : n.unpacked)
    out +=
        "  " +
        wrapped(fmt::format("compressed: {} of {}, {} that become {}", formatSome(u.parts, "part", "parts"),
                            u.extension, formatBytes(u.packedBytes), formatBytes(u.bytes)),
                78, 4) +
        "\n";
  return out;
}

std::string animationText(const AnimationFacts& a) {
  const std::string length = fmt::format("{} s", formatReal(a.seconds));
  if (a.pointers == 0) return length;
  return fmt::format("{}; {} by KHR_animation_pointer", length,
                     formatSome(a.pointers, "property", "properties"));
}

std::string contents(const Scene& s) {
  std::string counts = formatSome(s.triangles.size(), "triangle", "triangles");
  if (s.droppedTriangles > 0) counts += fmt::format(" ({} dropped)", formatInteger(s.droppedTriangles));
  counts += fmt::format(", {}, {}, {}", formatSome(s.positions.size(), "vertex", "vertices"),
                        formatSome(s.materials.size(), "material", "materials"),
                        formatSome(s.images.size(), "texture image", "texture images"));
  std::string out = "What is in it\n  " + wrapped(counts, 78, 2) + "\n";
  const Places places(s);
  if (!s.triangles.empty()) out += boundsText(places);
  out += fmt::format("  {}\n", formatSome(s.cameras.size(), "camera", "cameras"));
  for (std::size_t i = 0; i < s.cameras.size(); ++i)
    out += entry(i, s.cameras[i].name, widestName(s.cameras), cameraText(s.cameras[i], places));
  out += fmt::format("  {}\n", formatSome(s.lights.size(), "light", "lights"));
  constexpr std::size_t kShown = 20;
  for (std::size_t i = 0; i < std::min(s.lights.size(), kShown); ++i)
    out += entry(i, s.lights[i].name, widestName(s.lights), lightText(s.lights[i], places));
  if (s.lights.size() > kShown)
    out += fmt::format("    … and {} more (--json has them all)\n", formatInteger(s.lights.size() - kShown));
  if (!s.animations.empty())
    out += fmt::format("  {}, --time SECONDS shows one\n",
                       formatSome(s.animations.size(), "animation", "animations"));
  for (std::size_t i = 0; i < std::min(s.animations.size(), kShown); ++i)
    out += entry(i, s.animations[i].name, widestName(s.animations), animationText(s.animations[i]));
  if (s.animations.size() > kShown)
    out +=
        fmt::format("    … and {} more (--json has them all)\n", formatInteger(s.animations.size() - kShown));
  const auto& b = s.background;
  std::string map = b.map.empty() ? "" : fmt::format(" times a map of {}×{}", b.width, b.height);
  if (!b.map.empty() && b.rotation != 0.0) map += fmt::format(", turned by {:g}°", b.rotation);
  if (s.sky)
    map += fmt::format(", a sky with its sun {:g}° high at {:g}°, turbidity {:g}", s.sky->elevation,
                       s.sky->azimuth, s.sky->turbidity);
  return out + "  " + wrapped(fmt::format("background {} W/(m² sr){}", vectorText(b.radiance), map), 78, 4) +
         "\n";
}

/// "3 of 12 materials: 5 that no triangle has, 4 alike"; nothing where all of them go to the device.
std::string pruningLine(const PruningReport::Things& things, const char* what, const char* unused) {
  std::vector<std::string> reasons;
  if (things.unused > 0) reasons.push_back(formatInteger(things.unused) + unused);
  if (things.alike > 0) reasons.push_back(fmt::format("{} like another", formatInteger(things.alike)));
  if (reasons.empty()) return "";
  return "  " +
         wrapped(fmt::format("{} of {} {}: {}", formatInteger(things.unused + things.alike),
                             formatInteger(things.all), what, fmt::join(reasons, ", ")),
                 78, 4) +
         "\n";
}

std::string pruningText(const PruningReport& t) {
  std::string out = pruningLine(t.materials, "materials", " that no triangle has") +
                    pruningLine(t.images, "texture images", " that no material reads") +
                    pruningLine(t.vertices, "vertices", " that no triangle has");
  if (t.needlessMasks > 0)
    out += fmt::format("  {}\n", formatSome(t.needlessMasks, "alpha mask that cuts nothing out",
                                            "alpha masks that cut nothing out"));
  if (t.needlessBlends > 0)
    out += fmt::format("  {}\n", formatSome(t.needlessBlends, "blended material that is opaque",
                                            "blended materials that are opaque"));
  constexpr std::size_t kShown = 20;
  const auto& dark = t.droppedLights;
  if (!dark.empty())
    out += fmt::format("  {} of {}\n", formatInteger(dark.size()), formatSome(t.lights, "light", "lights"));
  for (std::size_t i = 0; i < std::min(dark.size(), kShown); ++i)
    out += entry(dark[i].index, dark[i].name, widestName(dark), dark[i].reason);
  if (dark.size() > kShown)
    out += fmt::format("    … and {} more (--json has them all)\n", formatInteger(dark.size() - kShown));
  return "\nNot sent to the device\n" + (out.empty() ? "  nothing\n" : out);
}

std::string buffersText(const RenderPlan& plan) {
  const auto& s = plan.settings;
  std::string out =
      wrapped(fmt::format("Buffers on {}, {} pixels, {} in flight", plan.device.name, sizeText(s),
                          formatSome(static_cast<std::uint64_t>(s.wavefront), "ray", "rays")),
              80, 2) +
      "\n";
  std::uint64_t total = 0;
  for (const char* group : {"tree", "triangles", "textures", "queues", "film"}) {
    std::uint64_t bytes = 0;
    std::vector<std::string> names;
    for (const auto& b : plan.buffers)
      if (b.group == group) bytes += b.bytes, names.push_back(b.name);
    total += bytes;
    if (!names.empty())
      out += fmt::format("  {:<10} {:>8}  {}\n", group, formatBytes(bytes),
                         wrapped(fmt::format("{}", fmt::join(names, ", ")), 57, 23));
  }
  out += fmt::format("  {:<10} {:>8}\n", "total", formatBytes(total));
  if (plan.everythingBytes <= total) return out;
  const auto all = static_cast<double>(plan.everythingBytes);
  return out + fmt::format("  {:<10} {:>8}  {:.0f} % of the {} that everything would take\n", "saved",
                           formatBytes(plan.everythingBytes - total),
                           100.0 * (all - static_cast<double>(total)) / all,
                           formatBytes(plan.everythingBytes));
}

/// What `whittle render` draws it with.
std::string programsText(const RenderPlan& plan) {
  std::string text = "its own, compiled when it is rendered; `whittle cache --warm` lets it start without";
  if (plan.general.empty()) text = "its own: general ones do not do what the options ask for";
  if (plan.isOwnCompiled) text = "its own, compiled before";
  if (plan.startsOnGeneral) text = fmt::format("general ones ({}), until its own are compiled", plan.general);
  return "Programs\n  " + wrapped(text, 78, 2) + "\n\n";
}

std::string peakText(std::uint64_t bytes) {
  return "\nMemory of a render\n  " +
         wrapped(fmt::format("about {} at its most, buffers and all; {} more while kernels are compiled that "
                             "were not before",
                             formatBytes(bytes), formatBytes(kCompilerBytes)),
                 78, 2) +
         "\n";
}

}  // namespace

std::string infoText(const InfoReport& r) {
  std::string out = printableLine(r.scene.file) + "\n\n" + contents(r.scene) + fileText(r.notices) +
                    featuresText(r.features) + pruningText(r.pruning);
  out += "\nStages that will run\n  " + wrapped(fmt::format("{}", fmt::join(r.stages, ", ")), 78, 2) + "\n\n";
  if (r.plan) return out + programsText(*r.plan) + buffersText(*r.plan) + peakText(r.peakBytes);
  return out + "Buffers\n  " + wrapped("unknown: " + r.planProblem, 78, 2) + "\n";
}

}  // namespace whittle::cli
