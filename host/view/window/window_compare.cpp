// The reference in the window: left and right of a line, in the picture's place, or the difference.
#include <fmt/format.h>
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

#include "view/window/window.h"

namespace whittle::view {
namespace {

/// How near to the line the mouse has it, pixels where the scale is 1.
constexpr float kReach = 6;

std::string errorTitle(const CompareView& c) {
  if (c.isRelative)
    return fmt::format("relative error of {}: a share of the reference; 0 is black",
                       c.isOfCodes ? "the codes' linear light" : "radiance");
  return c.isOfCodes ? "absolute error of the codes' linear light, 1 is white; 0 is black"
                     : "absolute error of radiance, W/(m² sr); 0 is black";
}

}  // namespace

ColorScale differenceScale(const CompareView& c) {
  return {c.scale.low, c.scale.low * std::pow(10.0, kDecades), true, errorTitle(c)};
}

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
  const float line = picture_.x + splitPlace() * picture_.width, reach = kReach * scale_;
  const bool isNear = std::abs(io.MousePos.x - line) <= reach && io.MousePos.y >= picture_.y - reach &&
                      io.MousePos.y <= picture_.y + picture_.height + reach && !io.WantCaptureMouse;
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
  const float side = kReach * scale_, tall = 10 * scale_;
  draw.AddTriangleFilled({x - side, top - tall}, {x + side, top - tall}, {x, top - 1}, grip);
  draw.AddTriangleFilled({x, bottom + 1}, {x + side, bottom + tall}, {x - side, bottom + tall}, grip);
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

}  // namespace whittle::view
