// Lights and materials to be edited.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "view/window/panels.h"
#include "view/window/style.h"

namespace whittle::view {
namespace {

constexpr int kShownRows = 5;  ///< of a list, before it scrolls

/// The titles, and before those of lights their switches.
void titles(ViewModel& model, Part part) {
  EditModel& edits = model.edits();
  const int count = static_cast<int>(edits.count(part));
  const bool hasSwitches = part == Part::Light;
  const float row = hasSwitches ? ImGui::GetFrameHeightWithSpacing() : ImGui::GetTextLineHeightWithSpacing();
  const float height =
      row * static_cast<float>(std::min(count, kShownRows)) + ImGui::GetStyle().FramePadding.y * 2;
  if (!ImGui::BeginListBox("##list", {ImGui::GetContentRegionAvail().x, height})) return;
  ImGuiListClipper clipper;
  clipper.Begin(count, row);
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const auto index = static_cast<std::size_t>(i);
      ImGui::PushID(i);
      if (hasSwitches) {
        const std::string id = fmt::format("light.{}.on", i);
        bool isOn = model.value(id) == "on";
        if (ImGui::Checkbox("##on", &isOn)) model.set(id, isOn ? "on" : "off");
        ImGui::SameLine();
        ImGui::AlignTextToFramePadding();
      }
      const std::string title =
          fmt::format("{}{}", edits.isEdited(part, index) ? "* " : "", edits.title(part, index));
      if (ImGui::Selectable(title.c_str(), edits.chosen(part) == index)) edits.choose(part, index);
      tip(title);
      ImGui::PopID();
    }
  ImGui::EndListBox();
}

/// What the list is of, what is wrong with a value below, and the way back: in a line that is always there,
/// so that nothing below it jumps. True: back to the file.
bool heading(const char* title, const std::string& problem, bool isEdited) {
  const char* const back = "as in the file";
  const ImGuiStyle& style = ImGui::GetStyle();
  const float button = ImGui::CalcTextSize(back).x + 2 * style.FramePadding.x;
  const float end = ImGui::GetContentRegionMax().x - button;
  ImGui::TextDisabled("%s", title);
  ImGui::SameLine();
  const std::string shown = fitting(problem, end - ImGui::GetCursorPosX() - style.ItemSpacing.x);
  ImGui::PushStyleColor(ImGuiCol_Text, kSeries[5]);
  ImGui::TextUnformatted(shown.c_str());
  ImGui::PopStyleColor();
  tip(problem);
  ImGui::SameLine(end);
  ImGui::BeginDisabled(!isEdited);
  const bool isPressed = ImGui::SmallButton(back);
  ImGui::EndDisabled();
  return isPressed;
}

void partRows(ViewModel& model, PanelState& state, Part part, const char* title, const char* none) {
  EditModel& edits = model.edits();
  const std::size_t index = edits.chosen(part);
  const auto controls = edits.controls(part, index);
  std::string problem;
  for (const Control& c : controls)
    if (const auto wrong = state.problems.find(c.id); wrong != state.problems.end()) problem = wrong->second;
  ImGui::PushID(title);
  if (heading(title, problem, index < edits.count(part) && edits.isEdited(part, index))) {
    edits.reset(part, index);
    for (const Control& c : controls) state.problems.erase(c.id);
  }
  if (edits.count(part) == 0)
    ImGui::TextUnformatted(none);
  else
    titles(model, part);
  for (const Control& c : controls)
    if (!c.id.ends_with(".on")) controlRow(model, state, c, true);  // the list has the switches
  ImGui::PopID();
}

}  // namespace

void editPanel(ViewModel& model, PanelState& state) {
  ImGui::SetNextItemOpen(state.showsEdit);
  state.showsEdit = ImGui::CollapsingHeader("Edit");
  if (!state.showsEdit) return;
  EditModel& edits = model.edits();
  ImGui::BeginDisabled(!edits.hasUndo());
  if (ImGui::Button("undo")) edits.undo();
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (ImGui::Button("save scene")) edits.save({});
  tip("a copy of the file beside it, with these lights and materials");
  ImGui::SameLine();
  if (ImGui::Button("copy options")) ImGui::SetClipboardText(model.optionsText().c_str());
  tip(fmt::format("what a file does not hold, as options of whittle render: {}", model.optionsText()));
  partRows(model, state, Part::Light, "lights", "the scene has none");
  partRows(model, state, Part::Material, "materials", "the scene has none");
}

}  // namespace whittle::view
