// A jar of honey with its dipper, and a glass of water.
#include "breakfast/table.h"
#include "shapes/lathe.h"
#include "shapes/sweep.h"

namespace generator {
namespace {

/// A vessel filled to `level`: the glass against air, the glass against the liquid, and the liquid's surface,
/// which rises at the wall.
struct Filled {
  std::vector<Corner> outside;  ///< from the axis below up to the rim and inside down to the level
  std::vector<Corner> wetted;   ///< from the axis below up the inner wall to the level
};

void addFilled(const Table& w, const Filled& vessel, const Finish& wall, bool isLiquidDenser,
               const Finish& top) {
  w.add("vessel", turnedVessel(vessel.outside), w.finishes.glass);
  Mesh wetted = turnedVessel(vessel.wetted);
  w.add("wetted wall", isLiquidDenser ? std::move(wetted) : insideOut(std::move(wetted)), wall);
  const Corner& rim = vessel.wetted.back();
  // From the wall inwards: the front is up.
  w.add("liquid",
        turnedVessel({{rim.x, rim.y, 0},
                      {rim.x - 0.12, rim.y - 0.14, 0.1},
                      {rim.x - 0.5, rim.y - 0.17, 0.3},
                      {0, rim.y - 0.17, 0}}),
        top);
}

void addDipper(const Table& w) {
  const Table dipper = w.at({.position = {-0.9, 2.9, 0.2}, .turn = upTo({0.30, 1, 0.02})});
  std::vector<Corner> head{{0, 0, 0}, {0.7, 0.05, 0.2}};
  for (int i = 0; i < 6; ++i) {
    const double y = 0.25 + 0.62 * i, out = 1.05 + 0.35 * (i < 3 ? i : 5 - i) / 2.0;
    head.push_back({out, y, 0.12});
    head.push_back({out, y + 0.34, 0.12});
    head.push_back({0.6, y + 0.40, 0.05});
    head.push_back({0.6, y + 0.58, 0.05});
  }
  head.push_back({0.45, 4.4, 0.3});
  head.push_back({0.33, 6, 1});
  head.push_back({0.42, 13.5, 2});
  head.push_back({0.52, 14.3, 0.3});
  head.push_back({0.30, 14.8, 0.2});
  head.push_back({0, 14.9, 0});
  dipper.add("dipper", makeLathe(roundCorners(head, false, 0.15), 96), w.finishes.spindle);
}

}  // namespace

Mesh turnedVessel(const std::vector<Corner>& profile, bool isClosed) {
  return makeLathe(roundCorners(profile, isClosed, 0.07), 224);
}

void addGlasses(const Table& table) {
  const Table honey = table.at({.position = {kHoney.x, 0, kHoney.z}});
  addFilled(honey,
            {{{0, 0.15, 0},
              {3.2, 0.15, 0.3},
              {3.7, 0, 0.3},
              {4.5, 0.5, 0.9},
              {4.6, 4, 4},
              {4.5, 8.4, 1.6},
              {3.7, 9.6, 0.8},
              {3.7, 11.0, 0.1},
              {4.0, 11.15, 0.15},
              {4.0, 11.7, 0.2},
              {3.4, 11.7, 0.15},
              {3.35, 9.5, 0.8},
              {4.1, 8.3, 0}},
             {{0, 0.9, 0}, {3.6, 0.8, 0.7}, {4.2, 1.4, 0.6}, {4.25, 4, 4}, {4.1, 8.3, 0}}},
            honey.finishes.honeyWall, true, honey.finishes.honeyTop);
  addDipper(honey);
  addFilled(table.at({.position = {kWater.x, 0, kWater.z}}),
            {{{0, 0.12, 0},
              {2.6, 0.1, 0.2},
              {3.1, 0.0, 0.2},
              {3.35, 0.5, 0.3},
              {4.0, 12.6, 0.12},
              {3.78, 12.6, 0.1},
              {3.55, 8.6, 0}},
             {{0, 1.5, 0}, {2.6, 1.4, 0.5}, {3.12, 2.0, 0.4}, {3.55, 8.6, 0}}},
            table.finishes.waterWall, false, table.finishes.waterTop);
}

}  // namespace generator
