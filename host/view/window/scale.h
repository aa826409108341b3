// How large letters and panels are.
#pragma once

#include <string>

#include "view/window/window_library.h"

namespace whittle::view {

/// As ViewModel::set: a number or "auto".
inline constexpr const char* kScaleSetting = "ui-scale";

/// What the first monitor says of itself.
struct MonitorFacts {
  float scale = 1;  ///< that its user has set; 1: this, or none is known
  int width = 1 << 14, height = 1 << 14;
};
/// GLFW must run.
MonitorFacts monitorFacts();

/// The scale that its user has set. Where none is known, 1 up to 1200 rows, and beyond as much larger as
/// there are more rows than 1080, in quarters: 1.25 at 1440, 2 at 2160. Monitors differ in rows more than in
/// size, so letters keep their share of the screen's height.
float suitingScale(float ofMonitor, int rows);

/// The next of the sizes that buttons and keys go through; 0 where there is none.
float nextScale(float from, bool isLarger);

}  // namespace whittle::view
