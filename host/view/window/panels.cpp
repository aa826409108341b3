// See panels.h.
#include "view/window/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "view/window/style.h"

namespace whittle::view {
namespace {

/// Of a row.
constexpr float kLabelShare = 0.47F;

void tip(const std::string& text) {
  if (text.empty() || !ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void apply(ViewModel& model, PanelState& state, const Control& c, const std::string& text) {
  const std::string problem = model.set(c.id, text);
  if (problem.empty())
    state.problems.erase(c.id);
  else
    state.problems[c.id] = problem;
}

/// A field of text that takes effect with Enter, or when it is left.
void textField(ViewModel& model, PanelState& state, const Control& c, const std::string& value) {
  std::array<char, 512> text{};
  const auto under = state.edited.find(c.id);
  const std::string& shown = under != state.edited.end() ? under->second : value;
  std::strncpy(text.data(), shown.c_str(), text.size() - 1);
  const bool entered =
      ImGui::InputText("##value", text.data(), text.size(),
                       ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  tip(c.tip);
  if (ImGui::IsItemActive()) state.edited[c.id] = text.data();
  if (entered || ImGui::IsItemDeactivatedAfterEdit()) {
    if (text.data() != value) apply(model, state, c, text.data());
    state.edited.erase(c.id);
  } else if (!ImGui::IsItemActive()) {
    state.edited.erase(c.id);
  }
}

void wholeField(ViewModel& model, PanelState& state, const Control& c, const std::string& value) {
  const float button = ImGui::GetFrameHeight();
  ImGui::SetNextItemWidth(ImGui::CalcItemWidth() - 2 * (button + 2));
  textField(model, state, c, value);
  const long now = std::strtol(value.c_str(), nullptr, 10);
  for (const int by : {-1, 1}) {
    ImGui::SameLine(0, 2);
    if (ImGui::Button(by < 0 ? "-" : "+", {button, 0})) apply(model, state, c, std::to_string(now + by));
    tip(c.tip);
  }
}

void choice(ViewModel& model, PanelState& state, const Control& c, const std::string& value) {
  if (ImGui::BeginCombo("##value", value.c_str())) {
    for (const auto& word : c.words)
      if (ImGui::Selectable(word.c_str(), word == value)) apply(model, state, c, word);
    ImGui::EndCombo();
  }
  tip(c.tip);
}

void controlRow(ViewModel& model, PanelState& state, const Control& c) {
  const std::string value = model.value(c.id);
  ImGui::PushID(c.id.c_str());
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(c.label.c_str());
  tip(c.tip);
  const float width = ImGui::GetContentRegionAvail().x, reset = ImGui::GetFrameHeight() + 4;
  ImGui::SameLine(width * kLabelShare);
  ImGui::SetNextItemWidth(width * (1 - kLabelShare) - reset);
  switch (c.kind) {
    case Control::Kind::Switch: {
      bool on = value == "on";
      if (ImGui::Checkbox("##value", &on)) apply(model, state, c, on ? "on" : "off");
      tip(c.tip);
      break;
    }
    case Control::Kind::Whole:
      wholeField(model, state, c, value);
      break;
    case Control::Kind::Choice:
      choice(model, state, c, value);
      break;
    case Control::Kind::Real:
    case Control::Kind::Text:
      textField(model, state, c, value);
      break;
  }
  if (value != c.standard) {
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - reset + 4);
    if (ImGui::Button("\u21ba", {ImGui::GetFrameHeight(), 0})) apply(model, state, c, c.standard);
    tip(fmt::format("back to {}", c.standard.empty() ? "the default" : c.standard));
  }
  const auto problem = state.problems.find(c.id);
  if (problem != state.problems.end()) {
    ImGui::PushStyleColor(ImGuiCol_Text, kSeries[5]);
    ImGui::TextWrapped("%s", problem->second.c_str());
    ImGui::PopStyleColor();
  }
  if (!c.remark.empty()) ImGui::TextDisabled("%s", c.remark.c_str());
  ImGui::PopID();
}

std::string thousands(std::uint64_t n) {
  std::string digits = std::to_string(n);
  for (std::ptrdiff_t i = static_cast<std::ptrdiff_t>(digits.size()) - 3; i > 0; i -= 3)
    digits.insert(static_cast<std::size_t>(i), 1, ',');
  return digits;
}

std::string bytesText(std::uint64_t n) {
  const char* const units[] = {"B", "kB", "MB", "GB"};
  double value = static_cast<double>(n);
  int unit = 0;
  while (value >= 999.5 && unit < 3) value /= 1000, ++unit;
  return unit == 0 ? fmt::format("{} B", n) : fmt::format("{:.3g} {}", value, units[unit]);
}

void row(const char* label, const std::string& value) {
  ImGui::TextUnformatted(label);
  const float width = ImGui::CalcTextSize(value.c_str()).x;
  ImGui::SameLine(std::max(ImGui::GetCursorPosX(), ImGui::GetWindowContentRegionMax().x - width));
  ImGui::TextUnformatted(value.c_str());
}

/// Time of each stage as a bar of the longest.
void stageBars(const Stats& stats) {
  double most = 0, all = 0;
  for (const auto& s : stats.stages) most = std::max(most, s.seconds), all += s.seconds;
  if (!(most > 0)) return;
  std::vector<const StageStats*> stages;
  for (const auto& s : stats.stages) stages.push_back(&s);
  std::stable_sort(stages.begin(), stages.end(),
                   [](const StageStats* a, const StageStats* b) { return a->seconds > b->seconds; });
  for (const StageStats* s : stages) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight();
    const auto share = static_cast<float>(s->seconds / most);
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + height + 1},
                                              {at.x + width * share, at.y + height + 4}, kSeries[0]);
    row(s->facts.name, fmt::format("{:.1f} ms  {:.0f} %", 1000 * s->seconds, 100 * s->seconds / all));
    if (ImGui::IsItemHovered())
      tip(fmt::format("{} launches, {} {}, {:.4g} M/s", s->launches, thousands(s->items), s->facts.unit,
                      s->seconds > 0 ? static_cast<double>(s->items) / s->seconds / 1e6 : 0.0));
    ImGui::Dummy({0, 3});
  }
}

/// Estimated error against time, both logarithmic, with what a random sampler's would fall like.
void errorPlot(const Stats& stats) {
  std::vector<ErrorPoint> points;
  for (const auto& p : stats.error)
    if (p.estimate > 0 && p.seconds > 0) points.push_back(p);
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight() * 7;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Dummy({width, height});
  ImDrawList* const draw = ImGui::GetWindowDrawList();
  const ImU32 line = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  draw->AddRect(at, {at.x + width, at.y + height}, ImGui::GetColorU32(ImGuiCol_Border));
  if (points.size() < 2) {
    draw->AddText({at.x + 6, at.y + 4}, line, "from the second pass on");
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
                  place(b, first.estimate * std::sqrt(first.seconds / b)), line);
  }
  for (std::size_t i = 1; i < points.size(); ++i)
    draw->AddLine(place(points[i - 1].seconds, points[i - 1].estimate),
                  place(points[i].seconds, points[i].estimate), kSeries[1], 2);
  for (const auto& p : points) draw->AddCircleFilled(place(p.seconds, p.estimate), 3, kSeries[1]);
  draw->PopClipRect();
  draw->AddText({at.x + 6, at.y + 2}, line, fmt::format("{:.3g}", std::pow(10, y1)).c_str());
  draw->AddText({at.x + 6, at.y + height - ImGui::GetTextLineHeight() - 2}, line,
                fmt::format("{:.3g} W/(m² sr)   {:.3g} s … {:.3g} s", std::pow(10, y0), std::pow(10, x0),
                            std::pow(10, x1))
                    .c_str());
}

