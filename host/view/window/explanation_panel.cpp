// The rays of a pixel as a foldable list.
#include <fmt/format.h>
#include <imgui.h>

#include <sstream>

#include "view/window/panels.h"
#include "view/window/style.h"

namespace whittle::view {
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

/// What the reference has otherwise.
void partingWords(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, kSeries[5]);
  wordsWrapped(text);
  ImGui::PopStyleColor();
}

/// Asks for the double-precision reference's rays beside the kernels'.
void referenceSwitch(ViewModel& model) {
  bool compares = model.value(kReferenceSwitch) == "on";
  if (ImGui::Checkbox("reference", &compares)) model.set(kReferenceSwitch, compares ? "on" : "off");
  tip("the same rays in double precision: what they have otherwise stands below each line");
}

/// The ray and its children, and which the mouse is on.
void rayRow(const ViewModel::Explained& e, std::size_t ray, int& hovered) {
  const ImGuiTreeNodeFlags flags =
      ImGuiTreeNodeFlags_SpanAvailWidth | (ray < 4 ? ImGuiTreeNodeFlags_DefaultOpen : 0);
  ImGui::PushID(static_cast<int>(ray));
  const bool isOpen = ImGui::TreeNodeEx("##ray", flags, "%s", e.titles[ray].c_str());
  if (ImGui::IsItemHovered()) hovered = static_cast<int>(ray);
  if (isOpen) {
    for (const auto& line : e.lines[ray]) line.parts ? partingWords(line.text) : wordsWrapped(line.text);
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
  referenceSwitch(model);
  if (model.explained() != e) return hovered;  // asked for anew
  if (!e->verdict.empty()) e->parts ? partingWords(e->verdict) : wordsWrapped(e->verdict);
  if (!e->tree.rays.empty()) rayRow(*e, 0, hovered);
  return hovered;
}

}  // namespace whittle::view
