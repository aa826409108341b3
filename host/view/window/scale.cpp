// See scale.h.
#include "view/window/scale.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace whittle::view {
namespace {

constexpr std::array kScales{kLeastUiScale, 0.75F, 1.0F, 1.25F, 1.5F,
                             1.75F,         2.0F,  2.5F, 3.0F,  kLargestUiScale};

}  // namespace

MonitorFacts monitorFacts() {
  MonitorFacts facts;
  GLFWmonitor* const first = glfwGetPrimaryMonitor();
  if (!first) return facts;
  glfwGetMonitorContentScale(first, &facts.scale, nullptr);
  if (const GLFWvidmode* const mode = glfwGetVideoMode(first))
    facts.width = mode->width, facts.height = mode->height;
  return facts;
}

float suitingScale(float ofMonitor, int rows) {
  constexpr int kUsualRows = 1080, kManyRows = 1200;
  if (ofMonitor == 1.0F && rows > kManyRows)
    ofMonitor = std::round(4.0F * static_cast<float>(rows) / kUsualRows) / 4.0F;
  return std::clamp(ofMonitor, 1.0F, kLargestUiScale);
}

float nextScale(float from, bool isLarger) {
  if (isLarger) {
    const auto* const larger = std::upper_bound(kScales.begin(), kScales.end(), from);
    return larger == kScales.end() ? 0.0F : *larger;
  }
  const auto* const notLess = std::lower_bound(kScales.begin(), kScales.end(), from);
  return notLess == kScales.begin() ? 0.0F : *std::prev(notLess);
}

}  // namespace whittle::view
