// The bench: boards of walnut, an inlaid pad of stitched leather, and a drawer box with a cloth thrown over
// it.
#include <cmath>

#include "shapes/cloth.h"
#include "shapes/lathe.h"
#include "shapes/sweep.h"
#include "watchmaker/workshop.h"

namespace generator {
namespace {

constexpr glm::dvec2 kPadLow(-108, -70), kPadHigh(112, 118);  // x and z
constexpr glm::dvec3 kChestLow(-154, 0, -80), kChestHigh(-92, 46, -20);
constexpr double kDrawers[] = {5, 25};  // heights of their lower edges
constexpr double kPadThickness = 1.2, kPadSunk = 0.9;

/// A row of stitches just inside the pad's edge.
void addStitches(const Workshop& w) {
  constexpr double kInset = 4, kLength = 3.2, kPitch = 4.4;
  const double y = kPadThickness - kPadSunk;
  const int stitch = w.addMesh("stitch",
                               makeWire(smoothPath({{0, -0.5, 0},
                                                    {0.5, 0.15, 0},
                                                    {kLength / 2, 0.35, 0.12},
                                                    {kLength - 0.5, 0.15, 0.2},
                                                    {kLength, -0.5, 0.2}},
                                                   4),
                                        0.34, 10),
                               w.finishes.stitch);
  const glm::dvec2 low = kPadLow + kInset, high = kPadHigh - kInset;
  for (double x = low.x; x + kLength < high.x; x += kPitch) {
    w.placeMesh(stitch, {.position = {x, y, low.y}});
    w.placeMesh(stitch, {.position = {x, y, high.y}});
  }
  for (double z = low.y + kPitch; z + kLength < high.y; z += kPitch) {
    w.placeMesh(stitch, {.position = {low.x, y, z + kLength}, .turnY = 90});
    w.placeMesh(stitch, {.position = {high.x, y, z + kLength}, .turnY = 90});
  }
}

void addTop(const Workshop& w) {
  PlateSpec top{.outline = rectangleOutline({-520, -300}, {520, 330}, 8, 0.2),
                .height = 36,
                .bevel = 4,
                .bevelSteps = 6,
                .textureSize = 1000};
  w.add("bench top", joined(makePlate(top)), w.finishes.walnut, {.position = {0, -36, 0}});
  PlateSpec pad{.outline = rectangleOutline({kPadLow.x, -kPadHigh.y}, {kPadHigh.x, -kPadLow.y}, 10, 0.1),
                .height = kPadThickness,
                .bevel = 0.55,
                .textureSize = 150};
  w.add("leather pad", joined(makePlate(pad)), w.finishes.leather, {.position = {0, -kPadSunk, 0}});
  addStitches(w);
}

/// A small chest of two drawers, and the cloth that fell onto it.
void addChest(const Workshop& w) {
  w.add("chest", makeRoundedBox(kChestLow, kChestHigh, 2), w.finishes.darkWood);
  const int knob = w.addMesh(
      "knob",
      makeLathe(roundCorners({{0, 0, 0}, {2, 0, 0}, {1.4, 2.5, 1}, {3, 4.5, 1.5}, {0, 7, 0}}, false), 48),
      w.finishes.polishedBrass);
  for (const double y : kDrawers) {
    w.add("drawer",
          makeRoundedBox({kChestLow.x + 4, y, kChestHigh.z - 6},
                         {kChestHigh.x - 4, y + 16, kChestHigh.z + 1.6}, 1.2),
          w.finishes.darkWood);
    w.placeMesh(knob, {.position = {0.5 * (kChestLow.x + kChestHigh.x), y + 8, kChestHigh.z + 1.4},
                       .turn = upTo({0, 0, 1})});
  }
  constexpr float kClothTextures = 2.5;  // of 50 mm, along its side of 125 mm
  ClothSpec cloth;
  cloth.center = {-0.124, 0.060, -0.052};
  cloth.size = 0.125;
  cloth.turn = 0.5;
  cloth.cells = 44;
  cloth.steps = 260;
  // The chest with its drawers' fronts, the knobs, and the bench; the cloth is a millimetre thick.
  cloth.distance = [](glm::dvec3 metres) {
    const glm::dvec3 p = 1e3 * metres;
    double distance = std::min(p.y, distanceToBox(p, kChestLow, kChestHigh + glm::dvec3(0, 0, 1.6), 2));
    for (const double y : kDrawers) {
      const glm::dvec3 middle(0.5 * (kChestLow.x + kChestHigh.x), y + 8, kChestHigh.z + 4.5);
      distance = std::min(distance, distanceToBox(p, middle - 3.5, middle + 3.5, 2));
    }
    return 1e-3 * (distance - 1.0);
  };
  Mesh mesh = meshOf(subdivided(subdivided(drapeCloth(cloth))));
  for (glm::vec3& p : mesh.positions) p *= 1e3F;  // millimetres
  for (glm::vec2& uv : mesh.uv0) uv *= kClothTextures;
  w.add("polishing cloth", std::move(mesh), w.finishes.cloth);
}

}  // namespace

void addBench(const Workshop& workshop) {
  addTop(workshop);
  addChest(workshop);
}

}  // namespace generator
