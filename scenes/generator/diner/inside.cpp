// What the windows show: a counter with stools, shelves of bottles, lamps that hang in a row.
#include "diner/street.h"
#include "hash.h"
#include "shapes/lathe.h"
#include "shapes/sweep.h"

namespace generator {
namespace {

enum InsideSeries : std::uint32_t { kBottle = 31000 };

Mesh turned(const std::vector<Corner>& profile, int segments = 64) {
  return makeLathe(roundCorners(profile, false, 0.12), segments);
}

void addRoom(const Street& w) {
  const StreetFinishes& f = w.finishes;
  Mesh back;
  addQuad(back, {-5.6, 0, -3.6}, {11.2, 0, 0}, {0, kLintel + 0.12, 0}, {9.3, 1.9});
  addQuad(back, {-5.9, 0, -0.9}, {0.3, 0, -2.7}, {0, kLintel + 0.12, 0}, {2.2, 1.9});
  addQuad(back, {5.6, 0, -3.6}, {0.3, 0, 2.7}, {0, kLintel + 0.12, 0}, {2.2, 1.9});
  w.add("back wall", std::move(back), f.wallTiles);
  w.add("counter", makeRoundedBox({-5.0, 0.1, -2.5}, {5.0, 1.08, -2.0}, 0.02), f.redEnamel);
  w.add("counter top", makeRoundedBox({-5.1, 1.08, -2.6}, {5.1, 1.13, -1.85}, 0.022), f.counter);
  w.add("counter edge", makeRoundedBox({-5.12, 1.075, -1.86}, {5.12, 1.135, -1.83}, 0.012), f.chrome);
  const int stool = w.addMesh("stool",
                              turned({{0, 0.1, 0},
                                      {0.22, 0.1, 0.01},
                                      {0.20, 0.14, 0.03},
                                      {0.035, 0.18, 0.03},
                                      {0.035, 0.80, 0.02},
                                      {0.18, 0.83, 0.01},
                                      {0.19, 0.87, 0.01},
                                      {0, 0.87, 0}}),
                              f.chrome);
  const int seat = w.addMesh(
      "stool seat",
      turned({{0, 0.86, 0}, {0.20, 0.86, 0.02}, {0.215, 0.93, 0.03}, {0.17, 0.97, 0.03}, {0, 0.98, 0}}),
      f.cloth);
  for (int i = 0; i < 12; ++i) {
    const glm::dvec3 at(-4.7 + 0.85 * i, 0.02, -1.35);
    w.placeMesh(stool, {.position = at});
    w.placeMesh(seat, {.position = at});
  }
  // Tables in the windows at both ends.
  for (const double x : {-5.6, 5.6})
    w.add("booth", makeRoundedBox({x - 0.5, 0.1, -1.2}, {x + 0.5, 1.25, -0.95}, 0.05), f.cloth);
}

void addShelves(const Street& w) {
  const StreetFinishes& f = w.finishes;
  const int tall = w.addMesh("bottle",
                             turned({{0, 0, 0},
                                     {0.038, 0, 0.006},
                                     {0.038, 0.17, 0.02},
                                     {0.014, 0.23, 0.02},
                                     {0.014, 0.30, 0.003},
                                     {0, 0.30, 0}}),
                             f.bottles[0]);
  std::array<int, 4> bottles{};
  for (std::size_t i = 0; i < 4; ++i) {
    bottles[i] = i == 0 ? tall
                        : w.addMesh("bottle",
                                    turned({{0, 0, 0},
                                            {0.036 + 0.004 * static_cast<double>(i), 0, 0.006},
                                            {0.038, 0.14 + 0.015 * static_cast<double>(i), 0.03},
                                            {0.013, 0.20, 0.02},
                                            {0.013, 0.27, 0.003},
                                            {0, 0.27, 0}}),
                                    f.bottles[i]);
  }
  for (const double y : {1.36, 1.76}) {
    w.add("shelf", makeRoundedBox({-4.4, y - 0.03, -3.55}, {4.4, y, -3.3}, 0.008), f.chrome);
    for (std::uint32_t i = 0; i < 74; ++i) {
      const std::uint32_t id = i + (y > 1.5 ? 200 : 0);
      if (unitValue(kBottle, id) < 0.18) continue;
      w.placeMesh(bottles[mix(id) % 4],
                  {.position = {-4.3 + 0.117 * i + 0.02 * unitValue(kBottle + 1, id), y, -3.43},
                   .scale = 0.9 + 0.25 * unitValue(kBottle + 2, id)});
    }
  }
  // Coffee machines on the counter behind, and cups on the one in front.
  for (const double x : {-2.9, 2.1}) {
    w.add("coffee urn",
          turned({{0, 1.13, 0},
                  {0.17, 1.13, 0.01},
                  {0.18, 1.52, 0.05},
                  {0.10, 1.60, 0.05},
                  {0.03, 1.63, 0.02},
                  {0.03, 1.68, 0.02},
                  {0, 1.68, 0}},
                 128),
          f.chrome, {.position = {x, 0, -2.95}});
  }
  w.add("back bar", makeRoundedBox({-4.6, 0.1, -3.5}, {4.6, 1.13, -2.75}, 0.02), f.wood);
  const int cup = w.addMesh("cup",
                            turned({{0, 0, 0},
                                    {0.03, 0, 0.004},
                                    {0.042, 0.04, 0.02},
                                    {0.045, 0.085, 0.003},
                                    {0.038, 0.08, 0.01},
                                    {0.02, 0.01, 0.01},
                                    {0, 0.01, 0}}),
                            f.creamEnamel);
  const int shaker = w.addMesh(
      "shaker",
      turned({{0, 0, 0}, {0.03, 0, 0.004}, {0.026, 0.10, 0.01}, {0.018, 0.13, 0.01}, {0, 0.135, 0}}),
      f.chrome);
  for (std::uint32_t i = 0; i < 16; ++i)
    w.placeMesh(i % 3 == 0 ? shaker : cup, {.position = {-4.6 + 0.6 * i + 0.2 * unitValue(kBottle + 3, i),
                                                         1.13, -2.1 - 0.15 * unitValue(kBottle + 4, i)}});
}

void addHangingLamps(const Street& w) {
  const StreetFinishes& f = w.finishes;
  const int shade = w.addMesh("shade",
                              makeLathe(roundCorners({{0.19, 0, 0.004},
                                                      {0.195, 0.005, 0.004},
                                                      {0.15, 0.09, 0.05},
                                                      {0.03, 0.14, 0.02},
                                                      {0.0, 0.15, 0}},
                                                     false, 0.1),
                                        96),
                              f.creamEnamel);
  const int bulb = w.addMesh("bulb", makeSphere(0.055, 48, 24), f.bulb);
  const int rod = w.addMesh("rod", makeWire({{0, 0.14, 0}, {0, 0.42, 0}}, 0.008, 12), f.chrome);
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 at(-4.55 + 1.3 * i, 1.92, -2.2);
    w.placeMesh(shade, {.position = at});
    w.placeMesh(bulb, {.position = at + glm::dvec3(0, 0.035, 0)});
    w.placeMesh(rod, {.position = at});
  }
  // Boards with what there is to eat, above the shelves.
  for (const double x : {-3.1, 0.0, 3.1})
    w.add("menu", makeRoundedBox({x - 1.1, 2.02, -3.56}, {x + 1.1, 2.26, -3.5}, 0.02), f.menu);
}

}  // namespace

void addInside(const Street& diner) {
  addRoom(diner);
  addShelves(diner);
  addHangingLamps(diner);
}

}  // namespace generator
