// The movement of the watch, in millimetres: a train of five wheels that mesh, a balance with its spring,
// bridges with jewels and screws. Plan coordinates are those of whoever looks at it, x to the right and y up
// (+X and -Z); the plate's upper face is at height 0.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "shapes/gear.h"
#include "shapes/lathe.h"
#include "shapes/lettering.h"
#include "shapes/sweep.h"
#include "watchmaker/workshop.h"

namespace generator {
namespace {

constexpr double kPlateRadius = 32.5, kBridgeLow = 5.0, kBridgeHeight = 1.6;
constexpr double kBridgeTop = kBridgeLow + kBridgeHeight;

// Axes of the train. Distances are the sums of the pitch radii of what meshes.
constexpr glm::dvec2 kCenter(0, 0), kBarrel(-8.4, 12.06), kThird(9.68, 3.52), kFourth(15.46, -3.37),
    kEscape(11.56, -10.12), kBalance(-0.6, -13.2);

glm::dvec3 inPlan(glm::dvec2 p, double height) { return {p.x, height, -p.y}; }

Placement placed(glm::dvec2 p, double height, double turn = 0) {
  return {.position = inPlan(p, height), .turnY = turn};
}

/// A solid of revolution out of (radius, height, rounding) from the axis below to the axis above.
Mesh turnedPart(const std::vector<Corner>& profile, int segments = 64) {
  return makeLathe(roundCorners(profile, false), segments);
}

/// Shared by all screws and jewels of a movement.
struct SmallParts {
  int screwHead, screwFloor, chaton, ruby, pivot;
};

SmallParts makeSmallParts(const Workshop& w) {
  SmallParts parts{};
  // Two half discs leave the slot open; below them is its floor.
  Mesh head;
  for (const double side : {0.0, 180.0}) {
    constexpr double kSlot = 0.13, kEdge = 0.08;
    std::vector<Corner> half;
    for (int k = 0; k <= 24; ++k) {
      const double start = std::asin(kSlot), angle = start + (std::numbers::pi - 2 * start) * k / 24;
      half.push_back({std::cos(angle), std::sin(angle), k % 24 == 0 ? kEdge : 1});
    }
    PlateSpec spec{.outline = roundCorners(half), .height = 0.62, .bevel = 0.5 * kEdge};
    const Placement turn{.turnY = side};
    append(head, moved(joined(makePlate(spec)), glm::mat4_cast(within({}, turn).turn)));
  }
  parts.screwHead = w.addMesh("screw", std::move(head), w.finishes.bluedSteel);
  parts.screwFloor = w.addMesh(
      "floor of the slot", turnedPart({{0, -0.3, 0}, {0.97, -0.3, 0.05}, {0.97, 0.3, 0.05}, {0, 0.3, 0}}, 32),
      w.finishes.bluedSteel);
  parts.chaton = w.addMesh(
      "chaton",
      makeLathe(
          roundCorners(
              {{1.25, 0.0, 0.02}, {2.1, 0.0, 0.02}, {2.1, 0.32, 0.2}, {1.75, 0.42, 0.2}, {1.25, 0.16, 0.1}}),
          64),
      w.finishes.polishedGold);
  parts.ruby = w.addMesh(
      "ruby",
      turnedPart({{0, 0.02, 0}, {1.22, 0.02, 0.05}, {1.22, 0.2, 0.15}, {0.7, 0.46, 0.6}, {0, 0.42, 0}}),
      w.finishes.ruby);
  parts.pivot =
      w.addMesh("pivot", turnedPart({{0, 0, 0}, {0.2, 0, 0.02}, {0.2, 0.62, 0.12}, {0, 0.62, 0}}, 24),
                w.finishes.polishedSteel);
  return parts;
}

void addScrew(const Workshop& w, const SmallParts& parts, glm::dvec2 at, double height, double turn,
              double radius = 1.3) {
  Placement place = placed(at, height, turn);
  place.scale = radius;
  w.placeMesh(parts.screwHead, place);
  w.placeMesh(parts.screwFloor, place);
}

void addJewel(const Workshop& w, const SmallParts& parts, glm::dvec2 at, double height, double scale = 1) {
  Placement place = placed(at, height);
  place.scale = scale;
  for (const int part : {parts.chaton, parts.ruby, parts.pivot}) w.placeMesh(part, place);
}

struct WheelSpec {
  const char* name;
  GearSpec gear;
  int spokes;
  glm::dvec2 at;
  double height, thickness, turn;
  int leaves;  // of the pinion on the same arbor
  double pinionRadius, pinionHeight;
};

void addWheel(const Workshop& w, const WheelSpec& wheel) {
  const double root = wheel.gear.rootRadius(), rim = root - 0.11 * wheel.gear.pitchRadius;
  PlateSpec spec{.outline = gearOutline(wheel.gear),
                 .holes = spokeHoles(wheel.spokes, 0.24 * root, rim, 0.1 * root, 0.35),
                 .height = wheel.thickness,
                 .bevel = wheel.gear.bevel(),
                 .bevelSteps = 3,
                 .textureSize = 12};
  w.add(wheel.name, makePlate(spec), w.finishes.wheelBrass, w.finishes.polishedGold,
        placed(wheel.at, wheel.height, wheel.turn));
  const GearSpec pinion{wheel.leaves, wheel.pinionRadius};
  spec.outline = gearOutline(pinion);
  spec.holes.clear();
  spec.bevel = pinion.bevel();
  spec.height = 1.5;
  w.add(fmt::format("{} pinion", wheel.name), joined(makePlate(spec)), w.finishes.polishedSteel,
        placed(wheel.at, wheel.pinionHeight, wheel.turn));
  w.add(fmt::format("{} arbor", wheel.name),
        turnedPart({{0, -0.2, 0}, {0.42, -0.2, 0}, {0.42, 5.2, 0}, {0, 5.2, 0}}, 24),
        w.finishes.polishedSteel, placed(wheel.at, 0));
  w.add(fmt::format("{} hub", wheel.name),
        turnedPart({{0, 0, 0}, {1.1, 0, 0.1}, {1.1, 0.5, 0.25}, {0, 0.5, 0}}, 48), w.finishes.polishedGold,
        placed(wheel.at, wheel.height + wheel.thickness - 0.1));
}

void addTrain(const Workshop& w) {
  addWheel(w, {"centre wheel", {72, 9.0}, 5, kCenter, 3.8, 0.6, 3, 12, 2.2, 1.0});
  addWheel(w, {"third wheel", {64, 7.8}, 5, kThird, 3.0, 0.5, 11, 10, 1.3, 3.4});
  addWheel(w, {"fourth wheel", {60, 6.8}, 5, kFourth, 2.1, 0.5, 25, 10, 1.2, 2.7});
  addWheel(w, {"seconds wheel", {48, 5.2}, 4, {21.6, 12.4}, 2.4, 0.5, 8, 10, 1.1, 0.8});
  // The escape wheel: bare steel with its own teeth.
  PlateSpec escape{.outline = escapeOutline(15, 4.7),
                   .holes = spokeHoles(4, 1.1, 2.7, 0.5, 0.2),
                   .height = 0.45,
                   .bevel = 0.05,
                   .bevelSteps = 3};
  w.add("escape wheel", makePlate(escape), w.finishes.satinSteel, w.finishes.polishedSteel,
        placed(kEscape, 1.3, 10));
  w.add("escape arbor", turnedPart({{0, 0, 0}, {0.4, 0, 0}, {0.4, 5.2, 0}, {0, 5.2, 0}}, 24),
        w.finishes.polishedSteel, placed(kEscape, 0));
}

/// The drum of the mainspring, and above its bridge the ratchet wheel that the crown wheel winds.
void addBarrel(const Workshop& w, const SmallParts& parts) {
  const GearSpec gear{80, 12.5};
  PlateSpec teeth{
      .outline = gearOutline(gear), .height = 1.4, .bevel = gear.bevel(), .bevelSteps = 3, .textureSize = 12};
  w.add("barrel", makePlate(teeth), w.finishes.wheelBrass, w.finishes.polishedGold, placed(kBarrel, 0.5));
  w.add("barrel drum", turnedPart({{0, 0, 0}, {11.2, 0, 0}, {11.2, 2.2, 0.3}, {0, 2.2, 0}}, 128),
        w.finishes.gilt, placed(kBarrel, 1.8));
  const glm::dvec2 crown = kBarrel + glm::dvec2(7.0, 12.0);
  const auto addRing = [&](const char* name, const GearSpec& wheel, glm::dvec2 at, double hole, double turn) {
    PlateSpec spec{.outline = gearOutline(wheel),
                   .holes = {reversed(circleOutline(hole, 64))},
                   .height = 0.9,
                   .bevel = wheel.bevel(),
                   .bevelSteps = 3};
    w.add(name, makePlate(spec), w.finishes.satinSteel, w.finishes.polishedSteel,
          placed(at, kBridgeTop + 0.05, turn));
    w.add(fmt::format("{} cap", name),
          turnedPart({{0, 0, 0}, {hole - 0.12, 0, 0}, {hole - 0.12, 1.1, 0.2}, {0, 1.25, 0}}),
          w.finishes.polishedGold, placed(at, kBridgeTop));
    addScrew(w, parts, at, kBridgeTop + 1.25, turn + 30, 1.5);
  };
  addRing("ratchet wheel", {56, 8.4}, kBarrel, 3.2, 4);
  addRing("crown wheel", {36, 5.4}, crown, 2.3, 1);
}

/// A bridge from a foot on the plate's edge to the axis that it holds.
void addFinger(const Workshop& w, const SmallParts& parts, const char* name, glm::dvec2 axis, glm::dvec2 foot,
               double turn) {
  PlateSpec spec{.outline = hullOutline({axis, 2.2}, {foot, 2.8}, 0.1),
                 .height = kBridgeHeight,
                 .bevel = 0.4,
                 .bevelSteps = 6,
                 .textureSize = 24};
  w.add(name, makePlate(spec), w.finishes.stripedNickel, w.finishes.polishedSteel,
        placed({0, 0}, kBridgeLow));
  PlateSpec leg{.outline = hullOutline({foot - 0.1 * (foot - axis), 2.4}, {foot, 2.6}, 0.2),
                .height = kBridgeLow,
                .bevel = 0.1};
  w.add(fmt::format("{} foot", name), joined(makePlate(leg)), w.finishes.polishedSteel, placed({0, 0}, 0));
  addJewel(w, parts, axis, kBridgeTop);
  addScrew(w, parts, foot, kBridgeTop + 0.1, turn, 1.7);
}

/// The bridge over the barrel, with the maker's name.
void addBarrelBridge(const Workshop& w, const SmallParts& parts) {
  std::vector<Corner> corners;
  for (int k = 0; k <= 16; ++k) {
    const double angle = glm::radians(62.0 + 7.8 * k);
    corners.push_back({31.0 * std::cos(angle), 31.0 * std::sin(angle), k % 16 == 0 ? 2.0 : 31.0});
  }
  for (const Corner& corner :
       std::vector<Corner>{{-20, 0.5, 4}, {-14, 6.5, 5}, {-4.5, 7.5, 3}, {-2, 16, 6}, {9, 21, 5}})
    corners.push_back(corner);
  PlateSpec spec{.outline = roundCorners(corners, true, 0.1),
                 .height = kBridgeHeight,
                 .bevel = 0.45,
                 .bevelSteps = 6,
                 .textureSize = 24};
  w.add("barrel bridge", makePlate(spec), w.finishes.stripedNickel, w.finishes.polishedSteel,
        placed({0, 0}, kBridgeLow));
  for (const double angle : {68.0, 122.0, 184.0}) {
    const glm::dvec2 at = 27.6 * glm::dvec2(std::cos(glm::radians(angle)), std::sin(glm::radians(angle)));
    w.add("pillar", turnedPart({{0, 0, 0}, {2.6, 0, 0}, {2.6, kBridgeLow, 0}, {0, kBridgeLow, 0}}, 48),
          w.finishes.polishedSteel, placed(at, 0));
    addScrew(w, parts, at, kBridgeTop + 0.1, angle * 1.7, 1.7);
  }
  w.add("name", makeTextOnCircle("WHITTLE", 1.7, 0.26, 27.2), w.finishes.ink,
        {.position = {0, kBridgeTop, 0}, .turnY = 62});
  addJewel(w, parts, {-22.5, 7.0}, kBridgeTop);
}

/// A ring with weights around it, two arms, and the spiral spring above.
void addBalance(const Workshop& w, const SmallParts& parts) {
  constexpr double kAbovePlate = 7.3, kRim = 9.4;
  const Workshop balance = w.at(placed(kBalance, kAbovePlate, 35));
  balance.add(
      "balance rim",
      makeLathe(
          roundCorners({{kRim - 0.8, 0, 0.08}, {kRim, 0, 0.08}, {kRim, 0.9, 0.08}, {kRim - 0.8, 0.9, 0.08}}),
          160),
      w.finishes.polishedGold);
  PlateSpec arms{
      .outline = hullOutline({{-kRim + 0.5, 0}, 0.5}, {{kRim - 0.5, 0}, 0.51}), .height = 0.5, .bevel = 0.12};
  balance.add("balance arms", joined(makePlate(arms)), w.finishes.polishedGold, {.position = {0, 0.2, 0}});
  const int weight = balance.addMesh(
      "balance screw",
      turnedPart(
          {{0, 0, 0}, {0.3, 0, 0}, {0.3, 0.4, 0.02}, {0.62, 0.45, 0.05}, {0.62, 1.15, 0.15}, {0, 1.15, 0}},
          32),
      w.finishes.polishedBrass);
  for (int i = 0; i < 16; ++i) {
    const glm::dvec2 c = onCircle(i, 16);
    const glm::dvec3 outward(c.x, 0, -c.y);
    balance.placeMesh(weight,
                      {.position = (kRim - 0.05) * outward + glm::dvec3(0, 0.45, 0), .turn = upTo(outward)});
  }
  balance.add("staff", turnedPart({{0, -6, 0}, {0.4, -6, 0}, {0.4, 2.6, 0}, {0, 2.6, 0}}, 24),
              w.finishes.polishedSteel);
  SweepSpec spring;
  for (int i = 0; i <= 12 * 48; ++i) {
    const double angle = 2 * std::numbers::pi * i / 48, radius = 0.9 + 0.36 * i / 48;
    spring.path.emplace_back(radius * std::cos(angle), 1.3, -radius * std::sin(angle));
  }
  spring.section = rectangleOutline({-0.05, -0.2}, {0.05, 0.2}, 0.03, 0.8);
  spring.across = {1, 0, 0};
  balance.add("balance spring", makeSweep(spring), w.finishes.bluedSteel);

  PlateSpec cock{.outline = hullOutline({kBalance, 3.1}, {{-14.5, -24.5}, 4.6}, 0.1),
                 .height = kBridgeHeight,
                 .bevel = 0.45,
                 .bevelSteps = 6,
                 .textureSize = 24};
  w.add("balance cock", makePlate(cock), w.finishes.stripedNickel, w.finishes.polishedSteel,
        placed({0, 0}, 9.6));
  w.add("balance cock foot", turnedPart({{0, 0, 0}, {4.2, 0, 0}, {4.2, 9.6, 0}, {0, 9.6, 0}}),
        w.finishes.polishedSteel, placed({-14.5, -24.5}, 0));
  addJewel(w, parts, kBalance, 9.6 + kBridgeHeight, 1.25);
  addScrew(w, parts, {-14.5, -24.5}, 9.7 + kBridgeHeight, 70, 2.1);
}

void addPlate(const Workshop& w, const SmallParts& parts) {
  PlateSpec spec{.outline = circleOutline(kPlateRadius, 256), .height = 3, .bevel = 0.3, .textureSize = 36};
  w.add("main plate", makePlate(spec), w.finishes.pearledNickel, w.finishes.polishedSteel,
        placed({0, 0}, -3));
  for (const double angle : {-62.0, -128.0, 158.0 + 60, 8.0 + 30}) {
    const glm::dvec2 at = 30.0 * glm::dvec2(std::cos(glm::radians(angle)), std::sin(glm::radians(angle)));
    addScrew(w, parts, at, 0.1, angle, 1.6);
  }
  for (const glm::dvec2 at : {glm::dvec2(22.5, -18.0), glm::dvec2(-24.0, -13.0)})
    addJewel(w, parts, at, 0.02);
}

}  // namespace

Assembly makeMovement(const Workshop& workshop) {
  Assembly movement;
  const Workshop w{{workshop.scene, {}, &movement}, workshop.finishes};
  const SmallParts parts = makeSmallParts(w);
  addPlate(w, parts);
  addTrain(w);
  addBarrel(w, parts);
  addBarrelBridge(w, parts);
  addFinger(w, parts, "centre bridge", kCenter, {-27.0, -5.5}, 20);
  addFinger(w, parts, "third bridge", kThird, {28.3, 4.6}, 75);
  addFinger(w, parts, "fourth bridge", kFourth, {28.6, -7.6}, 140);
  addFinger(w, parts, "escape bridge", kEscape, {19.5, -22.0}, 10);
  addFinger(w, parts, "seconds bridge", {21.6, 12.4}, {24.6, 15.6}, 50);
  addBalance(w, parts);
  return movement;
}

}  // namespace generator
