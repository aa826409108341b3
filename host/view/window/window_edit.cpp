// Handles of lights over the picture.
#include <cmath>

#include "view/window/style.h"
#include "view/window/window.h"

namespace whittle::view {
namespace {

constexpr float kRadius = 7, kHandleReach = 10;  ///< of a handle: drawn, and for the mouse; pixels

}  // namespace

void Window::drawHandles() {
  if (!panels_.showsEdit) return;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.PushClipRect({picture_.x, picture_.y}, {picture_.x + picture_.width, picture_.y + picture_.height});
  const std::size_t chosen = model_.edits().chosen(Part::Light);
  for (const EditModel::Handle& h : model_.edits().handles()) {
    const ImVec2 at = inWindow(h.x, h.y);
    const float r = kRadius * scale_;
    draw.AddNgonFilled(at, r, h.light == chosen ? kSeries[1] : kSeries[3], 4);
    draw.AddNgon(at, r + scale_, IM_COL32_BLACK, 4, 2 * scale_);
  }
  draw.PopClipRect();
}

bool Window::dragHandle(double right, double down) {
  if (!panels_.showsEdit) return false;
  EditModel& edits = model_.edits();
  if (ImGui::IsMouseClicked(0)) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    float nearest = kHandleReach * scale_;
    for (const EditModel::Handle& h : edits.handles()) {
      const ImVec2 at = inWindow(h.x, h.y);
      const float distance = std::hypot(at.x - mouse.x, at.y - mouse.y);
      if (distance < nearest) nearest = distance, heldLight_ = h.light;
    }
    if (heldLight_) edits.choose(Part::Light, *heldLight_);
  }
  if (!heldLight_) return false;
  if (right != 0 || down != 0) edits.moveLight(*heldLight_, right, -down);
  if (!ImGui::IsMouseDown(0)) heldLight_.reset();
  return true;
}

}  // namespace whittle::view
