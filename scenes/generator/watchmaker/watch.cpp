// The pocket watch: an open hunter case on a block of walnut. The lid stands like a wing to the left and
// mirrors the movement; the chain hangs behind and winds over the bench.
#include <cmath>
#include <numbers>

#include "shapes/gear.h"
#include "shapes/lathe.h"
#include "shapes/sweep.h"
#include "watchmaker/workshop.h"

namespace generator {
namespace {

constexpr glm::dvec3 kWatchAt(-12, 45.7, 0);
constexpr double kLean = 22;  // degrees that the face looks up
constexpr double kCaseRadius = 37.5, kHinge = 38.2;
constexpr double kLidTurn = 107;     // degrees from closed
constexpr double kRimHeight = 11.5;  // of the case above the plate

/// The band, the back, and a bezel that holds the movement.
void addCase(const Workshop& w) {
  const std::vector<Corner> band{{33.0, -3.2, 0.2},        {33.0, -6.0, 0.5},       {36.0, -7.5, 2.0},
                                 {kCaseRadius, -3.0, 5.0}, {kCaseRadius, 7.0, 5.0}, {36.2, kRimHeight, 1.2},
                                 {33.6, kRimHeight, 0.6},  {33.0, 9.8, 0.4}};
  w.add("case band", makeLathe(roundCorners(band, true, 0.12), 256), w.finishes.polishedGold);
  const std::vector<Corner> back{
      {0, -9.0, 0}, {22, -8.8, 30}, {35.5, -6.4, 6}, {35.0, -5.6, 0.3}, {0, -5.6, 0}};
  w.add("case back", makeLathe(roundCorners(back, false, 0.12), 192), w.finishes.polishedGold);
  const std::vector<Corner> joint{{32.9, -3.4, 0.1}, {32.9, 0.6, 0.2}, {32.2, 0.9, 0.15}, {32.2, -3.4, 0.1}};
  w.add("case ring", makeLathe(roundCorners(joint, true, 0.3), 192), w.finishes.polishedBrass);
}

/// A shallow dome, polished inside and out, that turns about the hinge on the left.
void addLid(const Workshop& w) {
  const glm::dquat open = turnAbout({0, 0, 1}, kLidTurn);
  const Workshop lid = w.at({.position = {-kHinge, kRimHeight + 0.6, 0}, .turn = open});
  const std::vector<Corner> dome{{0, 2.6, 0},       {20, 2.2, 60},    {35.2, 0.3, 3}, {35.2, -0.9, 0.3},
                                 {37.2, -0.9, 0.4}, {37.2, 0.9, 1.5}, {21, 3.4, 60},  {0, 3.8, 0}};
  lid.add("lid", makeLathe(roundCorners(dome, false, 0.06), 256), w.finishes.polishedGold,
          {.position = {kHinge, 0, 0}});
  lid.add("hinge", makeWire({{0, 0, -9}, {0, 0, 9}}, 1.0, 24), w.finishes.polishedGold);
  for (const double z : {-6.0, 6.0})
    w.add("knuckle",
          makeWire({{-kHinge + 1.2, kRimHeight - 1.5, z - 2}, {-kHinge + 1.2, kRimHeight - 1.5, z + 2}}, 1.4,
                   24),
          w.finishes.polishedGold);
}

/// Winding crown and bow, above.
void addCrown(const Workshop& w) {
  const Workshop up = w.at({.position = {0, 2, -kCaseRadius}, .turn = upTo({0, 0, -1})});
  up.add(
      "neck",
      makeLathe(roundCorners({{0, -2, 0}, {4.6, -2, 0}, {3.4, 2.2, 2}, {3.4, 4.4, 0.2}, {0, 4.4, 0}}, false),
                64),
      w.finishes.polishedGold);
  const GearSpec knurl{32, 5.2};
  PlateSpec crown{.outline = gearOutline(knurl), .height = 5.4, .bevel = knurl.bevel()};
  up.add("crown", joined(makePlate(crown)), w.finishes.polishedGold, {.position = {0, 4.6, 0}});
  up.add("crown top",
         makeLathe(roundCorners({{0, 0, 0}, {4.7, 0, 0}, {4.2, 1.0, 1.0}, {0, 1.5, 0}}, false), 64),
         w.finishes.polishedGold, {.position = {0, 9.9, 0}});
  SweepSpec bow;
  for (int i = 0; i <= 40; ++i) {
    const double angle = glm::radians(-52.0 + 284.0 * i / 40);
    bow.path.emplace_back(9.6 * std::cos(angle), 9.0 + 9.6 * std::sin(angle), 0);
    bow.scale.push_back(1.0 + 0.35 * std::abs(i - 20.0) / 20);
  }
  bow.section = circleOutline(1.2, 24);
  bow.capLength = 1.2;
  up.add("bow", makeSweep(bow), w.finishes.polishedGold);
}

/// A block with a groove for the case and a brass rest behind it.
void addStand(const Workshop& w) {
  PlateSpec block{.outline = rectangleOutline({-27, -26}, {27, 20}, 5, 0.12),
                  .height = 8,
                  .bevel = 1.2,
                  .bevelSteps = 6,
                  .textureSize = 200};
  w.add("stand", joined(makePlate(block)), w.finishes.darkWood);
  for (const double z : {-7.0, 10.5}) {
    PlateSpec rail{.outline = rectangleOutline({-20, -z - 3}, {20, -z + 3}, 2.4, 0.2),
                   .height = 5.5,
                   .bevel = 0.8,
                   .textureSize = 200};
    w.add("rail", joined(makePlate(rail)), w.finishes.darkWood, {.position = {0, 7.5, 0}});
  }
  w.add("rest",
        makeWire(smoothPath({{-10, 6, -17},
                             {-11, 20, -18.5},
                             {-9, 46, -20.5},
                             {0, 52, -20.5},
                             {9, 46, -20.5},
                             {11, 20, -18.5},
                             {10, 6, -17}},
                            16),
                 1.3, 24),
        w.finishes.polishedBrass);
}

/// Where the chain lies: from the bow down behind the watch, then over the bench.
std::vector<glm::dvec3> chainPath() {
  const std::vector<glm::dvec3> points{
      {-12, 97, -21}, {-6, 92, -30},  {6, 60, -36},   {18, 22, -36},  {27, 4, -34},  {38, 1.3, -26},
      {46, 1.3, -8},  {36, 1.3, 14},  {30, 1.3, 34},  {42, 1.3, 54},  {40, 1.3, 74}, {18, 1.3, 80},
      {-8, 1.3, 70},  {-34, 1.3, 66}, {-58, 1.3, 74}, {-70, 1.3, 64}, {-66, 1.3, 50}};
  return smoothPath(points, 40);
}

/// Links that stand across one another in turn.
void addChain(const Workshop& w) {
  constexpr double kPitch = 2.15, kWire = 0.36;
  SweepSpec link;
  for (int i = 0; i < 48; ++i) {
    const glm::dvec2 c = onCircle(i, 48);
    link.path.emplace_back(0.95 * c.x, 0.75 * (c.y > 0 ? 1 : c.y < 0 ? -1 : 0) + 0.95 * c.y, 0);
  }
  link.isClosed = true;
  link.section = circleOutline(kWire, 16);
  const int mesh = w.addMesh("link", makeSweep(link), w.finishes.polishedGold);
  const std::vector<glm::dvec3> path = chainPath();
  double left = 0;
  int count = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const glm::dvec3 step = path[i + 1] - path[i], along = glm::normalize(step);
    double at = left;
    for (; at < glm::length(step); at += kPitch) {
      const glm::dquat twist = turnAbout({0, 1, 0}, 45 + 90.0 * (count++ % 2));
      w.placeMesh(mesh, {.position = path[i] + at * along, .turn = upTo(along) * twist});
    }
    left = at - glm::length(step);
  }
}

}  // namespace

void addWatch(const Workshop& workshop, const Assembly& movement) {
  const Workshop watch = workshop.at({.position = kWatchAt, .turn = turnAbout({1, 0, 0}, 90 - kLean)});
  addCase(watch);
  addLid(watch);
  addCrown(watch);
  watch.placeAll(movement);
  addStand(workshop.at({.position = {kWatchAt.x, 0, kWatchAt.z + 8}}));
  addChain(workshop);
}

}  // namespace generator
