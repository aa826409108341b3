// A round table clock that stands behind the watch: dial, hours in relief, hands at ten minutes past ten.
#include <cmath>
#include <numbers>

#include "shapes/lathe.h"
#include "shapes/lettering.h"
#include "watchmaker/workshop.h"

namespace generator {
namespace {

/// A hand from the axis upwards (-Z) on y = 0.
Mesh makeHand(double length, double width) {
  PlateSpec spec{.outline = hullOutline({{0, -0.12 * length}, width}, {{0, length}, 0.25 * width}),
                 .height = 0.6,
                 .bevel = 0.12};
  return joined(makePlate(spec));
}

}  // namespace

void addTableClock(const Workshop& workshop) {
  const Finishes& f = workshop.finishes;
  const Workshop stand = workshop.at({.position = {80, 0, -160}, .scale = 0.86, .turnY = -14});
  PlateSpec foot{
      .outline = rectangleOutline({-44, -16}, {44, 16}, 4), .height = 10, .bevel = 2, .textureSize = 180};
  stand.add("clock foot", joined(makePlate(foot)), f.marble);
  const Workshop clock = stand.at({.position = {0, 56, -4}, .turn = turnAbout({1, 0, 0}, 84)});
  const std::vector<Corner> body{{0, -14, 0}, {43, -14, 6}, {48, -2, 6},  {48, 6, 3},
                                 {44, 9, 2},  {41, 3, 1},   {41, 0.5, 0}, {0, 0.5, 0}};
  clock.add("clock case", makeLathe(roundCorners(body, false, 0.1), 224), f.polishedBrass);
  clock.add(
      "dial",
      makeLathe(roundCorners({{0, 0.6, 0}, {40.8, 0.6, 0}, {40.8, 1.0, 0.2}, {0, 1.6, 0}}, false, 0.1), 192),
      f.dial);
  for (int hour = 1; hour <= 12; ++hour) {
    const double angle = -30.0 * hour;
    clock.add("hour", makeTextOnCircle(std::to_string(hour), 6.5, 0.9, 27.5), f.ink,
              {.position = {0, 1.35, 0}, .turnY = angle});
  }
  const int mark = clock.addMesh("minute", makeRoundedBox({-0.25, 0, -38.6}, {0.25, 0.4, -36.6}, 0.1), f.ink);
  for (int minute = 0; minute < 60; ++minute)
    clock.placeMesh(mark, {.position = {0, 1.0, 0}, .turnY = -6.0 * minute});
  clock.add("hour hand", makeHand(20, 1.5), f.bluedSteel, {.position = {0, 2.4, 0}, .turnY = -305});
  clock.add("minute hand", makeHand(33, 1.2), f.bluedSteel, {.position = {0, 3.4, 0}, .turnY = -60});
  clock.add("axis",
            makeLathe(roundCorners({{0, 1, 0}, {1.6, 1, 0}, {1.6, 4.6, 0.6}, {0, 4.8, 0}}, false, 0.2), 48),
            f.polishedBrass);
}

}  // namespace generator
