// Tables of a render's statistics; at most 80 columns.
#include "report/profile_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/text.h"

namespace whittle {
namespace {

/// Rows of single bounces end where what is left takes less of all stages' time than this.
constexpr double kShareOfARow = 0.01;
constexpr std::size_t kBarColumns = 41;

double megaRate(std::uint64_t items, double seconds) {
  return seconds > 0.0 ? static_cast<double>(items) / seconds * 1e-6 : 0.0;
}

double sumOfSeconds(const std::vector<StageStats>& stages) {
  double sum = 0.0;
  for (const auto& s : stages) sum += s.seconds;
  return sum;
}

std::string row(const std::string& name, const StageStats& s, double all) {
  return fmt::format("{:<17}{:>8}{:>14} {:<7}{:>10.2f}{:>6.1f} %{:>9.1f}{:>6.1f}\n", name, s.launches,
                     formatInteger(s.items), s.facts.unit, s.seconds * 1e3,
                     all > 0.0 ? 100.0 * s.seconds / all : 0.0, megaRate(s.items, s.seconds),
                     megaRate(s.bytes, s.seconds) * 1e-3);
}

/// The stage in each bounce that launches it, in their order.
std::vector<std::pair<std::uint32_t, StageStats>> bouncesOf(const Stats& stats, const std::string& stage) {
  std::vector<std::pair<std::uint32_t, StageStats>> found;
  for (const auto& b : stats.bounces)
    for (const auto& s : b.stages)
      if (s.facts.name == stage) found.emplace_back(b.bounce, s);
  return found;
}

/// A row for each bounce, and one for the last together where they take little.
std::string bounceRows(const Stats& stats, const std::string& stage, double all) {
  const auto bounces = bouncesOf(stats, stage);
  if (bounces.size() < 2) return "";
  double left = 0.0;
  for (const auto& [number, s] : bounces) left += s.seconds;
  if (left < kShareOfARow * all) return "";
  std::string out;
  for (std::size_t i = 0; i < bounces.size(); ++i) {
    const std::uint32_t number = bounces[i].first;
    StageStats s = bounces[i].second;
    if (i + 1 == bounces.size() || left >= kShareOfARow * all) {
      out += row(fmt::format("  bounce {}", number), s, all);
      left -= s.seconds;
      continue;
    }
    for (std::size_t k = i + 1; k < bounces.size(); ++k) s.add(bounces[k].second);
    return out + row(fmt::format("  bounces {}–{}", number, bounces.back().first), s, all);
  }
  return out;
}

/// Device and wall time, and what is neither.
std::string balance(const Stats& stats, double device) {
  std::uint64_t launches = 0;
  for (const auto& s : stats.stages) launches += s.launches;
  const double wall = stats.time.render, rest = std::max(0.0, wall - device);
  const auto line = [&](const char* name, double seconds, const std::string& note) {
    return fmt::format("{:<46}{:>11.2f}{:>6.1f} %{}\n", name, seconds * 1e3,
                       wall > 0.0 ? 100.0 * seconds / wall : 0.0, note);
  };
  return line("device: all stages", device, "") +
         line("neither: launches, counters, host work", rest,
              launches > 0 ? fmt::format("  {:.0f} µs a launch", rest / static_cast<double>(launches) * 1e6)
                           : "") +
         line("wall: rendering", wall, "");
}

/// Cells [from, to) of a bar of kBarColumns; at least one.
std::string bar(double from, double to) {
  const auto cell = [](double share) {
    return static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(kBarColumns));
  };
  const std::size_t first = std::min(cell(from), kBarColumns - 1);
  const std::size_t last = std::max(first + 1, cell(to));
  std::string out(first, ' ');
  for (std::size_t i = first; i < last; ++i) out += "█";
  return out;
}

/// What the host did when: phases beside each other show as bars above each other.
std::string timeline(const Stats& stats) {
  if (stats.phases.empty()) return "";
  auto phases = stats.phases;
  std::stable_sort(phases.begin(), phases.end(),
                   [](const auto& a, const auto& b) { return a.start < b.start; });
  const double origin = phases.front().start;
  double end = stats.time.total;
  for (const auto& p : phases) end = std::max(end, p.start + p.seconds - origin);
  std::string out = fmt::format("{:<22}{:>8}{:>8}\n", "phase", "from, s", "s");
  for (const auto& p : phases) {
    const double from = p.start - origin;
    out += fmt::format("{:<22}{:>8.3f}{:>8.3f} {}\n", p.name, from, p.seconds,
                       bar(from / end, (from + p.seconds) / end));
  }
  return out + fmt::format("{:<22}{:>8}{:>8.3f}\n", "total", "", stats.time.total);
}

}  // namespace

