// The background as a light (LightKind::Sky), and the table by which directions towards a map are chosen:
// often where it is bright (Pharr, Jakob, Humphreys, Physically Based Rendering, 2023, 12.5).
#pragma once

#include <vector>

#include "scene/scene.h"
#include "scene/settings.h"

namespace whittle {

/// Which cell of a map, for two numbers in [0, 1): first the row, then the column. Cells lie between the
/// middles of four texels: column x between texels x and x + 1 (the last and the first are neighbours), row y
/// between y - 1 and y, and the first and the last row between a pole and the middles there. Multiples of
/// 2⁻²⁴, as the random numbers are, so that the difference of two neighbours is exactly the chance of a cell.
struct SkyTable {
  int width = 0, height = 0;  ///< of the map
  /// [height + 1] of the rows, then [height + 1][width] of the columns of each: a cell is chosen where the
  /// one before has `until` <= u < its own. The last of each has 1.
  std::vector<float> until;
  bool operator==(const SkyTable&) const = default;
};

/// By the light that comes from a cell: its share of the sphere times the mean of its texels, all channels.
/// One that is not black has a chance of 2⁻²⁴ at least, in its row. Empty: there is no map.
SkyTable skyTableOf(const Background& background);

/// The sum of the channels of a texel; x counts around, rows beyond a pole are those beside it.
double skyBrightness(const Background& background, int x, int y);

bool isBlack(const Background& background);

/// Adds the light that the background is, unless it is black; false: it is.
bool addSkyLight(Scene& scene);

bool hasSkyLight(const Scene& scene);

/// Settings::ambient where it counts: a sky light takes its place.
float ambientOf(const Scene& scene, const Settings& settings);

}  // namespace whittle
