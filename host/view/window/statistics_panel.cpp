// What a render says of itself, beside its picture.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "report/text.h"
#include "scene/byte_counts.h"
#include "view/window/panels.h"
#include "view/window/style.h"

namespace whittle::view {

void row(const char* label, const std::string& value) {
  ImGui::TextUnformatted(label);
  const float width = ImGui::CalcTextSize(value.c_str()).x;
  ImGui::SameLine(std::max(ImGui::GetCursorPosX(), ImGui::GetWindowContentRegionMax().x - width));
  ImGui::TextUnformatted(value.c_str());
}

namespace {

/// Of the plot below the stages, in lines of text.
constexpr float kLeastPlot = 4, kMostPlot = 7;

/// What it does, and how fast.
std::string tipOf(const StageStats& s) {
  const double rate = s.seconds > 0 ? static_cast<double>(s.items) / s.seconds / 1e6 : 0.0;
  return fmt::format("{}: {}\n{} launches, {} {}, {:.4g} M/s", s.facts.file, s.facts.label, s.launches,
                     formatInteger(s.items), s.facts.unit, rate);
}

/// So many rows leave room for the plot and the headings that follow; some are there in any case.
std::size_t stageRows() {
  constexpr float kLeastRows = 6;
  const float below = 3 * ImGui::GetFrameHeightWithSpacing() + (kLeastPlot + 1) * ImGui::GetTextLineHeight();
  const float fit = (ImGui::GetContentRegionAvail().y - below) / ImGui::GetTextLineHeightWithSpacing();
  return static_cast<std::size_t>(std::max(fit, kLeastRows));
}

/// Time before a bar of its share of the longest.
void stageRow(const std::string& name, double seconds, double most, double all, const std::string& more) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight();
  const auto share = static_cast<float>(seconds / most);
  constexpr ImU32 kFaint = (kSeries[0] & ~IM_COL32_A_MASK) | (90U << IM_COL32_A_SHIFT);
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y - 1}, {at.x + width * share, at.y + height + 2},
                                            kFaint);
  row(name.c_str(), fmt::format("{:.1f} ms  {:.0f} %", 1000 * seconds, 100 * seconds / all));
  if (ImGui::IsMouseHoveringRect(at, {at.x + width, at.y + height}) && ImGui::IsWindowHovered())
    ImGui::SetTooltip("%s", more.c_str());
}

/// Time of each stage, the longest first; where there is no room, of the last ones together.
void stageBars(const Stats& stats) {
  double most = 0, all = 0;
  for (const auto& s : stats.stages) most = std::max(most, s.seconds), all += s.seconds;
  if (!(most > 0)) return;
  std::vector<const StageStats*> stages;
  for (const auto& s : stats.stages) stages.push_back(&s);
  std::stable_sort(stages.begin(), stages.end(),
                   [](const StageStats* a, const StageStats* b) { return a->seconds > b->seconds; });
  const std::size_t rows = stageRows(), alone = stages.size() <= rows ? stages.size() : rows - 1;
  double rest = 0;
  std::string names;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const StageStats& s = *stages[i];
    if (i < alone) {
      stageRow(s.facts.name, s.seconds, most, all, tipOf(s));
      continue;
    }
    rest += s.seconds;
    names += fmt::format("{}{}  {:.1f} ms", names.empty() ? "" : "\n", s.facts.name, 1000 * s.seconds);
  }
  if (!names.empty()) stageRow(fmt::format("{} more", stages.size() - alone), rest, most, all, names);
}

/// Estimated error against time, both logarithmic, with what a random sampler's would fall like.
void errorPlot(const Stats& stats) {
  std::vector<ErrorPoint> points;
  for (const auto& p : stats.error)
    if (p.estimate > 0 && p.seconds > 0) points.push_back(p);
  // As high as there is room above the headings that follow.
  const float width = ImGui::GetContentRegionAvail().x, line = ImGui::GetTextLineHeight();
  const float room = ImGui::GetContentRegionAvail().y - 2 * ImGui::GetFrameHeightWithSpacing();
  const float height = std::clamp(room, kLeastPlot * line, kMostPlot * line);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Dummy({width, height});
  ImDrawList* const draw = ImGui::GetWindowDrawList();
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  draw->AddRect(at, {at.x + width, at.y + height}, ImGui::GetColorU32(ImGuiCol_Border));
  if (points.size() < 2) {
    draw->AddText({at.x + 6, at.y + 4}, ink, "from the second pass on");
    return;
  }
  double x0 = std::log10(points.front().seconds), x1 = std::log10(points.back().seconds);
  double y0 = 1e300, y1 = -1e300;
  for (const auto& p : points) {
    y0 = std::min(y0, std::log10(p.estimate));
    y1 = std::max(y1, std::log10(p.estimate));
  }
  x1 = std::max(x1, x0 + 0.1), y0 -= 0.05, y1 += 0.05;
  const auto place = [&](double seconds, double estimate) {
    return ImVec2(at.x + static_cast<float>((std::log10(seconds) - x0) / (x1 - x0)) * width,
                  at.y + static_cast<float>((y1 - std::log10(estimate)) / (y1 - y0)) * height);
  };
  draw->PushClipRect(at, {at.x + width, at.y + height}, true);
  const auto& first = points.front();
  for (double s = x0; s < x1; s += (x1 - x0) / 24) {  // dashes of slope -1/2
    const double a = std::pow(10, s), b = std::pow(10, s + (x1 - x0) / 48);
    draw->AddLine(place(a, first.estimate * std::sqrt(first.seconds / a)),
                  place(b, first.estimate * std::sqrt(first.seconds / b)), ink);
  }
  for (std::size_t i = 1; i < points.size(); ++i)
    draw->AddLine(place(points[i - 1].seconds, points[i - 1].estimate),
                  place(points[i].seconds, points[i].estimate), kSeries[1], 2);
  for (const auto& p : points) draw->AddCircleFilled(place(p.seconds, p.estimate), 3, kSeries[1]);
  draw->PopClipRect();
  draw->AddText({at.x + 6, at.y + 2}, ink, fmt::format("{:.3g}", std::pow(10, y1)).c_str());
  draw->AddText({at.x + 6, at.y + height - line - 2}, ink,
                fmt::format("{:.3g} W/(m² sr)   {:.3g} s … {:.3g} s", std::pow(10, y0), std::pow(10, x0),
                            std::pow(10, x1))
                    .c_str());
}