std::string profileTable(const Stats& stats) {
  const double all = sumOfSeconds(stats.stages);
  std::string out = fmt::format("{:<17}{:>8}{:>14} {:<7}{:>10}{:>8}{:>9}{:>6}\n", "stage", "launches",
                                "items", "", "ms", "share", "M/s", "GB/s");
  auto stages = stats.stages;
  std::stable_sort(stages.begin(), stages.end(),
                   [](const auto& a, const auto& b) { return a.seconds > b.seconds; });
  for (const auto& s : stages) out += row(s.facts.name, s, all) + bounceRows(stats, s.facts.name, all);
  out +=
      "M/s: million items a second. GB/s: queues and film read and written;\ntree, triangles and textures "
      "come on top.\n";
  if (!stats.device.givesTimes)
    out +=
        "This driver gives no times: the host's clock around each launch, which waits for the one before.\n";
  return out + "\n" + balance(stats, all) + "\n" + timeline(stats);
}

namespace {

/// As many as were reached, which a limit or a target makes fewer than were asked for.
std::string raysPerPixel(const Stats& s) {
  if (s.samples.least == s.samples.most) return formatSome(s.samples.most, "ray per pixel", "rays per pixel");
  return fmt::format("{:.1f} rays per pixel ({} to {})", s.samples.mean, formatInteger(s.samples.least),
                     formatInteger(s.samples.most));
}

/// ", 1.2 % of the mean".
std::string shareOfMean(double error, double mean) {
  return mean > 0.0 ? fmt::format(", {} % of the mean", formatReal(100.0 * error / mean)) : "";
}

/// The estimate is that of independent samples: right for random ones, too large for the others.
std::string estimateLine(const Settings& settings, const ErrorPoint& last) {
  if (!std::isfinite(last.estimate))
    return "estimated error unknown: radiance above 1e19 W/(m² sr), whose square no float holds\n";
  return fmt::format("estimated error: {} {} W/(m² sr){}\n",
                     settings.sampler == Sampler::Random ? "about" : "at most about",
                     formatReal(last.estimate), shareOfMean(last.estimate, last.mean));
}

/// The estimate, the true error beside it, and that a target was missed where one was asked for.
std::string errorLines(const Stats& s) {
  const ErrorPoint last = s.error.empty() ? ErrorPoint{} : s.error.back();
  std::string out;
  if (last.raysPerPixel >= 2) out += estimateLine(s.settings, last);
  if (last.rmse)
    out += fmt::format("true error: {} W/(m² sr){}, measured against --reference\n", formatReal(*last.rmse),
                       shareOfMean(*last.rmse, last.mean));
  if (hasErrorTarget(s.settings) && !meetsTarget(s.settings, last))
    out += fmt::format("not the target of {}: {} came first\n", targetText(s.settings),
                       s.samples.mean < s.settings.raysPerPixel && s.settings.timeLimit > 0.0
                           ? "--time-limit"
                           : "--rays-per-pixel");
  return out;
}

/// Who ran, where it was not the scene's own programs alone.
std::string programLine(const Stats& s) {
  if (s.programs.empty() || !s.programs.front().isGeneral) return "";
  if (s.programs.size() == 1) return "on the general programs, without waiting for a compiler\n";
  return fmt::format("on the general programs for {}, then on its own\n",
                     formatSeconds(s.programs.front().seconds));
}

}  // namespace

std::string renderSummary(const Stats& s) {
  std::string out = fmt::format("{}, {}, {}\n", sizeText(s.settings),
                                formatSome(s.scene.triangles, "triangle", "triangles"), raysPerPixel(s));
  out += fmt::format("{} rays in {}: {}\n", formatInteger(s.rays.total()), formatSeconds(s.time.render),
                     formatRate(megaRate(s.rays.total(), s.time.render) * 1e6));
  out += fmt::format("{} primary, {} impulse, {} shadow\n", formatInteger(s.rays.primary),
                     formatInteger(s.rays.impulse), formatInteger(s.rays.shadow));
  out += programLine(s);
  out += errorLines(s);
  if (s.ended.cutOff > 0.0 && std::isfinite(s.biasBound))
    out += fmt::format(
        "rays not followed took at most {} W/(m² sr) off the mean, which is {}{}\n", formatReal(s.biasBound),
        formatReal(s.meanRadiance),
        s.meanRadiance > 0.0 ? fmt::format(": {} %", formatReal(100.0 * s.biasBound / s.meanRadiance)) : "");
  return out;
}

std::vector<std::string> limitNotes(const Stats& s) {
  std::vector<std::string> notes;
  const auto say = [&](const char* option, int limit, double throughput) {
    const double share = throughput / static_cast<double>(s.rays.primary);
    if (share >= kVisibleShare)
      notes.push_back(
          fmt::format("{} % of what rays carry (throughput) ends at {} {}: more of them may show more",
                      formatReal(100.0 * share), option, limit));
  };
  say("--bounces", s.settings.bounces, s.ended.bounces);
  say("--transparent-bounces", s.settings.transparentBounces, s.ended.straight);
  return notes;
}

}  // namespace whittle
