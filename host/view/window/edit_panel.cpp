// Lights and materials to be edited.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "view/window/panels.h"

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

void partRows(ViewModel& model, PanelState& state, Part part, const char* title, const char* none) {
  EditModel& edits = model.edits();
  ImGui::PushID(title);
  ImGui::TextDisabled("%s", title);
  const std::size_t index = edits.chosen(part);
  if (edits.count(part) == 0) {
    ImGui::TextUnformatted(none);
  } else {
    titles(model, part);
    for (const Control& c : edits.controls(part, index))
      if (!c.id.ends_with(".on")) controlRow(model, state, c);  // the list has the switches
    if (index < edits.count(part) && edits.isEdited(part, index) && ImGui::SmallButton("as in the file"))
      edits.reset(part, index);
  }
  ImGui::PopID();
}

}  // namespace

void editPanel(ViewModel& model, PanelState& state) {
  ImGui::SetNextItemOpen(state.showsEdit);
  state.showsEdit = ImGui::CollapsingHeader("Edit");
  if (!state.showsEdit) return;
  EditModel& edits = model.edits();
  partRows(model, state, Part::Light, "lights", "the scene has none");
  partRows(model, state, Part::Material, "materials", "the scene has none");
  ImGui::BeginDisabled(!edits.hasUndo());
  if (ImGui::Button("undo")) edits.undo();
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (ImGui::Button("save scene")) edits.save({});
  tip("a copy of the file beside it, with these lights and materials");
  ImGui::SameLine();
  if (ImGui::Button("copy options")) ImGui::SetClipboardText(model.optionsText().c_str());
  tip(fmt::format("what a file does not hold, as options of whittle render: {}", model.optionsText()));
}

}  // namespace whittle::view
