// Tables of a render's statistics; at most 80 columns.
#include "cli/profile_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/text.h"

namespace whittle::cli {
namespace {

/// Items of these stages are rays.
bool tracesRays(const std::string& stage) { return stage == "intersect" || stage == "occlude"; }

double megaRate(std::uint64_t items, double seconds) {
  return seconds > 0.0 ? static_cast<double>(items) / seconds * 1e-6 : 0.0;
}

double kernelSeconds(const Stats& stats) {
  double sum = 0.0;
  for (const auto& s : stats.stages) sum += s.seconds;
  return sum;
}

}  // namespace

std::string profileTable(const Stats& stats) {
  const double sum = kernelSeconds(stats);
  std::string out =
      fmt::format("{:<22}{:>9}{:>13}{:>11}{:>8}  {}\n", "stage", "launches", "items", "ms", "share", "M/s");
  auto stages = stats.stages;
  std::stable_sort(stages.begin(), stages.end(),
                   [](const auto& a, const auto& b) { return a.seconds > b.seconds; });
  for (const auto& s : stages)
    out += fmt::format("{:<22}{:>9}{:>13}{:>11.2f}{:>6.1f} %  {:.1f}{}\n", s.name, s.launches,
                       formatInteger(s.items), s.seconds * 1e3, sum > 0.0 ? 100.0 * s.seconds / sum : 0.0,
                       megaRate(s.items, s.seconds), tracesRays(s.name) ? " rays" : "");
  out += fmt::format("{:<44}{:>11.2f}\n", "all stages", sum * 1e3);
  out += fmt::format("{:<44}{:>11.2f}\n", "outside them: waiting, first-launch compiling",
                     std::max(0.0, stats.time.render - sum) * 1e3);
  const auto& t = stats.time;
  const std::pair<const char*, double> phases[] = {
      {"load", t.load},     {"tree", t.build},  {"compile", t.compile}, {"upload", t.upload},
      {"render", t.render}, {"write", t.write}, {"total", t.total}};
  out += "\n";
  for (const auto& [name, seconds] : phases) out += fmt::format("{:>11}", name);
  out += "\n";
  for (const auto& [name, seconds] : phases) out += fmt::format("{:>9.3f} s", seconds);
  return out + "\n";
}

std::string renderSummary(const Stats& s) {
  std::string out = fmt::format(
      "{}×{}, {}, {}\n", s.settings.width, s.settings.height,
      formatSome(s.scene.triangles, "triangle", "triangles"),
      formatSome(static_cast<std::uint64_t>(s.settings.raysPerPixel), "ray per pixel", "rays per pixel"));
  out += fmt::format("{} rays in {}: {}\n", formatInteger(s.rays.total()), formatSeconds(s.time.render),
                     formatRate(megaRate(s.rays.total(), s.time.render) * 1e6));
  out += fmt::format("{} primary, {} impulse, {} shadow\n", formatInteger(s.rays.primary),
                     formatInteger(s.rays.impulse), formatInteger(s.rays.shadow));
  if (!s.error.empty() && s.error.back().raysPerPixel >= 2)
    out += fmt::format("estimated error {} W/(m² sr)\n", formatReal(s.error.back().estimate));
  if (s.cutOffThroughput > 0.0 && std::isfinite(s.biasBound))
    out += fmt::format(
        "the cut-off took at most {} W/(m² sr) off the mean, which is {}{}\n", formatReal(s.biasBound),
        formatReal(s.meanRadiance),
        s.meanRadiance > 0.0 ? fmt::format(": {} %", formatReal(100.0 * s.biasBound / s.meanRadiance)) : "");
  return out;
}

}  // namespace whittle::cli
