// The reference in the window: left and right of a line, in the picture's place, or the difference with its
// legend.
#include <fmt/format.h>
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

#include "view/window/window.h"

namespace whittle::view {
namespace {

/// How near to the line the mouse has it, pixels.
constexpr float kReach = 6;
/// Of the legend: a title, the colours, numbers; in lines of text.
constexpr float kLegendLines = 3.6F;
constexpr float kLegendWidth = 460;

std::string legendTitle(const CompareView& c) {
  if (c.isRelative)
    return fmt::format("relative error of {}: a share of the reference; 0 is black",
                       c.isOfCodes ? "the codes' linear light" : "radiance");
  return c.isOfCodes ? "absolute error of the codes' linear light, 1 is white; 0 is black"
                     : "absolute error of radiance, W/(m² sr); 0 is black";
}

}  // namespace

void Window::switchCompare(CompareMode mode) {
  const bool isOn = model_.compared().mode == mode;
  const std::string problem = model_.set("compare", kCompareModes[isOn ? 0 : static_cast<std::size_t>(mode)]);
  if (problem.empty())
    panels_.problems.erase("compare");
  else
    panels_.problems["compare"] = problem;
}

bool Window::compareShortcut(int key) {
  if (key == 'K') model_.keepReference();
  if (key == 'B') switchCompare(CompareMode::Flip);
  if (key == 'V') switchCompare(CompareMode::Split);
  if (key == 'M') switchCompare(CompareMode::Difference);
  return key == 'K' || key == 'B' || key == 'V' || key == 'M';
}

const Picture* Window::pictureBeside() const {
  const CompareView& c = model_.compared();
  const bool isHeld = heldKeys_.contains(GLFW_KEY_SPACE);
  if (c.mode == CompareMode::Off && !isHeld) return nullptr;
  const bool isDifference = c.mode == CompareMode::Difference && !isHeld;
  if (isDifference && model_.picture().coarse) return nullptr;  // the camera moves
  const Picture& beside = isDifference ? c.difference : c.reference;
  return beside.serial > 0 ? &beside : nullptr;
}

bool Window::isSplit() const {
  return model_.compared().mode == CompareMode::Split && !heldKeys_.contains(GLFW_KEY_SPACE) &&
         pictureBeside();
}

/// Between two pixels of the picture, as a share of its width.
float Window::splitPlace() const {
  const auto width = static_cast<double>(widthOfModel());
  return static_cast<float>(std::round(model_.compared().split * width) / width);
}

bool Window::slidesSplit() {
  const ImGuiIO& io = ImGui::GetIO();
  if (!isSplit()) return isSliding_ = false;
  const float line = picture_.x + splitPlace() * picture_.width;
  const bool isNear = std::abs(io.MousePos.x - line) <= kReach && io.MousePos.y >= picture_.y - kReach &&
                      io.MousePos.y <= picture_.y + picture_.height + kReach && !io.WantCaptureMouse;
  if (isNear || isSliding_) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (isNear && ImGui::IsMouseClicked(0)) isSliding_ = true;
  if (!isSliding_) return false;
  const double at = std::clamp(static_cast<double>(inPicture(io.MousePos).x), 0.0, 1.0);
  model_.set("compare-split", fmt::format("{:.6f}", at));
  if (ImGui::IsMouseReleased(0)) isSliding_ = false;
  return true;
}

void Window::drawSplit() {
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const float x = picture_.x + splitPlace() * picture_.width, top = picture_.y,
              bottom = top + picture_.height;
  draw.AddRectFilled({x - 1, top}, {x, bottom}, IM_COL32(0, 0, 0, 200));
  draw.AddRectFilled({x, top}, {x + 1, bottom}, IM_COL32(255, 255, 255, 200));
  const ImU32 grip = ImGui::GetColorU32(ImGuiCol_Text);
  draw.AddTriangleFilled({x - 6, top - 10}, {x + 6, top - 10}, {x, top - 1}, grip);
  draw.AddTriangleFilled({x, bottom + 1}, {x + 6, bottom + 10}, {x - 6, bottom + 10}, grip);
}

/// Above the picture, where there is room: which is which.
void Window::drawNames() {
  const CompareView& c = model_.compared();
  const float line = ImGui::GetTextLineHeight();
  if (!pictureBeside() || picture_.y < line + 12) return;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const ImU32 color = ImGui::GetColorU32(ImGuiCol_Text);
  const float y = picture_.y - line - 3;
  const bool hasPicture = isSplit();
  if (hasPicture) draw.AddText({picture_.x, y}, color, "picture");
  if (c.mode == CompareMode::Difference && !heldKeys_.contains(GLFW_KEY_SPACE)) return;
  const std::string name = fmt::format("reference: {}", c.name);
  const float width = ImGui::CalcTextSize(name.c_str()).x;
  draw.AddText({hasPicture ? picture_.x + picture_.width - width : picture_.x, y}, color, name.c_str());
}

float Window::legendHeight() const {
  const CompareView& c = model_.compared();
  const bool isShown = c.mode == CompareMode::Difference && c.difference.serial > 0;
  return isShown ? ImGui::GetTextLineHeight() * kLegendLines : 0;
}

void Window::drawLegend(float left, float top, float width) {
  if (legendHeight() <= 0) return;
  const CompareView& c = model_.compared();
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const float line = ImGui::GetTextLineHeight(), margin = line * 1.5F;
  const float length = std::max(1.0F, std::min(width - 2 * margin, kLegendWidth * line / 15));
  const float x0 = left + (width - length) / 2, bar = top + line * 1.2F;
  const ImU32 text = ImGui::GetColorU32(ImGuiCol_Text);
  const std::string title = legendTitle(c);
  draw.AddText({left + (width - ImGui::CalcTextSize(title.c_str()).x) / 2, top}, text, title.c_str());
  const auto count = static_cast<float>(c.colors.size());
  for (std::size_t i = 0; i < c.colors.size(); ++i) {
    const auto at = static_cast<float>(i);
    draw.AddRectFilled({x0 + length * at / count, bar},
                       {x0 + length * (at + 1) / count + 0.5F, bar + line * 0.8F},
                       IM_COL32(c.colors[i][0], c.colors[i][1], c.colors[i][2], 255));
  }
  for (int decade = 0; decade <= kDecades; ++decade) {
    const float x = x0 + length * static_cast<float>(decade) / kDecades;
    const std::string number = fmt::format("{:g}", c.scale.low * std::pow(10.0, decade));
    draw.AddLine({x, bar + line * 0.8F}, {x, bar + line}, text);
    draw.AddText({x - ImGui::CalcTextSize(number.c_str()).x / 2, bar + line * 1.1F}, text, number.c_str());
  }
}

}  // namespace whittle::view
