// The window's keys and mouse, of people and of scripts.
#include <fmt/format.h>
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "view/window/window.h"

namespace whittle::view {
namespace {

constexpr double kTurn = 3.5;  ///< radians that a drag over the picture's height turns
constexpr double kWheel = 1.12;

int buttonOf(const std::string& name) { return name == "right" ? 1 : name == "middle" ? 2 : 0; }

/// "Ctrl+S", "F12", "r", "?": GLFW's key and modifiers; throws std::invalid_argument.
std::pair<int, int> keyOf(std::string name) {
  int mods = 0;
  for (const auto& [prefix, mod] :
       {std::pair("Ctrl+", GLFW_MOD_CONTROL), std::pair("Shift+", GLFW_MOD_SHIFT)})
    if (name.rfind(prefix, 0) == 0) name.erase(0, std::string(prefix).size()), mods |= mod;
  if (name.size() == 1 && std::isalnum(static_cast<unsigned char>(name[0])))
    return {std::toupper(static_cast<unsigned char>(name[0])), mods};
  if (name == "?") return {GLFW_KEY_H, 0};
  if (name == "+") return {GLFW_KEY_EQUAL, mods};
  if (name == "-") return {GLFW_KEY_MINUS, mods};
  if (name == "Escape" || name == "Esc") return {GLFW_KEY_ESCAPE, mods};
  if (name == "Home") return {GLFW_KEY_HOME, mods};
  if (name == "Tab") return {GLFW_KEY_TAB, mods};
  if (name == "Space") return {GLFW_KEY_SPACE, mods};
  if (name == "F12") return {GLFW_KEY_F12, mods};
  throw std::invalid_argument(fmt::format("'{}' is no key that does anything", name));
}

}  // namespace

void Window::key(const std::string& name) {
  const auto [key, mods] = keyOf(name);
  pressed(key, mods);
  heldKeys_.erase(key);
}

void Window::pointer(const Place& place) {
  isScripted_ = true;
  const float scale =
      picture_.width / static_cast<float>(std::max(1, std::atoi(model_.value("width").c_str())));
  pointer_ = place.ofWindow ? ImVec2(static_cast<float>(place.x), static_cast<float>(place.y))
                            : ImVec2(picture_.x + static_cast<float>(place.x) * scale,
                                     picture_.y + static_cast<float>(place.y) * scale);
}

/// The middle of the window's pixel that it is on; of a script's the place itself, since a small picture has
/// several pixels in one of the window's.
ImVec2 Window::mouse() const {
  const ImVec2 at = ImGui::GetIO().MousePos;
  return isScripted_ ? pointer_ : ImVec2(at.x + 0.5F, at.y + 0.5F);
}

void Window::button(const std::string& name, bool isDown) {
  isScripted_ = true;
  buttons_[static_cast<std::size_t>(buttonOf(name))] = isDown;
}

void Window::moveCamera() {
  const ImGuiIO& io = ImGui::GetIO();
  bool moves = false;
  model_.edits().setDragging(ImGui::IsMouseDown(0));
  const bool isTaken = marksRegion() || slidesSplit();
  if (!isTaken && !io.WantCaptureMouse && picture_.height > 0) {
    const double dx = static_cast<double>(io.MouseDelta.x / picture_.height),
                 dy = static_cast<double>(io.MouseDelta.y / picture_.height);
    const ImVec2 at = inPicture(mouse());
    if (dragHandle(dx, dy)) return;
    for (int b = 0; b < 3; ++b)
      if (ImGui::IsMouseClicked(b)) model_.holdPoint(static_cast<double>(at.x), static_cast<double>(at.y));
    if (ImGui::IsMouseClicked(0)) pressedAt_ = io.MousePos;
    if (ImGui::IsMouseReleased(0) && pressedAt_.x == io.MousePos.x && pressedAt_.y == io.MousePos.y)
      model_.explain(static_cast<double>(at.x), static_cast<double>(at.y));
    const bool isMoved = dx != 0 || dy != 0;
    const bool left = ImGui::IsMouseDown(0), pans = ImGui::IsMouseDown(2) || (left && io.KeyShift);
    if (left || pans || ImGui::IsMouseDown(1)) moves = true, model_.setMoving(true);
    if (isMoved && pans)
      model_.pan(dx, -dy);
    else if (isMoved && left)
      model_.orbit(dx * kTurn, -dy * kTurn);
    else if (isMoved && ImGui::IsMouseDown(1))
      model_.look(dx, -dy);
    if (io.MouseWheel != 0) {
      model_.setMoving(true);
      model_.holdPoint(static_cast<double>(at.x), static_cast<double>(at.y));
      model_.zoom(std::pow(kWheel, static_cast<double>(io.MouseWheel)));
      moves = true;
    }
  }
  if (!heldKeys_.empty() && !io.WantTextInput) {
    const auto held = [&](int key) { return heldKeys_.contains(key) ? 1.0 : 0.0; };
    const double step = std::min(0.1, static_cast<double>(io.DeltaTime)) * 40;
    const double right = held('D') - held('A'), up = held('E') - held('Q'), ahead = held('W') - held('S');
    if (right != 0 || up != 0 || ahead != 0) {
      model_.setMoving(true);
      model_.fly(right * step, up * step, ahead * step);
      moves = true;
    }
  }
  const auto time = std::chrono::steady_clock::now();
  if (moves) movedAt_ = time, wasMoving_ = true;
  if (wasMoving_ && std::chrono::duration<double>(time - movedAt_).count() > kRestSeconds)
    wasMoving_ = false, model_.setMoving(false);
}

void Window::pressed(int key, int mods) {
  framesToDraw_ = kFramesAfterEvent;
  if (ImGui::GetIO().WantTextInput) return;
  if (key == GLFW_KEY_ESCAPE && ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId))
    return;  // it means the list
  const bool ctrl = (mods & GLFW_MOD_CONTROL) != 0;
  if (!ctrl && std::string("WASDQE").find(static_cast<char>(key < 128 ? key : 0)) != std::string::npos &&
      key < 128)
    heldKeys_.insert(key);
  if (key == GLFW_KEY_SPACE) heldKeys_.insert(key);
  shortcuts(key, ctrl);
}