void rays(const Stats& stats) {
  row("primary", thousands(stats.rays.primary));
  row("impulse", thousands(stats.rays.impulse));
  row("shadow", thousands(stats.rays.shadow));
  row("total", thousands(stats.rays.total()));
  if (stats.time.render > 0)
    row("rays/s", fmt::format("{:.3g} M", static_cast<double>(stats.rays.total()) / stats.time.render / 1e6));
  std::uint64_t launches = 0;
  for (const auto& s : stats.stages) launches += s.launches;
  row("launches", thousands(launches));
  row("render time", fmt::format("{:.3f} s", stats.time.render));
}

void buffers(const Stats& stats) {
  std::uint64_t all = 0;
  for (const auto& b : stats.buffers) all += b.bytes;
  row("all buffers", bytesText(all));
  std::vector<BufferStats> sorted = stats.buffers;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const BufferStats& a, const BufferStats& b) { return a.bytes > b.bytes; });
  for (const auto& b : sorted) row(b.name.c_str(), bytesText(b.bytes));
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

constexpr const char* kKeys[][2] = {
    {"left drag", "orbit about what is under the mouse"},
    {"middle drag, Shift + left", "pan"},
    {"click", "the rays of a pixel: a list, and lines over the picture"},
    {"wheel", "zoom towards what is under the mouse"},
    {"right drag", "look around"},
    {"W A S D, Q E", "fly; down, up"},
    {"R, Home", "the camera of the file"},
    {"F", "frame all"},
    {"1  3  7", "from the front, from the right, from above"},
    {"5", "orthographic, and back"},
    {"Ctrl+C, Ctrl+V", "camera as command-line options"},
    {"F12, Ctrl+S", "save .png and .exr"},
    {"Ctrl+R", "read the file again"},
    {"Esc", "stop refining"},
    {"Tab", "panels away, and back"},
    {"L", "light, dark"},
    {"H, ?", "this help"},
    {"Ctrl+Q", "quit"},
};

}  // namespace

void settingsPanel(ViewModel& model, PanelState& state) {
  std::string group;
  bool isOpen = true;
  for (const Control& c : model.controls()) {
    if (c.group != group) {
      group = c.group;
      isOpen = ImGui::CollapsingHeader(group.c_str(), ImGuiTreeNodeFlags_DefaultOpen);
    }
    if (isOpen) controlRow(model, state, c);
  }
}

