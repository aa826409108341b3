// A table outside that nobody has wiped: drops of rain, a glass, a shaker of sugar, a red bottle.
#include <cmath>

#include "diner/street.h"
#include "hash.h"
#include "shapes/lathe.h"
#include "shapes/sweep.h"

namespace generator {
namespace {

enum DropSeries : std::uint32_t { kDropAt = 32000, kDropSize = 32010 };
constexpr double kTop = 0.74, kRadius = 0.40;

Mesh fine(const std::vector<Corner>& profile, int segments = 160) {
  return makeLathe(roundCorners(profile, false, 0.08), segments);
}

/// A drop that sits on something, flatter than half a ball, of radius 1.
Mesh makeDrop() {
  return makeLathe(
      roundCorners({{0, 0.0, 0}, {0.92, 0.0, 0.05}, {1.0, 0.16, 0.2}, {0.72, 0.52, 0.45}, {0, 0.62, 0}},
                   false, 0.16),
      40);
}

void addDrops(const Street& w) {
  const int drop = w.addMesh("drop", makeDrop(), w.finishes.drop);
  std::vector<glm::dvec3> placed;  // x, z, radius
  for (std::uint32_t i = 0; i < 1500; ++i) {
    const double chance = unitValue(kDropSize, i), size = 0.0012 + 0.0075 * chance * chance * chance * chance;
    const double far = (kRadius - 0.03) * std::sqrt(unitValue(kDropAt, i)),
                 turn = 6.283185307179586 * unitValue(kDropAt + 1, i);
    const glm::dvec3 at(far * std::cos(turn), far * std::sin(turn), size);
    bool isFree = true;
    for (const glm::dvec3& other : placed)
      isFree = isFree && glm::distance(glm::dvec2(at), glm::dvec2(other)) > 1.05 * (at.z + other.z);
    for (const glm::dvec3& foot :
         {glm::dvec3(-0.10, -0.06, 0.045), {0.12, -0.14, 0.045}, {0.03, 0.10, 0.045}})
      isFree = isFree && glm::distance(glm::dvec2(at), glm::dvec2(foot)) > foot.z;
    if (!isFree) continue;
    placed.push_back(at);
    w.placeMesh(drop, {.position = {at.x, kTop, at.y}, .scale = size});
  }
}

void addThings(const Street& w) {
  const StreetFinishes& f = w.finishes;
  const auto at = [&](double x, double z) { return Placement{.position = {x, kTop, z}}; };
  // A tumbler with rain water in it.
  w.add("tumbler",
        fine({{0, 0.001, 0},
              {0.028, 0.001, 0.003},
              {0.031, 0.004, 0.002},
              {0.038, 0.12, 0.0012},
              {0.0355, 0.12, 0.001},
              {0.0322, 0.055, 0}}),
        f.glass, at(-0.10, -0.06));
  MaterialSpec wall = glass("glass at water", 1.5 / 1.333);
  w.add("wetted", insideOut(fine({{0, 0.012, 0}, {0.027, 0.012, 0.003}, {0.0322, 0.055, 0}})),
        plainFinish(w.scene, wall), at(-0.10, -0.06));
  w.add("water", fine({{0.0322, 0.055, 0}, {0.031, 0.0535, 0.001}, {0, 0.0535, 0}}), f.drop,
        at(-0.10, -0.06));
  // Sugar: a faceted jar with a lid of chrome.
  w.add("sugar jar",
        fine({{0, 0, 0},
              {0.036, 0, 0.004},
              {0.040, 0.04, 0.03},
              {0.034, 0.10, 0.02},
              {0.030, 0.115, 0.002},
              {0, 0.115, 0}},
             12),
        f.glass, at(0.12, -0.14));
  w.add(
      "sugar",
      fine({{0, 0.006, 0}, {0.033, 0.006, 0.003}, {0.036, 0.04, 0.02}, {0.0345, 0.065, 0.004}, {0, 0.07, 0}}),
      f.creamEnamel, at(0.12, -0.14));
  w.add("jar lid",
        fine({{0, 0.113, 0},
              {0.033, 0.113, 0.002},
              {0.033, 0.128, 0.004},
              {0.015, 0.145, 0.01},
              {0.007, 0.165, 0.004},
              {0, 0.166, 0}}),
        f.chrome, at(0.12, -0.14));
  // A bottle of ketchup.
  w.add("ketchup",
        fine({{0, 0, 0},
              {0.030, 0, 0.005},
              {0.031, 0.09, 0.02},
              {0.013, 0.15, 0.03},
              {0.013, 0.165, 0.002},
              {0, 0.165, 0}}),
        f.ketchup, at(0.03, 0.10));
  w.add("cap", fine({{0, 0.163, 0}, {0.016, 0.163, 0.001}, {0.016, 0.183, 0.003}, {0, 0.184, 0}}),
        f.creamEnamel, at(0.03, 0.10));
}

}  // namespace

void addCafeTable(const Street& street) {
  const StreetFinishes& f = street.finishes;
  const Street table = street.at({.position = {0.42, 0, 6.9}});
  table.add("table top",
            fine({{0, kTop - 0.035, 0},
                  {kRadius - 0.02, kTop - 0.035, 0.005},
                  {kRadius - 0.01, kTop - 0.004, 0.003},
                  {kRadius - 0.02, kTop, 0.004},
                  {0, kTop, 0}},
                 256),
            f.redEnamel);
  for (const double y : {kTop - 0.030, kTop - 0.020, kTop - 0.010})
    table.add("table edge", makeTorus(kRadius - 0.004, 0.0058, 256, 16), f.chrome,
              {.position = {0, y, 0}, .turn = upTo({0, 0, 1})});
  table.add("table foot",
            fine({{0, 0, 0},
                  {0.26, 0, 0.01},
                  {0.24, 0.03, 0.02},
                  {0.04, 0.07, 0.04},
                  {0.032, 0.3, 0.05},
                  {0.032, 0.66, 0.02},
                  {0.12, 0.70, 0.02},
                  {0, 0.705, 0}}),
            f.chrome);
  addDrops(table);
  addThings(table);
}

}  // namespace generator
