// Keys and mouse, as the window explains them.
#include <imgui.h>

#include <algorithm>

#include "view/window/panels.h"

namespace whittle::view {
namespace {

constexpr const char* kKeys[][2] = {
    {"left drag", "orbit about what is under the mouse"},
    {"middle drag, Shift + left", "pan"},
    {"click", "why a pixel is as it is: its rays, and what blocks lights"},
    {"wheel", "zoom towards what is under the mouse"},
    {"right drag", "look around"},
    {"W A S D, Q E", "fly; down, up"},
    {"R, Home", "the camera of the file"},
    {"F", "frame all"},
    {"1  3  7", "from the front, from the right, from above"},
    {"5", "orthographic, and back"},
    {"K", "keep the picture as the reference, beside a line"},
    {"V, B, M", "the reference beside a line, in the picture's place, the difference"},
    {"Space", "the reference while it is held"},
    {"Ctrl+B, then drag", "render a region alone; Ctrl+B or Esc: all"},
    {"Ctrl+C, Ctrl+V", "camera as command-line options"},
    {"X", "lights and materials; drag a light's handle"},
    {"Ctrl+Z", "undo the last edit of them"},
    {"F12, Ctrl+S", "save .png and .exr; with a region, that alone"},
    {"Ctrl+R", "read the file again"},
    {"Esc", "stop refining"},
    {"Tab", "panels away, and back"},
    {"L", "light, dark"},
    {"Ctrl and +, -, 0", "larger, smaller letters and panels; as at the start"},
    {"H, ?", "this help"},
    {"Ctrl+Q", "quit"},
};

/// In widths of a letter's height: as wide as all lines need.
constexpr float kWidth = 42, kKeysWidth = 12;

}  // namespace

/// Lines break and the list scrolls where the window is small.
void helpWindow(PanelState& state) {
  if (!state.showsHelp) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float letter = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSizeConstraints({0, 0}, size);
  ImGui::SetNextWindowSize({std::min(size.x, kWidth * letter), 0});
  ImGui::SetNextWindowBgAlpha(0.97F);
  constexpr auto kFlags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize;
  if (ImGui::Begin("Keys and mouse", &state.showsHelp, kFlags)) {
    if (ImGui::BeginTable("keys", 2)) {
      ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, kKeysWidth * letter);
      ImGui::TableSetupColumn("what");
      for (const auto& [keys, what] : kKeys) {
        ImGui::TableNextRow();
        for (const char* text : {keys, what}) {
          ImGui::TableNextColumn();
          ImGui::TextWrapped("%s", text);
        }
      }
      ImGui::EndTable();
    }
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetColorU32(ImGuiCol_TextDisabled));
    ImGui::TextWrapped(
        "Drop a .glb, .gltf, .hdr or .exr on the window to open it, with Shift to compare with it.");
    ImGui::PopStyleColor();
  }
  ImGui::End();
}

}  // namespace whittle::view
