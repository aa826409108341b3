// What stands where in the window: panels beside the picture, the line below it.
#include <algorithm>

#include "view/window/window.h"

namespace whittle::view {
namespace {

/// Of the panels, in the font's units.
constexpr float kSettingsWidth = 288, kStatisticsWidth = 300, kLineHeight = 28;
/// Of the picture, so that a panel may stand beside it.
constexpr float kLeastPicture = 120;
constexpr auto kFixed = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                        ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoBringToFrontOnFocus;

template <typename Content>
void panel(const char* name, ImVec2 at, ImVec2 size, const Content& content) {
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, IM_COL32_BLACK_TRANS);  // see Window::clear
  const bool isShown = ImGui::Begin(name, nullptr, kFixed);
  ImGui::PopStyleColor();
  if (isShown) content();
  ImGui::End();
}

}  // namespace

/// Both panels, or where the window is too narrow for them one with tabs, or none.
void Window::drawPanels(float width, float height) {
  const float unit = ImGui::GetFontSize() / 15, line = kLineHeight * unit;
  const auto fits = [&](float panels) { return width > (panels + kLeastPicture) * unit; };
  const bool isTall = height > 4 * line;
  panelsShown_ = 0;
  if (panels_.showsPanels && isTall)
    panelsShown_ = fits(kSettingsWidth + kStatisticsWidth) ? 2 : fits(kStatisticsWidth) ? 1 : 0;
  const float left = panelsShown_ == 2   ? kSettingsWidth * unit
                     : panelsShown_ == 1 ? kStatisticsWidth * unit
                                         : 0;
  const float right = panelsShown_ == 2 ? kStatisticsWidth * unit : 0;
  ground_ = {left, 0, std::max(1.0F, width - left - right), std::max(1.0F, height - line)};
  picture_ = pictureRect(ground_.x, ground_.y, ground_.width, ground_.height);
  drawPicture();
  drawScales();
  drawRegion();
  drawRays(hoveredRay_);
  drawHandles();
  const float tall = height - line;
  if (panelsShown_ == 2) {
    panel("settings", {0, 0}, {left, tall}, [&] { leftPanel(); });
    panel("statistics", {width - right, 0}, {right, tall}, [&] { rightPanel(); });
  }
  if (panelsShown_ == 1)
    panel("settings and statistics", {0, 0}, {left, tall}, [&] {
      const bool isAsked = model_.explained() && !panels_.hadRays;  // a pixel was clicked
      panels_.hadRays = model_.explained() != nullptr;
      if (!ImGui::BeginTabBar("tabs")) return;
      if (ImGui::BeginTabItem("Settings")) leftPanel(), ImGui::EndTabItem();
      const auto flags = isAsked ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None;
      if (ImGui::BeginTabItem("Statistics", nullptr, flags)) rightPanel(), ImGui::EndTabItem();
      ImGui::EndTabBar();
    });
  if (height > line) panel("messages", {0, height - line}, {width, line}, [&] { bottomLine(line); });
  helpWindow(panels_);
}

void Window::leftPanel() {
  filePanel(model_, panels_);
  cameraPanel(model_);
  editPanel(model_, panels_);
  settingsPanel(model_, panels_);
}

void Window::rightPanel() {
  hoveredRay_ = -1;
  if (model_.explained())
    hoveredRay_ = explanationPanel(model_, panels_);
  else
    comparePanel(model_), statisticsPanel(model_);
  statisticsCut_ = ImGui::GetScrollMaxY();
}

void Window::bottomLine(float height) {
  ImGui::SetCursorPosY((height - ImGui::GetTextLineHeight()) / 2);
  if (ImGui::SmallButton("H: help")) panels_.showsHelp = !panels_.showsHelp;
  ImGui::SameLine();
  scaleButtons();
  ImGui::SameLine(0, ImGui::GetFontSize());
  if (!panels_.showsPanels || panelsShown_ > 0) return messageLine(model_);
  shortened("too small for panels", true);
  tip("a larger window, or smaller letters (Ctrl and -), would have room for them");
}

}  // namespace whittle::view
