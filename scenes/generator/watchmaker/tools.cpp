// Tools: tweezers and screwdrivers on the pad, a rack of screwdrivers behind, a steel tray with screws and
// wheels.
#include <cmath>
#include <numbers>

#include "hash.h"
#include "shapes/gear.h"
#include "shapes/lathe.h"
#include "shapes/sweep.h"
#include "watchmaker/workshop.h"

namespace generator {
namespace {

constexpr double kPadTop = 0.3;  // above the bench
constexpr double kTurnAround = 2 * std::numbers::pi;

/// Numbers that differ between the loose screws.
enum TraySeries : std::uint32_t { kScrewAngle = 9000, kScrewFar, kScrewTurn };

Mesh spun(const std::vector<Corner>& profile, int segments, double arcStep = 0.2) {
  return makeLathe(roundCorners(profile, false, arcStep), segments);
}

/// Lies along +X with its points at the origin.
void addTweezers(const Workshop& w) {
  for (const double side : {-1.0, 1.0}) {
    SweepSpec arm;
    arm.path = smoothPath({{0, 1.2, 0.15 * side},
                           {14, 1.6, 1.2 * side},
                           {38, 2.4, 3.6 * side},
                           {72, 2.6, 4.6 * side},
                           {100, 2.2, 3.2 * side},
                           {118, 2.0, 0.7 * side},
                           {126, 2.0, 0.5 * side}},
                          10);
    for (std::size_t i = 0; i < arm.path.size(); ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(arm.path.size() - 1);
      arm.scale.push_back(0.14 + 0.86 * std::min(1.0, 2.4 * t));
    }
    arm.section = rectangleOutline({-0.55, -2.4}, {0.55, 2.4}, 0.35, 0.3);
    arm.across = {0, 0, 1};
    w.add("tweezers", makeSweep(arm), w.finishes.polishedSteel);
  }
}

/// Lies along +X with its blade at the origin: a knurled barrel, a coloured ring, a head that turns.
void addScrewdriver(const Workshop& w, const Finish& ring) {
  const Workshop lying = w.at({.position = {0, 3.6, 0}, .turn = upTo({1, 0, 0})});
  lying.add("blade", spun({{0, 0, 0}, {0.5, 0.1, 0.1}, {0.8, 6, 1}, {0.8, 24, 0}, {0, 24, 0}}, 32),
            w.finishes.polishedSteel);
  lying.add("collet", spun({{0, 17, 0}, {1.1, 17, 0.1}, {2.3, 24, 1}, {2.3, 27, 0.2}, {0, 27, 0}}, 48),
            w.finishes.polishedBrass);
  const GearSpec knurl{30, 2.75};
  PlateSpec grip{.outline = gearOutline(knurl), .height = 44, .bevel = knurl.bevel()};
  lying.add("grip", joined(makePlate(grip)), w.finishes.polishedBrass, {.position = {0, 27, 0}});
  lying.add("ring", spun({{0, 71, 0}, {3.1, 71, 0.2}, {3.1, 74.5, 0.2}, {0, 74.5, 0}}, 64), ring);
  lying.add(
      "head",
      spun({{0, 74.5, 0}, {2.0, 74.5, 0}, {2.0, 76, 0}, {3.6, 76.2, 0.5}, {3.4, 79, 1}, {0, 80, 0}}, 64),
      w.finishes.polishedBrass);
}

/// A wooden block with a row of screwdrivers that stand in it.
void addRack(const Workshop& w) {
  w.add("rack", makeRoundedBox({-42, 0, -11}, {42, 24, 11}, 3), w.finishes.darkWood);
  const Finish rings[] = {w.finishes.ink, w.finishes.enamel, w.finishes.bluedSteel, w.finishes.dial,
                          w.finishes.ruby};
  for (int i = 0; i < 5; ++i) {
    const Workshop driver = w.at({.position = {-32.0 + 16 * i, 4.0, 0}, .turn = turnAbout({0, 0, 1}, 90)});
    addScrewdriver(driver.at({.position = {0, -3.6, 0}}), rings[i]);
  }
}

/// A screw that lies on its side, the head to -X.
Mesh looseScrew() {
  Mesh screw =
      spun({{0, 0, 0}, {0.75, 0, 0.05}, {0.75, 3.2, 0.2}, {1.45, 3.2, 0.05}, {1.45, 4.4, 0.15}, {0, 4.4, 0}},
           32, 0.4);
  SweepSpec thread;
  for (int i = 0; i <= 20 * 6; ++i) {
    const glm::dvec2 c = onCircle(i % 20, 20);
    thread.path.emplace_back(0.76 * c.x, 0.25 + 0.45 * i / 20, -0.76 * c.y);
  }
  thread.section = circleOutline(0.14, 6);
  thread.capLength = 0.14;
  append(screw, makeSweep(thread));
  return screw;
}

}  // namespace

void addTools(const Workshop& workshop) {
  const Workshop pad = workshop.at({.position = {0, kPadTop, 0}});
  addTweezers(pad.at({.position = {-2, 0, 104}, .turnY = 172}));
  addScrewdriver(pad.at({.position = {-78, 0, 54}, .turnY = 170}), workshop.finishes.ink);
  addRack(workshop.at({.position = {-62, 0, -150}, .turnY = 8}));
}

void addTray(const Workshop& workshop) {
  const Workshop tray = workshop.at({.position = {96, kPadTop, 78}});
  const std::vector<Corner> dish{{0, 0, 0},        {27, 0, 3},       {32.5, 5.6, 1.0}, {33.6, 5.6, 0.5},
                                 {33.4, 6.6, 0.5}, {31.6, 6.5, 0.8}, {26.4, 1.2, 3},   {0, 1.2, 0}};
  tray.add("steel tray", spun(dish, 256, 0.08), workshop.finishes.polishedSteel);
  const int screw = tray.addMesh("loose screw", looseScrew(), workshop.finishes.bluedSteel);
  const int gold = tray.addMesh("loose brass screw", looseScrew(), workshop.finishes.polishedBrass);
  for (std::uint32_t i = 0; i < 46; ++i) {
    const double angle = kTurnAround * unitValue(kScrewAngle, i),
                 far = 23 * std::sqrt(unitValue(kScrewFar, i));
    const glm::dvec3 at(far * std::cos(angle), 1.2, far * std::sin(angle));
    if (at.x < -2 && at.z < 4) continue;  // where the wheels lie
    if (i % 5 == 0) {
      tray.placeMesh(i % 2 == 0 ? screw : gold,
                     {.position = at + glm::dvec3(0, 4.4, 0), .turn = upTo({0, -1, 0})});
      continue;
    }
    // On its side: the rim of the head and the end of the shank touch the tray.
    const double turn = kTurnAround * unitValue(kScrewTurn, i), dip = (1.45 - 0.75) / 3.2;
    const glm::dvec3 axis = glm::normalize(glm::dvec3(std::cos(turn), dip, std::sin(turn)));
    tray.placeMesh(i % 3 == 0 ? gold : screw, {.position = at + glm::dvec3(0, 0.78, 0), .turn = upTo(axis)});
  }
  PlateSpec wheel{.outline = gearOutline({64, 8.4}),
                  .holes = spokeHoles(5, 2.1, 7.0, 0.8, 0.35),
                  .height = 0.6,
                  .bevel = GearSpec{64, 8.4}.bevel(),
                  .bevelSteps = 3,
                  .textureSize = 12};
  tray.add("loose wheel", makePlate(wheel), workshop.finishes.wheelBrass, workshop.finishes.polishedGold,
           {.position = {-12, 1.2, -9}});
  wheel.outline = gearOutline({48, 5.6});
  wheel.holes = spokeHoles(4, 1.4, 4.6, 0.6, 0.3);
  wheel.bevel = GearSpec{48, 5.6}.bevel();
  tray.add("loose wheel", makePlate(wheel), workshop.finishes.wheelBrass, workshop.finishes.polishedGold,
           {.position = {-9, 2.0, -8}, .turn = turnAbout({1, 0, 0.4}, 6)});
}

}  // namespace generator
