// Settings, camera, messages and help. See panels.h.
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
  const auto caption = [&](std::size_t i) { return c.captions.empty() ? c.words[i] : c.captions[i]; };
  const auto chosen =
      static_cast<std::size_t>(std::find(c.words.begin(), c.words.end(), value) - c.words.begin());
  if (ImGui::BeginCombo("##value", chosen < c.words.size() ? caption(chosen).c_str() : value.c_str())) {
    for (std::size_t i = 0; i < c.words.size(); ++i)
      if (ImGui::Selectable(caption(i).c_str(), i == chosen)) apply(model, state, c, c.words[i]);
    ImGui::EndCombo();
  }
  tip(c.tip);
}

void slider(ViewModel& model, PanelState& state, const Control& c, const std::string& value) {
  float share = std::strtof(value.c_str(), nullptr);
  if (ImGui::SliderFloat("##value", &share, 0, 1, "%.3g", ImGuiSliderFlags_AlwaysClamp))
    apply(model, state, c, fmt::format("{:.4g}", share));
  tip(c.tip);
}

/// A drag changes it by parts of itself; a double click takes a number.
void amount(ViewModel& model, PanelState& state, const Control& c, const std::string& value) {
  float number = std::strtof(value.c_str(), nullptr);
  const float speed = std::max(0.01F * std::abs(number), 1e-3F);
  if (ImGui::DragFloat("##value", &number, speed, 0, 0, "%.5g"))
    apply(model, state, c, fmt::format("{:.6g}", number));
  tip(c.tip);
}

/// Half a degree for each pixel of a drag.
void angle(ViewModel& model, PanelState& state, const Control& c, const std::string& value) {
  float number = std::strtof(value.c_str(), nullptr);
  if (ImGui::DragFloat("##value", &number, 0.5F, 0, 0, "%.5g"))
    apply(model, state, c, fmt::format("{:.6g}", number));
  tip(c.tip);
}

void colorField(ViewModel& model, PanelState& state, const Control& c, const std::string& value) {
  std::array<float, 3> rgb{};
  std::istringstream in(value);
  for (float& channel : rgb) in >> channel, in.ignore(1, ',');
  constexpr auto kFlags = ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_Float;
  if (ImGui::ColorEdit3("##value", rgb.data(), kFlags))
    apply(model, state, c, fmt::format("{:.4g},{:.4g},{:.4g}", rgb[0], rgb[1], rgb[2]));
  tip(c.tip);
  ImGui::SameLine();
  ImGui::TextDisabled("%.2g %.2g %.2g", static_cast<double>(rgb[0]), static_cast<double>(rgb[1]),
                      static_cast<double>(rgb[2]));
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
    {"K", "keep the picture as the reference"},
    {"V, B, M", "the reference beside a line, in the picture's place, the difference"},
    {"Space", "the reference while it is held"},
    {"Ctrl+B, then drag", "render a region alone; Ctrl+B or Esc: all"},
    {"Ctrl+C, Ctrl+V", "camera as command-line options"},
    {"X", "lights and materials; drag a light's handle"},
    {"Ctrl+Z", "undo the last edit of them"},
    {"F12, Ctrl+S", "save .png and .exr"},
    {"Ctrl+R", "read the file again"},
    {"Esc", "stop refining"},
    {"Tab", "panels away, and back"},
    {"L", "light, dark"},
    {"H, ?", "this help"},
    {"Ctrl+Q", "quit"},
};

}  // namespace

void tip(const std::string& text) {
  if (text.empty() || !ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
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
    case Control::Kind::Share:
      slider(model, state, c, value);
      break;
    case Control::Kind::Amount:
      amount(model, state, c, value);
      break;
    case Control::Kind::Angle:
      angle(model, state, c, value);
      break;
    case Control::Kind::Color:
      colorField(model, state, c, value);
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

void filePanel(ViewModel& model, PanelState& state) {
  if (!ImGui::CollapsingHeader("File", ImGuiTreeNodeFlags_DefaultOpen)) return;
  const float width = ImGui::GetContentRegionAvail().x, button = ImGui::GetFrameHeight();
  std::array<char, 1024> text{};
  std::strncpy(text.data(), state.fileText.c_str(), text.size() - 1);
  ImGui::SetNextItemWidth(width - button - 4);
  const bool entered = ImGui::InputTextWithHint("##file", "a file to open, then Enter", text.data(),
                                                text.size(), ImGuiInputTextFlags_EnterReturnsTrue);
  tip(".glb, .gltf: a scene; .hdr, .exr: what surrounds it. Or drop one on the window.");
  state.fileText = text.data();
  const auto open = [&](const std::filesystem::path& file) {
    model.open(file);
    state.fileText.clear();
  };
  if (entered && !state.fileText.empty()) open(state.fileText);
  ImGui::SameLine(0, 4);
  if (ImGui::BeginCombo("##recent", "", ImGuiComboFlags_NoPreview | ImGuiComboFlags_PopupAlignLeft)) {
    const auto files = model.recentFiles();
    if (files.empty()) ImGui::TextDisabled("no file was opened yet");
    for (const auto& file : files) {
      if (ImGui::Selectable(file.filename().c_str())) open(file);
      tip(file.string());
    }
    ImGui::EndCombo();
  }
  tip("recent files");
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
    ImGui::TextDisabled(
        "Drop a .glb, .gltf, .hdr or .exr on the window to open it, with Shift to compare with it.");
  }
  ImGui::End();
}

}  // namespace whittle::view
