// Size and colours of letters and panels, and what changes them.
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <GLFW/glfw3.h>

#include <charconv>
#include <string_view>

#include "view/window/scale.h"
#include "view/window/style.h"
#include "view/window/window.h"

namespace whittle::view {

/// Between two frames: letters are drawn anew for their size.
void Window::restyle() {
  applyStyle(panels_.isLight, scale_);
  if (fontScale_ != scale_) {
    if (fontScale_ > 0) ImGui_ImplOpenGL3_DestroyFontsTexture();
    loadFont(options_.fonts, scale_);
    if (fontScale_ > 0) ImGui_ImplOpenGL3_CreateFontsTexture();
    fontScale_ = scale_;
  }
  panels_.restyles = false;
  framesToDraw_ = kFramesAfterEvent;
}

std::string Window::setScale(const std::string& text) {
  float scale = standardScale_;
  if (text != "auto") {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), scale);
    if (error != std::errc{} || end != text.data() + text.size() ||
        !(scale >= kLeastUiScale && scale <= kLargestUiScale))
      return fmt::format("{}: '{}' is neither auto nor a number from {:g} to {:g}", kScaleSetting, text,
                         kLeastUiScale, kLargestUiScale);
  }
  panels_.restyles |= scale != scale_;
  scale_ = scale;
  framesToDraw_ = kFramesAfterEvent;
  return {};
}

/// A keyboard may have its plus where others have another sign.
bool Window::scaleShortcut(int key) {
  const char* const sign = glfwGetKeyName(key, 0);
  const auto means = [&](std::string_view wanted) { return sign && sign == wanted; };
  const bool isLarger = key == GLFW_KEY_EQUAL || key == GLFW_KEY_KP_ADD || means("+");
  const bool isSmaller = key == GLFW_KEY_MINUS || key == GLFW_KEY_KP_SUBTRACT || means("-");
  const bool isReset = key == GLFW_KEY_0 || key == GLFW_KEY_KP_0;
  if (isReset) setScale("auto");
  if (isLarger || isSmaller)
    if (const float next = nextScale(scale_, isLarger); next > 0) setScale(fmt::format("{}", next));
  return isReset || isLarger || isSmaller;
}

/// In the line at the bottom.
void Window::scaleButtons() {
  const auto button = [&](const char* name, float next) {
    ImGui::BeginDisabled(next <= 0);
    if (ImGui::SmallButton(name)) setScale(fmt::format("{}", next));
    ImGui::EndDisabled();
    tip("size of letters and panels; Ctrl and +, - or 0");
  };
  button("-", nextScale(scale_, false));
  ImGui::SameLine(0, 4 * scale_);
  ImGui::Text("%.0f %%", 100.0 * static_cast<double>(scale_));
  ImGui::SameLine(0, 4 * scale_);
  button("+", nextScale(scale_, true));
}

}  // namespace whittle::view
