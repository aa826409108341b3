// Colours, spacing and font of the window.
#pragma once

#include <imgui.h>

#include <filesystem>
#include <vector>

namespace whittle::view {

/// Behind the picture.
ImVec4 groundColor(bool isLight);
/// Dark or light, with room between things; `scale`: 1 on a monitor of 1080 rows.
void applyStyle(bool isLight, float scale);
/// One font with Latin, Greek, arrows and the signs of units; ImGui's own, which has ASCII alone, where no
/// file is there. It takes the place of what was loaded before.
void loadFont(const std::vector<std::filesystem::path>& files, float scale);

/// Colours of Okabe and Ito (2008), which people with any kind of colour vision can tell apart.
inline constexpr ImU32 kSeries[] = {IM_COL32(86, 180, 233, 255),  IM_COL32(230, 159, 0, 255),
                                    IM_COL32(0, 158, 115, 255),   IM_COL32(240, 228, 66, 255),
                                    IM_COL32(0, 114, 178, 255),   IM_COL32(213, 94, 0, 255),
                                    IM_COL32(204, 121, 167, 255), IM_COL32(153, 153, 153, 255)};

}  // namespace whittle::view