void cameraPanel(ViewModel& model) {
  if (!ImGui::CollapsingHeader("Camera", ImGuiTreeNodeFlags_DefaultOpen)) return;
  const auto names = model.cameras();
  const std::string now = model.value("camera");
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::SetNextItemWidth(width);
  const auto chosen = static_cast<std::size_t>(std::strtoul(now.c_str(), nullptr, 10));
  if (!names.empty() && ImGui::BeginCombo("##camera", names[std::min(chosen, names.size() - 1)].c_str())) {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (ImGui::Selectable(names[i].c_str(), std::to_string(i) == now)) model.chooseCamera(i);
    ImGui::EndCombo();
  }
  auto fov = static_cast<float>(model.fieldOfView());
  ImGui::SetNextItemWidth(width);
  if (ImGui::SliderFloat("##fov", &fov, 5, 120, "field of view %.1f°"))
    model.setFieldOfView(static_cast<double>(fov));
  if (ImGui::Button("copy")) ImGui::SetClipboardText(model.cameraText().c_str());
  tip(fmt::format("as options of the command line: {}", model.cameraText()));
  ImGui::SameLine();
  if (ImGui::Button("reset")) model.resetCamera();
  ImGui::SameLine();
  if (ImGui::Button("frame all")) model.frameAll();
}

void statisticsPanel(const ViewModel& model) {
  const Progress p = model.progress();
  const RenderResult* const result = model.result();
  if (!p.doing.empty()) {
    ImGui::Text("%s", fmt::format("{} … {:.1f} s", p.doing, p.seconds).c_str());
    if (p.share >= 0) ImGui::ProgressBar(static_cast<float>(p.share), {-1, ImGui::GetTextLineHeight()});
  } else if (result) {
    ImGui::TextUnformatted(model.isFinished() ? "done" : "stopped");
  }
  if (!result) return;
  const Stats& stats = result->stats;
  row("rays per pixel", fmt::format("{:.4g} of {}", stats.samples.mean, stats.settings.raysPerPixel));
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

namespace {

/// ImGui breaks lines at the points of numbers; this breaks at blanks alone.
void wordsWrapped(const std::string& text) {
  const float room = ImGui::GetContentRegionAvail().x;
  std::string line;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = line.empty() ? word : fmt::format("{} {}", line, word);
    if (!line.empty() && ImGui::CalcTextSize(longer.c_str()).x > room) {
      ImGui::TextUnformatted(line.c_str());
      line = fmt::format("  {}", word);
    } else {
      line = longer;
    }
  }
  ImGui::TextUnformatted(line.c_str());
}

/// The ray and its children, and which the mouse is on.
void rayRow(const ViewModel::Explained& e, std::size_t ray, int& hovered) {
  const ImGuiTreeNodeFlags flags =
      ImGuiTreeNodeFlags_SpanAvailWidth | (ray < 4 ? ImGuiTreeNodeFlags_DefaultOpen : 0);
  ImGui::PushID(static_cast<int>(ray));
  const bool isOpen = ImGui::TreeNodeEx("##ray", flags, "%s", e.titles[ray].c_str());
  if (ImGui::IsItemHovered()) hovered = static_cast<int>(ray);
  if (isOpen) {
    for (const auto& line : e.lines[ray]) wordsWrapped(line);
    for (std::size_t child = ray + 1; child < e.tree.rays.size(); ++child)
      if (e.tree.rays[child].parent == static_cast<int>(ray)) rayRow(e, child, hovered);
    ImGui::TreePop();
  }
  ImGui::PopID();
}

}  // namespace

int explanationPanel(ViewModel& model) {
  const ViewModel::Explained* const e = model.explained();
  int hovered = -1;
  if (!e) return hovered;
  ImGui::Text("pixel %d, %d", e->x, e->y);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::GetFrameHeight());
  if (ImGui::SmallButton("x")) {
    model.closeExplanation();
    return hovered;
  }
  wordsWrapped(e->sum);
  if (!e->tree.rays.empty()) rayRow(*e, 0, hovered);
  return hovered;
}

void messageLine(const ViewModel& model) {
  const auto& all = model.messages();
  if (all.empty()) return;
  const auto& last = all.back();
  if (last.isError) ImGui::PushStyleColor(ImGuiCol_Text, kSeries[5]);
  ImGui::TextUnformatted(last.text.c_str());
  if (last.isError) ImGui::PopStyleColor();
  if (!ImGui::IsItemHovered()) return;
  std::string lines;
  for (std::size_t i = all.size() > 12 ? all.size() - 12 : 0; i < all.size(); ++i)
    lines.append(all[i].text).push_back('\n');
  tip(lines);
}

void helpWindow(PanelState& state) {
  if (!state.showsHelp) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowBgAlpha(0.97F);
  if (ImGui::Begin(
          "Keys and mouse", &state.showsHelp,
          ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove)) {
    if (ImGui::BeginTable("keys", 2)) {
      for (const auto& [keys, what] : kKeys) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(keys);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(what);
      }
      ImGui::EndTable();
    }
    ImGui::TextDisabled("Drop a .glb, .gltf, .hdr or .exr on the window to open it. Each setting has a tip.");
  }
  ImGui::End();
}

}  // namespace whittle::view
