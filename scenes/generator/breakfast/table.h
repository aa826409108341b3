// What the parts of the breakfast table share: finishes and a place. Everything in this folder is in
// centimetres: X to the right, Y up from the table top, Z towards the camera; the window is at -Z.
#pragma once

#include <array>

#include "stage.h"

namespace generator {

struct TableFinishes {
  // metal, china and glass; the smooth ones mirror what is around them
  Finish silver, gold, china, blueChina, glass, waterWall, waterTop, honeyWall, honeyTop, coffee, ebony;
  // food
  Finish crust, crumb, pastry, egg, orange;
  std::array<Finish, 2> cherries;
  // plants
  Finish stem, leaf, petal, pollen;
  // linen, wood, the room
  Finish linen, towel, board, spindle, paint, wall, ceiling, floor, mirrorGlass, pane, cane;
  // what glows
  Finish curtain, garden, doorway;
};

TableFinishes addTableFinishes(GltfBuilder& scene);

using Table = FurnishedStage<TableFinishes>;

/// A vessel of glass or china: `profile` turned about +Y, fine enough for what it mirrors.
Mesh turnedVessel(const std::vector<Corner>& profile, bool isClosed = false);

/// Where things stand, so that the cloth lies flat under them: x, z and radius.
struct Footprint {
  double x, z, radius;
};
constexpr Footprint kPot{-22, -9, 6.5}, kHoney{7.5, 1, 5}, kWater{19.5, -7, 4}, kVase{31, -20, 5},
    kLoaf{-1, -25, 17}, kPastry{27, 12, 11}, kCup{-14, 13, 8}, kEgg{-33, 4, 4}, kFruit{41, -7, 8},
    kOrange{-35, -14, 3.5}, kOtherOrange{-41, -9, 3.5}, kCherry{7, 19, 3};
constexpr Footprint kFootprints[] = {kPot, kHoney, kWater, kVase,   kLoaf,        kPastry,
                                     kCup, kEgg,   kFruit, kOrange, kOtherOrange, kCherry};
constexpr double kWindowWall = -75;  // its z

// The parts, each where it lies in the composition.
void addLinen(const Table& table);
void addPot(const Table& table);
void addGlasses(const Table& table);  ///< honey, water
void addBread(const Table& table);
void addChina(const Table& table);  ///< cup, egg, plate and what lies on it
void addFruit(const Table& table);
void addSprig(const Table& table);
void addWindowSide(const Table& table);  ///< wall, window, curtains, garden
void addRestOfRoom(const Table& table);  ///< what mirrors show

}  // namespace generator
