// Cherries, in a blue bowl and beside it, and two oranges.
#include <cmath>
#include <numbers>

#include "breakfast/table.h"
#include "hash.h"
#include "shapes/heap.h"
#include "shapes/surface.h"
#include "shapes/sweep.h"

namespace generator {
namespace {

using std::numbers::pi;

enum FruitSeries : std::uint32_t { kCherryHeap = 23000, kCherryTurn = 23010, kCherryLean };
constexpr double kCherryRadius = 1.25;

/// A ball with a hollow at the top, heart-shaped seen from the side.
Mesh makeFruit(double radius, double hollow, double taper) {
  SurfaceSpec fruit{.columns = 96, .rows = 64, .isRound = true, .position = {}};
  fruit.position = [=](glm::dvec2 uv) {
    const double polar = pi * (1 - uv.y), s = std::sin(polar), h = std::cos(polar);
    const double r = radius * s * (1 + taper * h),
                 dent = h > 0 ? hollow * std::exp(-9 * s * s) : 0.25 * hollow * std::exp(-14 * s * s);
    return glm::dvec3(r * std::cos(2 * pi * uv.x), radius * (0.95 * h - (h > 0 ? dent : -dent)),
                      -r * std::sin(2 * pi * uv.x));
  };
  return makeSurface(fruit);
}

struct CherryMeshes {
  std::array<int, 2> fruit;
  int stem;
};

void addCherry(const Table& w, const CherryMeshes& meshes, glm::dvec3 at, std::uint32_t id, double leanMost) {
  const double turn = 360 * unitValue(kCherryTurn, id),
               lean = leanMost * (0.35 + 0.65 * unitValue(kCherryLean, id));
  const glm::dquat way = turnAbout({0, 1, 0}, turn) * turnAbout({0, 0, 1}, lean);
  const Placement place{.position = at, .scale = 0.94 + 0.07 * unitValue(kCherryLean, id + 500), .turn = way};
  w.placeMesh(meshes.fruit[id % 3 == 0 ? 1 : 0], place);
  if (id % 4 != 1) w.placeMesh(meshes.stem, place);
}

void addBowl(const Table& w, const CherryMeshes& meshes) {
  w.add("bowl",
        turnedVessel({{0, 0.4, 0},
                      {3.0, 0.35, 0.2},
                      {3.2, 0, 0.1},
                      {3.7, 0, 0.1},
                      {3.9, 0.7, 0.4},
                      {6.4, 2.4, 3.5},
                      {7.6, 6.0, 2},
                      {7.75, 6.2, 0.12},
                      {7.3, 5.9, 0.3},
                      {6.0, 2.8, 3.2},
                      {3.4, 1.1, 1},
                      {0, 1.0, 0}}),
        w.finishes.blueChina);
  w.add("bowl rim", makeTorus(7.68, 0.11, 224, 16), w.finishes.gold,
        {.position = {0, 6.16, 0}, .turn = upTo({0, 0, 1})});
  HeapSpec heap{.count = 58,
                .radius = kCherryRadius,
                .spread = 4.5,
                .start = 3,
                .steps = 420,
                .series = kCherryHeap,
                .distance = {}};
  // The inside of the bowl is near to a ball of radius 8 about a point on its axis.
  heap.distance = [](glm::dvec3 p) {
    const glm::dvec3 d = p - glm::dvec3(0, 8.9, 0);
    return 7.9 - std::sqrt(glm::dot(d, d));
  };
  std::uint32_t id = 0;
  for (const glm::dvec3& at : heapOfBalls(heap)) addCherry(w, meshes, at, id++, 80);
}

}  // namespace

void addFruit(const Table& table) {
  const Mesh fruit = untextured(makeFruit(kCherryRadius, 0.42, 0.06));
  const CherryMeshes meshes{
      {table.addMesh("cherry", fruit, table.finishes.cherries[0]),
       table.addMesh("ripe cherry", fruit, table.finishes.cherries[1])},
      table.addMesh(
          "cherry stem",
          makeWire(smoothPath(
                       {{0, 0.7, 0}, {0.05, 1.6, 0}, {0.35, 2.8, 0.1}, {0.9, 4.0, 0.1}, {1.1, 4.5, 0.15}}, 8),
                   0.07, 12),
          table.finishes.stem)};
  addBowl(table.at({.position = {kFruit.x, 0, kFruit.z}}), meshes);
  std::uint32_t id = 101;
  for (const glm::dvec2 at : {glm::dvec2(0, 0), {2.9, 0.9}, {-5.2, 3.4}, {9.6, 4.2}})
    addCherry(table, meshes, {kCherry.x + at.x, 0.95 * kCherryRadius, kCherry.z + at.y}, id++, 96);
  const int orange = table.addMesh("orange", makeFruit(3.6, 0.3, -0.02), table.finishes.orange);
  table.placeMesh(orange, {.position = {kOrange.x, 3.35, kOrange.z}, .turn = turnAbout({1, 0, 0.4}, 32)});
  table.placeMesh(orange, {.position = {kOtherOrange.x, 3.2, kOtherOrange.z},
                           .scale = 0.96,
                           .turn = turnAbout({0.3, 0, 1}, 118)});
}

}  // namespace generator
