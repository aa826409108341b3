// The rays of a pixel as a foldable list.
#include <fmt/format.h>
#include <imgui.h>

#include <sstream>
#include <string>
#include <vector>

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

constexpr double kSmall = 0.01;  ///< of the pixel's value

/// How the rays are listed: their order, and whether small ones are left out.
void listSwitches(PanelState& state) {
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 8);
  if (ImGui::BeginCombo("##order", state.sortsRays ? "largest first" : "as they part")) {
    if (ImGui::Selectable("as they part", !state.sortsRays)) state.sortsRays = false;
    if (ImGui::Selectable("largest first", state.sortsRays)) state.sortsRays = true;
    ImGui::EndCombo();
  }
  tip("as they part: below each ray those that it sends on, and its share of the pixel's value with theirs; "
      "largest first: all in one list by what each adds itself");
  ImGui::SameLine();
  ImGui::Checkbox("hide small", &state.hidesSmallRays);
  tip("leave out what brings less than 1 % of the pixel's value");
}

/// A pixel's rays on their way into the list.
struct RayList {
  const ViewModel::Explained& rays;
  PanelState& state;
  std::vector<int> firstChild, nextSibling;  ///< -1: none
  int hovered = -1;                          ///< that the mouse is on
  std::size_t hidden = 0;

  explicit RayList(const ViewModel::Explained& e, PanelState& s)
      : rays(e), state(s), firstChild(e.tree.rays.size(), -1), nextSibling(e.tree.rays.size(), -1) {
    for (std::size_t i = e.tree.rays.size(); i-- > 1;) {  // the first child last
      const auto parent = static_cast<std::size_t>(e.tree.rays[i].parent);
      nextSibling[i] = firstChild[parent];
      firstChild[parent] = static_cast<int>(i);
    }
    s.listedRays = 0;
  }

  double shareOf(std::size_t ray) const {
    return state.sortsRays ? rays.shares.own[ray] : rays.shares.below[ray];
  }
  /// Counts it as listed or as hidden. Of a black pixel all rays are shown.
  bool isListed(std::size_t ray) {
    const bool isBlack = rays.shares.own[rays.shares.largestFirst[0]] <= 0.0;
    const bool isHidden = state.hidesSmallRays && !isBlack && shareOf(ray) < kSmall;
    if (!isHidden && state.listedRays == 0) state.firstRay = ray;
    ++(isHidden ? hidden : state.listedRays);
    return !isHidden;
  }
  /// Its heading; true: it is open, until TreePop.
  bool beginRow(std::size_t ray, bool isOpenAtFirst) {
    constexpr auto kWide = ImGuiTreeNodeFlags_SpanAvailWidth;
    const auto flags = kWide | (isOpenAtFirst ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None);
    const std::string title = fmt::format("{:.0f} %  {}", 100 * shareOf(ray), rays.titles[ray]);
    const float room = ImGui::GetContentRegionAvail().x - ImGui::GetTreeNodeToLabelSpacing();
    const bool isOpen = ImGui::TreeNodeEx("##ray", flags, "%s", fitting(title, room).c_str());
    if (ImGui::IsItemHovered()) {
      hovered = static_cast<int>(ray);
      tip(fmt::format("{}: adds {:.1f} % of the pixel's value, {:.1f} % with the rays that it sends on",
                      rays.titles[ray], 100 * rays.shares.own[ray], 100 * rays.shares.below[ray]));
    }
    if (isOpen)
      for (const auto& line : rays.lines[ray]) line.parts ? partingWords(line.text) : wordsWrapped(line.text);
    return isOpen;
  }

  void branch(std::size_t ray) {
    ImGui::PushID(static_cast<int>(ray));
    const bool isOpen = beginRow(ray, rays.shares.leadsToLargest[ray]);
    for (int child = firstChild[ray]; child >= 0; child = nextSibling[static_cast<std::size_t>(child)])
      if (const auto below = static_cast<std::size_t>(child); isOpen && isListed(below)) branch(below);
    if (isOpen) ImGui::TreePop();
    ImGui::PopID();
  }

  void draw() {
    ImGui::PushID(state.sortsRays ? "sorted" : "tree");  // each remembers what is open in it
    if (state.sortsRays) {
      for (const std::size_t ray : rays.shares.largestFirst) {
        if (!isListed(ray)) continue;
        ImGui::PushID(static_cast<int>(ray));
        if (beginRow(ray, ray == rays.shares.largestFirst[0])) ImGui::TreePop();
        ImGui::PopID();
      }
    } else if (isListed(0)) {
      branch(0);
    }
    ImGui::PopID();
    if (hidden > 0) ImGui::TextDisabled("%zu hidden, below 1 %%", hidden);
  }
};

}  // namespace

bool PanelState::has(const std::string& id) { return id == "ray-order" || id == "hide-small-rays"; }

std::string PanelState::set(const std::string& id, const std::string& text) {
  const bool isOrder = id == "ray-order";
  const std::string off = isOrder ? "tree" : "off", on = isOrder ? "share" : "on";
  if (text != off && text != on) return fmt::format("{}: '{}' is not one of {}|{}", id, text, off, on);
  (isOrder ? sortsRays : hidesSmallRays) = text == on;
  return {};
}

int explanationPanel(ViewModel& model, PanelState& state) {
  const ViewModel::Explained* const e = model.explained();
  if (!e) return -1;
  ImGui::Text("pixel %d, %d", e->x, e->y);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::GetFrameHeight());
  if (ImGui::SmallButton("x")) {
    model.closeExplanation();
    return -1;
  }
  wordsWrapped(e->sum);
  referenceSwitch(model);
  if (model.explained() != e) return -1;  // asked for anew
  if (!e->verdict.empty()) e->parts ? partingWords(e->verdict) : wordsWrapped(e->verdict);
  if (e->tree.rays.empty()) return -1;
  listSwitches(state);
  RayList list(*e, state);
  list.draw();
  return list.hovered;
}

}  // namespace whittle::view
