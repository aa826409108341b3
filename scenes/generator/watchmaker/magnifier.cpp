// A magnifying lens on a stand, turned to the camera.
#include <cmath>

#include "shapes/lathe.h"
#include "shapes/sweep.h"
#include "watchmaker/workshop.h"

namespace generator {
namespace {

constexpr glm::dvec3 kLensAt(5, 45, 58), kLensFaces(0.03, 0.21, 1);
constexpr double kLensRadius = 21, kCurvature = 100;  // f = R / (2 (n - 1)) = 96 mm

/// Two spherical caps and a ground rim, about +Y.
Mesh makeLens() {
  Outline profile;
  profile.isClosed = false;
  constexpr int kSteps = 48;
  const double reach = std::asin(kLensRadius / kCurvature), middle = kCurvature * std::cos(reach) - 0.9;
  for (const double side : {-1.0, 1.0}) {
    for (int k = 0; k <= kSteps; ++k) {
      const double angle = reach * (side < 0 ? k : kSteps - k) / kSteps;
      const glm::dvec2 normal(std::sin(angle), side * std::cos(angle));
      profile.points.push_back({kCurvature * normal - glm::dvec2(0, side * middle), normal});
    }
    if (side < 0) {
      profile.points.push_back({{kLensRadius, -0.9}, {1, 0}});
      profile.points.push_back({{kLensRadius, 0.9}, {1, 0}});
    }
  }
  profile.points.front().position.x = profile.points.back().position.x = 0;
  return makeLathe(profile, 256);
}

}  // namespace

void addMagnifier(const Workshop& workshop) {
  const Finishes& f = workshop.finishes;
  const Workshop lens = workshop.at({.position = kLensAt, .turn = upTo(kLensFaces)});
  lens.add("lens", makeLens(), f.crystal);
  const std::vector<Corner> ring{{21.1, -2.6, 0.5}, {23.4, -2.6, 0.9}, {24.2, 0, 2},
                                 {23.4, 2.6, 0.9},  {21.1, 2.6, 0.5},  {21.6, 0, 0.3}};
  lens.add("lens ring", makeLathe(roundCorners(ring, true, 0.12), 192), f.polishedBrass);
  const glm::dvec3 foot(62, 0.3, 36), joint = kLensAt + glm::dvec3(26, -2, 0);
  const auto spunAt = [&](const char* name, const std::vector<Corner>& profile, glm::dvec3 at) {
    workshop.add(name, makeLathe(roundCorners(profile, false, 0.1), 96), f.polishedBrass, {.position = at});
  };
  spunAt("stand foot",
         {{0, 0, 0}, {15, 0, 0.6}, {15, 3.5, 1.2}, {11, 5.5, 2}, {3, 7.5, 3}, {2.6, 14, 1}, {0, 14, 0}},
         foot);
  workshop.add("stand rod", makeWire({foot + glm::dvec3(0, 6, 0), foot + glm::dvec3(0, 58, 0)}, 1.5, 32),
               f.polishedSteel);
  spunAt("clamp", {{0, -4, 0}, {3.6, -4, 0.8}, {3.6, 4, 0.8}, {0, 4, 0}}, {foot.x, joint.y, foot.z});
  workshop.add("stand arm",
               makeWire(smoothPath({{foot.x, joint.y, foot.z},
                                    {foot.x - 2, joint.y, 0.5 * (foot.z + joint.z)},
                                    joint,
                                    kLensAt + glm::dvec3(23.4, -1, 0)},
                                   12),
                        1.2, 24),
               f.polishedSteel);
  workshop.add("ball", makeSphere(2.6, 64, 32), f.polishedBrass,
               {.position = kLensAt + glm::dvec3(25, -1.6, 0)});
}

}  // namespace generator