void Window::shortcuts(int key, bool ctrl) {
  if (ctrl) {
    if (scaleShortcut(key)) return;
    if (key == 'B') switchRegion();
    if (key == 'Q') quit();
    if (key == 'R') model_.reload();
    if (key == 'Z') model_.edits().undo();
    if (key == 'S') model_.save();
    if (key == 'C') glfwSetClipboardString(window_, model_.cameraText().c_str());
    if (key == 'V') {
      const char* const text = glfwGetClipboardString(window_);
      if (text) model_.pasteCamera(text);
    }
    return;
  }
  if (compareShortcut(key)) return;
  switch (key) {
    case 'R':
    case GLFW_KEY_HOME:
      model_.resetCamera();
      break;
    case 'F':
      model_.frameAll();
      break;
    case '1':
      model_.seeFrom(Side::Front);
      break;
    case '3':
      model_.seeFrom(Side::Right);
      break;
    case '7':
      model_.seeFrom(Side::Top);
      break;
    case '5':
      model_.switchOrthographic();
      break;
    case 'X':
      panels_.showsEdit = !panels_.showsEdit;
      break;
    case 'L':
      panels_.isLight = !panels_.isLight, panels_.restyles = true;
      break;
    case 'H':
    case GLFW_KEY_SLASH:
      panels_.showsHelp = !panels_.showsHelp;
      break;
    case GLFW_KEY_TAB:
      panels_.showsPanels = !panels_.showsPanels;
      break;
    case GLFW_KEY_F12:
      model_.save();
      break;
    case GLFW_KEY_ESCAPE:
      if (panels_.showsHelp)
        panels_.showsHelp = false;
      else if (leaveRegion())
        break;
      else if (model_.explained())
        model_.closeExplanation();
      else
        model_.stop();
      break;
    default:
      break;
  }
}

}  // namespace whittle::view
