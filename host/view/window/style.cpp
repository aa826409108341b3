// See style.h.
#include "view/window/style.h"

#include <iterator>

namespace whittle::view {
namespace {

constexpr float kFontPixels = 15.0F;

}  // namespace

void loadFont(const std::vector<std::filesystem::path>& files, float scale) {
  // Pairs of first and last; ImGui keeps the pointer.
  static constexpr ImWchar kGlyphs[] = {0x20,   0x17F,  0x370,  0x3FF,  0x2010, 0x2027,
                                        0x2030, 0x2044, 0x2070, 0x209C, 0x2190, 0x21FF,
                                        0x2200, 0x22FF, 0x2500, 0x25FF, 0};
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  for (const auto& file : files) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) continue;
    if (io.Fonts->AddFontFromFileTTF(file.c_str(), kFontPixels * scale, nullptr, kGlyphs)) return;
  }
  ImFontConfig config;
  config.SizePixels = 13.0F * scale;
  io.Fonts->AddFontDefault(&config);
}

ImVec4 groundColor(bool isLight) {
  return isLight ? ImVec4{0.839F, 0.839F, 0.855F, 1} : ImVec4{0.063F, 0.067F, 0.0745F, 1};
}

void applyStyle(bool isLight, float scale) {
  ImGuiStyle style;
  if (isLight)
    ImGui::StyleColorsLight(&style);
  else
    ImGui::StyleColorsDark(&style);
  style.WindowRounding = 0;
  style.FrameRounding = 3;
  style.GrabRounding = 3;
  style.WindowBorderSize = 0;
  style.WindowPadding = {10, 8};
  style.FramePadding = {6, 3};
  style.ItemSpacing = {8, 5};
  style.IndentSpacing = 14;
  style.ScrollbarSize = 11;
  ImVec4* const c = style.Colors;
  if (isLight) {
    c[ImGuiCol_WindowBg] = {0.955F, 0.955F, 0.96F, 1};
    c[ImGuiCol_FrameBg] = {1, 1, 1, 1};
    c[ImGuiCol_Border] = {0, 0, 0, 0.18F};
    c[ImGuiCol_Header] = {0.84F, 0.87F, 0.92F, 1};
    c[ImGuiCol_TextDisabled] = {0.38F, 0.38F, 0.40F, 1};
  } else {
    c[ImGuiCol_WindowBg] = {0.105F, 0.11F, 0.12F, 1};
    c[ImGuiCol_FrameBg] = {0.19F, 0.20F, 0.22F, 1};
    c[ImGuiCol_Header] = {0.20F, 0.25F, 0.32F, 1};
    c[ImGuiCol_TextDisabled] = {0.62F, 0.63F, 0.65F, 1};
  }
  style.FrameBorderSize = isLight ? 1.0F : 0.0F;
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

}  // namespace whittle::view
