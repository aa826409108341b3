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
  const float room = ImGui::GetItemRectSize().x - 2 * ImGui::GetStyle().FramePadding.x;
  const bool isCut = ImGui::CalcTextSize(value.c_str()).x > room;
  tip(isCut ? fmt::format("{}\n{}", value, c.tip) : c.tip);
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

}  // namespace

std::string fitting(const std::string& text, float width) {
  if (text.empty() || ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  std::string part = text;
  do {
    part.pop_back();
    while (!part.empty() && (static_cast<unsigned char>(part.back()) & 0xC0) == 0x80) part.pop_back();
  } while (!part.empty() && ImGui::CalcTextSize((part + "…").c_str()).x > width);
  return part + "…";
}

void shortened(const std::string& text, bool isDim) {
  const std::string part = fitting(text, ImGui::GetContentRegionAvail().x);
  isDim ? ImGui::TextDisabled("%s", part.c_str()) : ImGui::TextUnformatted(part.c_str());
  if (part != text) tip(text);
}

void tip(const std::string& text) {
  if (text.empty() || !ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

namespace {

/// By the control's kind.
void valueWidget(ViewModel& model, PanelState& state, const Control& c, const std::string& value) {
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
}

}  // namespace

void controlRow(ViewModel& model, PanelState& state, const Control& c, bool hasPlace) {
  const std::string value = model.value(c.id);
  const bool isWrong = state.problems.contains(c.id);
  ImGui::PushID(c.id.c_str());
  ImGui::AlignTextToFramePadding();
  if (isWrong) ImGui::PushStyleColor(ImGuiCol_Text, kSeries[5]);
  ImGui::TextUnformatted(c.label.c_str());
  if (isWrong) ImGui::PopStyleColor();
  tip(c.tip);
  const float width = ImGui::GetContentRegionAvail().x, reset = ImGui::GetFrameHeight() + 4;
  ImGui::SameLine(width * kLabelShare);
  ImGui::SetNextItemWidth(width * (1 - kLabelShare) - reset);
  valueWidget(model, state, c, value);
  if (value != c.standard) {
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - reset + 4);
    if (ImGui::Button("\u21ba", {ImGui::GetFrameHeight(), 0})) apply(model, state, c, c.standard);
    tip(fmt::format("back to {}", c.standard.empty() ? "the default" : c.standard));
  }
  // The widget may just have mended it.
  if (!hasPlace && isWrong && state.problems.contains(c.id)) {
    ImGui::PushStyleColor(ImGuiCol_Text, kSeries[5]);
    ImGui::TextWrapped("%s", state.problems[c.id].c_str());
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

namespace {

/// Perspective with its angle, or orthographic with its height.
void lensRow(ViewModel& model, float width) {
  const auto height = model.orthographicHeight();
  ImGui::SetNextItemWidth(width * kLabelShare);
  if (ImGui::BeginCombo("##lens", height ? "orthographic" : "perspective")) {
    if (ImGui::Selectable("perspective", !height) && height) model.switchOrthographic();
    if (ImGui::Selectable("orthographic", height.has_value()) && !height) model.switchOrthographic();
    ImGui::EndCombo();
  }
  tip("key 5");
  ImGui::SameLine(0, 4);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  if (height) {
    auto metres = static_cast<float>(*height);
    if (ImGui::DragFloat("##height", &metres, 0.01F * metres, 0, 0, "%.4g m high") && metres > 0)
      model.setOrthographicHeight(static_cast<double>(metres));
    tip("what the picture shows of the scene from its lower edge to its upper one");
  } else {
    auto fov = static_cast<float>(model.fieldOfView());
    if (ImGui::SliderFloat("##fov", &fov, 5, 120, "%.1f° high"))
      model.setFieldOfView(static_cast<double>(fov));
    tip("field of view, from the picture's lower edge to its upper one");
  }
}

}  // namespace

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
  lensRow(model, width);
  if (ImGui::Button("copy")) ImGui::SetClipboardText(model.cameraText().c_str());
  tip(fmt::format("as options of the command line: {}", model.cameraText()));
  ImGui::SameLine();
  if (ImGui::Button("paste"))
    if (const char* const text = ImGui::GetClipboardText()) model.pasteCamera(text);
  tip("a camera from such options");
  ImGui::SameLine();
  if (ImGui::Button("reset")) model.resetCamera();
  tip("the camera of the file");
  ImGui::SameLine();
  if (ImGui::Button("frame all")) model.frameAll();
}

void messageLine(const ViewModel& model) {
  const auto& all = model.messages();
  if (all.empty()) return;
  const auto& last = all.back();
  if (last.isError) ImGui::PushStyleColor(ImGuiCol_Text, kSeries[5]);
  ImGui::TextUnformatted(fitting(last.text, ImGui::GetContentRegionAvail().x).c_str());
  if (last.isError) ImGui::PopStyleColor();
  if (!ImGui::IsItemHovered()) return;
  std::string lines;
  for (std::size_t i = all.size() > 12 ? all.size() - 12 : 0; i < all.size(); ++i)
    lines.append(all[i].text).push_back('\n');
  tip(lines);
}

}  // namespace whittle::view
