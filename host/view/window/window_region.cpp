// The region that alone is rendered: marked with the mouse after Ctrl+B, and its edge over the picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "view/window/window.h"

namespace whittle::view {
namespace {

/// The pixels that a rectangle touches; places in [0, 1]² of the picture, in any order and anywhere.
Region regionBetween(const ImVec2& a, const ImVec2& b, int width, int height) {
  const auto first = [](float p, float q, int side) {
    return std::clamp(static_cast<int>(std::floor(std::min(p, q) * static_cast<float>(side))), 0, side - 1);
  };
  const auto end = [](float p, float q, int side) {
    return std::clamp(static_cast<int>(std::ceil(std::max(p, q) * static_cast<float>(side))), 1, side);
  };
  Region region{first(a.x, b.x, width), first(a.y, b.y, height), 0, 0};
  region.width = std::max(1, end(a.x, b.x, width) - region.x);
  region.height = std::max(1, end(a.y, b.y, height) - region.y);
  return region;
}

/// A dimmed line around, which leaves what it surrounds as it is.
void drawEdge(ImDrawList& draw, ImVec2 low, ImVec2 high) {
  draw.AddRect({low.x - 2, low.y - 2}, {high.x + 2, high.y + 2}, IM_COL32(0, 0, 0, 150));
  draw.AddRect({low.x - 1, low.y - 1}, {high.x + 1, high.y + 1}, IM_COL32(255, 255, 255, 150));
}

}  // namespace

int Window::widthOfModel() const { return std::max(1, std::atoi(model_.value("width").c_str())); }
int Window::heightOfModel() const { return std::max(1, std::atoi(model_.value("height").c_str())); }

void Window::switchRegion() {
  if (model_.region())
    model_.set("crop", "none");
  else
    marker_.isOn = !marker_.isOn;
  marker_.isDragged = false;
}

bool Window::leaveRegion() {
  if (!marker_.isOn && !model_.region()) return false;
  if (!marker_.isOn) model_.set("crop", "none");
  marker_ = {};
  return true;
}

bool Window::marksRegion() {
  const ImGuiIO& io = ImGui::GetIO();
  if (!marker_.isOn) return false;
  if (ImGui::IsMouseClicked(0) && !io.WantCaptureMouse) {
    marker_.isDragged = true;
    marker_.from = inPicture(io.MousePos);
  }
  if (!marker_.isDragged) return false;
  marker_.to = inPicture(io.MousePos);
  if (!ImGui::IsMouseReleased(0)) return true;
  const Region r = regionBetween(marker_.from, marker_.to, widthOfModel(), heightOfModel());
  marker_ = {};
  model_.set("crop", fmt::format("{},{},{},{}", r.x, r.y, r.width, r.height));
  return true;
}

void Window::drawRegion() {
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const auto at = [&](float x, float y) {
    return ImVec2(picture_.x + x * picture_.width, picture_.y + y * picture_.height);
  };
  if (marker_.isDragged)
    drawEdge(draw, at(std::min(marker_.from.x, marker_.to.x), std::min(marker_.from.y, marker_.to.y)),
             at(std::max(marker_.from.x, marker_.to.x), std::max(marker_.from.y, marker_.to.y)));
  if (const auto region = model_.region()) {
    const auto width = static_cast<float>(widthOfModel()), height = static_cast<float>(heightOfModel());
    const auto x = static_cast<float>(region->x), y = static_cast<float>(region->y);
    drawEdge(draw, at(x / width, y / height),
             at((x + static_cast<float>(region->width)) / width,
                (y + static_cast<float>(region->height)) / height));
  }
  if (!marker_.isOn) return;
  const char* const hint = "drag over what is to be rendered alone; Esc: nothing";
  const ImVec2 size = ImGui::CalcTextSize(hint), corner{picture_.x + 8, picture_.y + 8};
  draw.AddRectFilled(corner, {corner.x + size.x + 12, corner.y + size.y + 8}, IM_COL32(0, 0, 0, 190), 3);
  draw.AddText({corner.x + 6, corner.y + 4}, IM_COL32_WHITE, hint);
}

}  // namespace whittle::view
