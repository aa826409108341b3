// How far the picture is from the reference, in numbers.
#include <fmt/format.h>
#include <imgui.h>

#include "report/text.h"
#include "view/window/panels.h"

namespace whittle::view {

void comparePanel(const ViewModel& model) {
  const CompareView& c = model.compared();
  if (c.name.empty()) return;
  if (!ImGui::CollapsingHeader("Against the reference", ImGuiTreeNodeFlags_DefaultOpen)) return;
  ImGui::TextWrapped("%s%s", c.name.c_str(), c.isOfCodes ? ": codes, made linear" : "");
  if (!c.problem.empty()) ImGui::TextWrapped("%s", c.problem.c_str());
  if (!c.figures) return;
  const ImageMetrics& m = *c.figures;
  row("rmse", fmt::format("{:.4g}", m.rmse));
  tip("root mean square difference; of radiance in W/(m² sr), of codes in shares of white");
  row("relMse", fmt::format("{:.4g}", m.relMse));
  tip("mean of (a-b)²/(b²+0.01)");
  row("maxAbs", fmt::format("{:.4g}", m.maxAbs));
  tip("largest difference of a channel");
  row("flip", fmt::format("{:.4g}", m.flip));
  tip("mean FLIP of the pictures as shown, 0 to 1");
  row("pixels that differ", formatInteger(m.differingPixels));
  if (!c.isCurrent) ImGui::TextDisabled("of an earlier picture");
  ImGui::Separator();
}

}  // namespace whittle::view
