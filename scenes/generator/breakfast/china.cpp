// Cup and saucer, a plate, an egg, and a spoon of silver.
#include <cmath>
#include <numbers>

#include "breakfast/table.h"
#include "shapes/surface.h"
#include "shapes/sweep.h"

namespace generator {
namespace {

using std::numbers::pi;

/// A thread of gold on a rim.
void addRim(const Table& w, double radius, double height, double thickness) {
  w.add("gold rim", makeTorus(radius, thickness, 224, 16), w.finishes.gold,
        {.position = {0, height, 0}, .turn = upTo({0, 0, 1})});
}

void addCup(const Table& w) {
  w.add("saucer",
        turnedVessel({{0, 0.5, 0},
                      {3.2, 0.45, 0.2},
                      {3.5, 0, 0.1},
                      {3.9, 0, 0.1},
                      {4.2, 0.6, 0.4},
                      {7.6, 1.5, 3},
                      {7.7, 1.75, 0.12},
                      {4.4, 0.95, 2},
                      {3.2, 0.8, 0.3},
                      {0, 0.8, 0}}),
        w.finishes.china);
  addRim(w, 7.62, 1.66, 0.10);
  const Table cup = w.at({.position = {0, 0.8, 0}});
  cup.add("cup",
          turnedVessel({{0, 0.3, 0},
                        {2.0, 0.3, 0.1},
                        {2.2, 0, 0.1},
                        {2.5, 0.05, 0.1},
                        {2.7, 0.8, 0.4},
                        {4.4, 2.6, 2.0},
                        {4.7, 6.2, 0.5},
                        {4.9, 6.5, 0.1},
                        {4.6, 6.4, 0.1},
                        {4.1, 2.9, 1.8},
                        {2.4, 1.0, 0.8},
                        {0, 0.8, 0}}),
          w.finishes.china);
  addRim(cup, 4.82, 6.47, 0.09);
  cup.add("coffee", turnedVessel({{4.42, 5.36, 0}, {4.34, 5.27, 0.05}, {4.1, 5.25, 0.2}, {0, 5.25, 0}}),
          w.finishes.coffee);
  SweepSpec handle;
  handle.path = smoothPath(
      {{4.2, 5.5, 0}, {5.6, 5.9, 0}, {7.0, 5.2, 0}, {7.0, 3.6, 0}, {5.6, 2.4, 0}, {4.0, 2.1, 0}}, 20);
  handle.section = rectangleOutline({-0.2, -0.5}, {0.2, 0.5}, 0.19, 0.12);
  handle.across = {0, 1, 0};
  cup.add("cup handle", makeSweep(handle), w.finishes.china);
}

/// Lies along +X with the tip of its bowl at the origin: `uv.y` along, `uv.x` around its section.
glm::dvec3 spoonPoint(glm::dvec2 uv) {
  const double x = 14.5 * uv.y, around = 2 * pi * uv.x;
  const double bowl = x < 4.8 ? std::sqrt(std::max(0.0, 1 - std::pow((x - 2.5) / 2.5, 2))) : 0;
  const double t = std::max(0.0, (x - 4.2) / 10.3),
               grip = (0.26 + 0.52 * t * t * t) * std::sqrt(std::max(0.0, 1 - std::pow(t, 14)));
  const double blend = x < 3.2 ? 1 : std::max(0.0, 1 - (x - 3.2) / 1.9),
               smooth = blend * blend * (3 - 2 * blend);
  const double width = glm::mix(grip, 1.62 * std::max(bowl, 0.16 * (x > 2.5 ? 1 : 0)), smooth);
  const double hollow = 0.85 * smooth * bowl * bowl, thick = 0.02 + 0.07 * std::min(1.0, width);
  const double c = std::cos(around), s = std::sin(around);
  const double spine =
      0.9 - 0.35 * smooth + 1.05 * std::pow(std::max(0.0, std::sin(pi * std::min(1.0, t * 1.15))), 1.5) * 0.7;
  return {x, spine + hollow * (c * c - 1) + thick * s, -width * c};
}

void addSpoon(const Table& w) {
  SurfaceSpec spoon{.columns = 128, .rows = 360, .isRound = true, .position = spoonPoint};
  w.add("spoon", makeSurface(spoon), w.finishes.silver);
}

void addEgg(const Table& w) {
  w.add("egg cup",
        turnedVessel({{0, 0.3, 0},
                      {2.2, 0.2, 0.1},
                      {2.5, 0, 0.1},
                      {2.6, 0.3, 0.2},
                      {0.9, 1.6, 0.9},
                      {1.0, 2.2, 0.4},
                      {2.5, 3.4, 1.2},
                      {2.7, 5.2, 0.2},
                      {2.5, 5.2, 0.1},
                      {2.2, 3.6, 0.8},
                      {0, 2.8, 0}}),
        w.finishes.blueChina);
  addRim(w, 2.6, 5.2, 0.08);
  SurfaceSpec egg{.columns = 160, .rows = 96, .isRound = true, .position = {}};
  egg.position = [](glm::dvec2 uv) {
    const double polar = pi * (1 - uv.y), h = std::cos(polar), r = 2.18 * std::sin(polar) * (1 - 0.14 * h);
    return glm::dvec3(r * std::cos(2 * pi * uv.x), 2.85 * h, -r * std::sin(2 * pi * uv.x));
  };
  w.add("egg", makeSurface(egg), w.finishes.egg, {.position = {0, 6.1, 0}});
}

void addPlate(const Table& w) {
  w.add("plate",
        turnedVessel({{0, 0.5, 0},
                      {5.6, 0.45, 0.2},
                      {6.0, 0, 0.1},
                      {6.5, 0, 0.1},
                      {6.9, 0.5, 0.4},
                      {10.6, 1.6, 3},
                      {10.7, 1.85, 0.12},
                      {7.0, 1.0, 1.5},
                      {5.6, 0.85, 0.5},
                      {0, 0.85, 0}}),
        w.finishes.china);
  for (const double r : {9.6, 10.0, 10.4}) addRim(w, r, 1.02 + 0.23 * (r - 7.0), r == 10.0 ? 0.05 : 0.04);
  w.add("blue rim", makeTorus(10.65, 0.13, 224, 16), w.finishes.blueChina,
        {.position = {0, 1.74, 0}, .turn = upTo({0, 0, 1})});
}

}  // namespace

void addChina(const Table& table) {
  const Table cup = table.at({.position = {kCup.x, 0, kCup.z}, .turnY = -28});
  addCup(cup);
  addSpoon(table.at(
      {.position = {kCup.x + 3.0, 0.55, kCup.z + 6.4}, .turnY = -3, .turn = turnAbout({0, 0, 1}, -1.5)}));
  addEgg(table.at({.position = {kEgg.x, 0, kEgg.z}}));
  addPlate(table.at({.position = {kPastry.x, 0, kPastry.z}}));
}

}  // namespace generator