void rays(const Stats& stats) {
  row("primary", formatInteger(stats.rays.primary));
  row("impulse", formatInteger(stats.rays.impulse));
  row("shadow", formatInteger(stats.rays.shadow));
  row("total", formatInteger(stats.rays.total()));
  if (stats.time.render > 0)
    row("rays/s", fmt::format("{:.3g} M", static_cast<double>(stats.rays.total()) / stats.time.render / 1e6));
  std::uint64_t launches = 0;
  for (const auto& s : stats.stages) launches += s.launches;
  row("launches", formatInteger(launches));
  row("render time", fmt::format("{:.3f} s", stats.time.render));
}

void buffers(const Stats& stats) {
  std::uint64_t all = 0;
  for (const auto& b : stats.buffers) all += b.bytes;
  row("all buffers", formatBytes(all));
  std::vector<BufferStats> sorted = stats.buffers;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const BufferStats& a, const BufferStats& b) { return a.bytes > b.bytes; });
  for (const auto& b : sorted) row(b.name.c_str(), formatBytes(b.bytes));
}

void features(const Stats& stats) {
  for (const auto& text : stats.featuresUsed) {
    const auto& forced = stats.featuresForced;
    const bool isForced = std::find(forced.begin(), forced.end(), text) != forced.end();
    ImGui::BulletText("%s%s", text.c_str(), isForced ? " (kept)" : "");
  }
  for (const auto& [name, reason] : stats.featuresLeftOut) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetColorU32(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("%s: left out, %s", name.c_str(), reason.c_str());
    ImGui::PopStyleColor();
  }
}

/// All rays are there, and the error that was asked for is not reached.
bool missesTarget(const Stats& stats) {
  const Settings& s = stats.settings;
  if (!hasErrorTarget(s) || stats.error.empty()) return false;
  const ErrorPoint& last = stats.error.back();
  return last.estimate > (s.targetErrorRelative > 0 ? s.targetErrorRelative * last.mean : s.targetError);
}

const char* statusOf(const ViewModel& model, const Stats& stats) {
  if (!model.isFinished()) return "stopped";
  return missesTarget(stats) ? "done; the error takes more rays per pixel" : "done";
}

}  // namespace

void statisticsPanel(const ViewModel& model) {
  const Progress p = model.progress();
  const RenderResult* const result = model.result();
  if (!p.doing.empty()) {
    ImGui::Text("%s", fmt::format("{} … {:.1f} s", p.doing, p.seconds).c_str());
    if (p.share >= 0) ImGui::ProgressBar(static_cast<float>(p.share), {-1, ImGui::GetTextLineHeight()});
  } else if (result) {
    ImGui::TextUnformatted(statusOf(model, result->stats));
  }
  if (!result) return;
  const Stats& stats = result->stats;
  const bool isEnded = hasErrorTarget(stats.settings) || stats.settings.timeLimit > 0;
  row("rays per pixel", fmt::format("{:.4g}{} {}", stats.samples.mean, isEnded ? ", at most" : " of",
                                    stats.settings.raysPerPixel));
  if (!stats.error.empty())
    row("estimated error",
        fmt::format("{:.3g} ({:.2g} %)", stats.error.back().estimate,
                    100 * stats.error.back().estimate / std::max(1e-30, stats.error.back().mean)));
  if (ImGui::CollapsingHeader("Rays", ImGuiTreeNodeFlags_DefaultOpen)) rays(stats);
  if (ImGui::CollapsingHeader("Time by stage", ImGuiTreeNodeFlags_DefaultOpen)) stageBars(stats);
  if (ImGui::CollapsingHeader("Error against time", ImGuiTreeNodeFlags_DefaultOpen)) errorPlot(stats);
  if (ImGui::CollapsingHeader("Memory by buffer")) buffers(stats);
  if (ImGui::CollapsingHeader("Needed and left out")) features(stats);
}

}  // namespace whittle::view
