// An umbrella that somebody left open to dry: it rests on its rim and its handle.
#include <cmath>
#include <numbers>

#include "diner/street.h"
#include "shapes/surface.h"
#include "shapes/sweep.h"

namespace generator {
namespace {

using std::numbers::pi;

constexpr int kRibs = 8;
constexpr double kReach = 0.52, kRise = 0.21, kShaft = 0.94, kTilt = 55;  // metres, degrees

/// The canopy about +Y with its apex at the origin: taut along the ribs, sagging between them. `uv.y` = 1 is
/// the apex.
glm::dvec3 canopyPoint(glm::dvec2 uv) {
  const double t = 1 - uv.y, panel = uv.x * kRibs, in = 2 * (panel - std::floor(panel)) - 1,
               sag = 1 - in * in;
  const double around = 2 * pi * uv.x, r = kReach * t * (1 - 0.085 * sag * t);
  return {r * std::cos(around), -kRise * t * t - 0.018 * sag * t, -r * std::sin(around)};
}

}  // namespace

void addUmbrella(const Street& street) {
  const StreetFinishes& f = street.finishes;
  const double tilt = glm::radians(kTilt), apex = kRise * std::cos(tilt) + kReach * std::sin(tilt);
  const Street w = street.at(
      {.position = {0.30, apex, 3.7}, .turn = turnAbout({0, 1, 0}, 148) * turnAbout({0, 0, 1}, -kTilt)});
  w.add("canopy", makeSurface({.columns = 16 * kRibs, .rows = 40, .isRound = true, .position = canopyPoint}),
        f.oilcloth);
  for (int i = 0; i < kRibs; ++i) {
    std::vector<glm::dvec3> rib;
    for (int k = 0; k <= 12; ++k)
      rib.push_back(canopyPoint({static_cast<double>(i) / kRibs, 1 - k / 12.0}) - glm::dvec3(0, 0.004, 0));
    w.add("rib", makeWire(rib, 0.0025, 10), f.steel);
    w.add("stretcher", makeWire({rib[6], {0, -0.30, 0}}, 0.002, 10), f.steel);
  }
  w.add("shaft", makeWire({{0, 0.06, 0}, {0, -kShaft + 0.1, 0}}, 0.006, 24), f.steel);
  w.add("ferrule", makeWire({{0, 0.01, 0}, {0, 0.055, 0}}, 0.009, 24), f.blackEnamel);
  w.add("crook",
        makeWire(smoothPath({{0, -kShaft + 0.16, 0},
                             {0, -kShaft + 0.06, 0},
                             {0, -kShaft + 0.02, -0.02},
                             {0, -kShaft + 0.01, -0.05},
                             {0, -kShaft + 0.04, -0.085}},
                            12),
                 0.012, 32),
        f.blackEnamel);
}

}  // namespace generator
